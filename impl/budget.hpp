// What the tets of a target size are spent on: boundary and samples.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "pipeline.hpp"
#include "portable_math.hpp"

namespace tetlod {

inline bool as_published(const Options &options) { return options.target_ratio <= 0 && options.max_error <= 0; }

/// Parts that lie on one another: TetGen takes none.
inline bool takes_contacts(const Options &options) {
  const bool needs_it = as_published(options) || (options.clean_edges > 0 && options.remesh);
  return !needs_it && options.on_overlap == policy_repair;
}

/// A bound without a size begins with few tets.
constexpr double first_ratio = 0.05;

inline double ratio_of(const Options &options) {
  const double asked = options.asked_ratio();
  return asked > 0 ? asked : first_ratio;
}

/// With fewer tets, all that can be done is done soon.
constexpr double small_mesh = 1e5;

/// A coarse mesh by collapsing edges is more accurate; one from samples is there sooner, where the mesh is large, no
/// thin one whose boundary takes longer, and little of it is kept. Samples do not stretch: a field that hardly changes
/// along some direction asks for tets that do. Vertices that the host keeps are lost near the boundary, and then all is
/// remeshed again, with a finer one. A bound alone asks for accuracy.
inline bool samples_sooner(const Options &options, const Report &report) {
  constexpr double little = 0.03, thin = 0.125, stretched = 0.004;
  const double tets = double(report.sound_tets()), ratio = options.asked_ratio();
  return tets >= small_mesh && report.least_change >= stretched && !report.keeps_some &&
         double(report.boundary_triangles_in) <= thin * tets && ratio > 0 && ratio <= little;
}

inline bool collapses_edges(const Options &options, const Report &report) {
  if (!options.remesh) return true;
  return options.clean_edges == 0 && (options.effort == effort_accurate || !samples_sooner(options, report));
}

/// Rounds of refine(), after the pass that every accurate run has. A small mesh has few vertices to go by, too: it gets
/// more.
inline int rounds_of(const Options &options, const Report &report) {
  constexpr double most = 12;
  if (options.effort != effort_accurate) return 0;
  return int(std::min(small_mesh / double(report.sound_tets()), most));
}

/// Where it matters most how soon it is there.
inline bool is_hasty(const Options &options, const Report &report) {
  constexpr std::int64_t many = 100000;
  return options.effort == effort_fast && options.max_error <= 0 && report.sound_tets() >= many;
}

/// What a target size is spent on.
struct Budget {
  std::int64_t tets = 0;
  double sigma = 0;
  std::size_t samples = 0;
  /// Where edges collapse, and a bound decides: between so many tets it ends where collapses cost more than `dearest`.
  std::int64_t least = 0, enough = 0;
  double dearest = 0;
};

/// Tets that a sample and a boundary vertex bring, by experience.
constexpr double tets_a_sample = 6.5, tets_a_boundary_point = 3;
/// Of a result with a target: tets over points; and over the parts of the original in which the field is linear, as far
/// as the bound of the error asks for it.
constexpr double tets_a_point = 4.5, tets_a_part = 6.5;
/// Share of the tets that is left to the vertices that refine() inserts; and that the boundary may have in any case.
constexpr double spare = 0.05, part_for_coarse_boundary = 0.05;
constexpr int most_rounds = 6, most_restorations = 8;
/// What is beyond the size by more misses it.
constexpr double most_excess = 1.03;
inline bool meets_size(const Budget &budget, const TetMesh &mesh) {
  return double(mesh.tets.size()) <= most_excess * double(budget.tets);
}

/// What the field's range counts as beside the diagonal, when the boundary is decimated: more costs geometry, and gains
/// where a large share of the vertices is on the boundary.
constexpr double field_weight = 0.3;

inline double field_weight_of(const Report &report) {
  const auto boundary = double(report.boundary_points_in);
  return field_weight * boundary / (boundary + double(report.interior_points_in));
}

/// A surface has fewer triangles to lose than its solid has tets, and less to lose them for.
inline double boundary_share(double ratio) { return power(root(ratio, 5), 4); }

/// Of a boundary that so many tets are spent on: a vertex has two triangles.
inline double triangles_for(double tets) { return 2 * tets / tets_a_boundary_point; }

inline Budget budget_of(double ratio, const Report &report) {
  Budget budget;
  const double whole = double(report.sound_tets()), triangles = double(report.boundary_triangles_in);
  budget.tets = std::max<std::int64_t>(std::int64_t(ratio * whole), 1);
  // Of the tets; of a mesh that is nearly all boundary, what the few vertices inside leave.
  const double inside = tets_a_sample * ratio * double(report.interior_points_in);
  const double share = std::max(0.6 * double(budget.tets), (1 - spare) * double(budget.tets) - inside);
  // A coarse boundary around a fine inside stays: that takes few of the tets, and hardly a triangle could go.
  const double few = triangles_for(part_for_coarse_boundary * double(budget.tets));
  const double kept = std::min({std::max(boundary_share(ratio) * triangles, few), triangles_for(share), triangles});
  budget.sigma = kept / triangles;
  const double left = (1 - spare) * double(budget.tets) - kept / 2 * tets_a_boundary_point;
  budget.samples = std::size_t(std::max(left / tets_a_sample, 0.0));
  return budget;
}

/// When TetGen finds no way with a boundary, one with more edges may have it; the last is the original's.
inline double less_decimated(double sigma) { return std::min(std::max(2 * sigma, 0.1), 1.0); }

/// After one with whose boundary a bound did not hold.
inline Budget larger_budget(double ratio, double sigma, const Report &report) {
  Budget budget = budget_of(std::min(ratio, 1.0), report);
  budget.sigma = less_decimated(sigma);
  return budget;
}

/// No tet has to go.
inline bool keeps_all(const Budget &budget, const Report &report) { return budget.tets >= report.sound_tets(); }

/// What collapses left, where there was none, and nothing was moved. origin: of each point, see came_from.hpp.
inline bool is_the_original(const TetMesh &mesh, Span<const std::int32_t> origin, const Report &report) {
  return std::int64_t(mesh.tets.size()) == report.sound_tets() && report.moved_points == 0 &&
         std::all_of(origin.begin(), origin.end(), [](std::int32_t v) { return v >= 0; });
}

/// There is no larger budget: no less can be decimated, and, where edges collapse, none would.
inline bool is_whole(const Budget &budget, const Options &options, const Report &report) {
  return budget.sigma >= 1 && (!collapses_edges(options, report) || keeps_all(budget, report));
}

/// Where edges collapse, a bound without a size begins where the largest error is about twice the bound, which takes
/// fewer tets in the end than other beginnings: when collapses cost more than the square of so many times the bound, of
/// the diagonal; by experience. With dearer ones than the costliest, and with a smaller part of the tets, unless these
/// are many, the shape would suffer; above the larger part, insertions where they are needed take fewer.
inline Budget budget_for_bound(double max_error, double diagonal, const Report &report) {
  constexpr double cost_of_bound = 40, costliest = 2, least = 0.01, many = 2000, enough = 0.15;
  Budget budget = budget_of(first_ratio, report);
  const double whole = double(budget.tets) / first_ratio,
               length = std::min(cost_of_bound * max_error, costliest) * diagonal;
  budget.least = std::int64_t(std::min(least * whole, many));
  budget.enough = std::int64_t(enough * whole);
  budget.dearest = length * length;
  return budget;
}

inline Budget first_budget(const Options &options, double diagonal, const Report &report) {
  const double asked = options.asked_ratio();
  return asked > 0 ? budget_of(asked, report) : budget_for_bound(options.max_error, diagonal, report);
}

/// Of so many tets, those that there shall be before the largest errors get the rest: for three hundredths of the tets
/// the largest is 0.5 to 0.6 of it, and the mean no more. Of few tets all. With a bound the largest errors get as many
/// as they need.
inline std::int64_t before_lowering(std::int64_t tets, double bound) {
  constexpr std::int64_t few = 100;
  return tets < few || bound > 0 ? tets : tets - tets * 3 / 100;
}

struct CollapseSizes {
  std::int64_t tets = 0;     ///< edges collapse until there are no more, or as a bound decides
  std::int64_t lowered = 0;  ///< when the boundary has gone back where it was farthest off; 0: it does not
};

/// What a bound asks for, and few tets, serve the field alone; else a part of what the largest errors get serves the
/// boundary before.
inline CollapseSizes collapse_sizes(const Budget &budget, const Options &options, const Report &report) {
  constexpr std::int64_t part = 400;
  if (options.max_error <= 0 && keeps_all(budget, report)) return {budget.tets, 0};
  const std::int64_t most = before_lowering(budget.tets, options.max_error);
  if (budget.enough > 0) return {budget.least, 0};
  const bool lowers = options.effort == effort_accurate && most < budget.tets && options.max_deviation <= 0;
  return lowers ? CollapseSizes{most - most / part, most} : CollapseSizes{most, 0};
}

/// How many tets there shall be before the largest errors get the rest; with what the boundary has left.
inline std::int64_t tets_before_lowering(const Budget &budget, const Options &options, const Report &report,
                                         bool collapsed, std::size_t tets) {
  const std::int64_t before = before_lowering(budget.tets, options.max_error);
  const bool lowered = collapsed && collapse_sizes(budget, options, report).lowered > 0;
  return lowered ? std::min(std::int64_t(tets), before) : before;
}

}  // namespace tetlod
