// Where the vertex comes to be that a collapse leaves, and whether it may.
#pragma once
#include "solid_mesh.hpp"
#include "solid_rules.hpp"
#include "widen_cavity.hpp"

namespace tetlod {

template <std::size_t m>
struct SolidCollapse {
  explicit SolidCollapse(Memory &memory) : star(memory) {}
  SolidEdge edge;
  Vector<3 + m> place{};
  std::int32_t found_at = -1;  ///< the end whose cheapest edge it is
  bool of_boundary = false;
  bool met_sliver = false;  ///< a place would have done, but for such a triangle
  Star star;                ///< of the boundary
};

template <std::size_t m>
class SolidPlaces {
 public:
  using Place = Vector<3 + m>;

  /// holds_bound: what is flattest gets no flatter. boundary_vertices: of the original.
  SolidPlaces(const SolidMesh<m> &mesh, const SolidBlocks &blocks, bool holds_bound, std::size_t boundary_vertices)
      : mesh_(mesh),
        blocks_(blocks),
        keeps_planes_(!holds_bound),
        kept_of_flat_(holds_bound ? kept_for_bound : kept_of_flat),
        volume_of_collapse_(volume_to_lose * mesh.measures.volume / double(boundary_vertices)),
        rules_(holds_bound ? of_bound : rules[0]) {}

  /// Where little is admissible: how often rules may relax then, those of slivers alone and all.
  static constexpr int most_for_slivers = 2, most_of_all = 5;
  void relax(int times) { rules_ = rules[times]; }

  /// An edge that was found at v collapses to the best place near it, or, where that is not admissible, to the best
  /// along it, at t. may_widen: else, if tets beyond give way, to one of these all the same.
  bool find(std::int32_t v, std::int32_t u, double t, bool may_widen, SolidCollapse<m> &collapse) const {
    const auto [stays, gone] = mesh_.ends_of(v, u);
    collapse.found_at = v;
    collapse.of_boundary = mesh_.on_boundary(gone);
    if (!look_around(mesh_, stays, gone, collapse.edge)) return false;
    const Places places = find_places(t, collapse);
    const auto serves = [&](bool widened) {
      return std::any_of(places.begin(), places.end(), [&](const Place &at) { return suits(at, widened, collapse); });
    };
    return serves(false) || (may_widen && serves(true));
  }

  /// v, which is inside, moves into its neighbour.
  bool find_removal(std::int32_t v, std::int32_t into, SolidCollapse<m> &collapse) const {
    collapse.found_at = v;
    collapse.of_boundary = false;
    collapse.place = mesh_.place(into);
    return look_around_removal(mesh_, into, v, kept_of_flat_, collapse.edge);
  }

 private:
  using Places = Few<Place, 5>;
  /// Of the volume, that the boundary may lose.
  static constexpr double volume_to_lose = 0.01;
  /// What tets that are flat have to keep of their shape. In a graded mesh most are; nothing could go there without
  /// making some worse.
  static constexpr KeptOfFlat kept_of_flat{0.7, 0};
  /// Where a bound is to be held weights in the flattest have to be more than rounding leaves of them.
  static constexpr KeptOfFlat kept_for_bound{0.7, 1e-8};
  /// Of the boundary, most. On walls that are stretched all triangles are slivers, as good as each other but for a
  /// little; the rim of a flat body is sharper than any fold may get else, and its narrow faces turn when it gets still
  /// flatter; between the sides of a slit the best place of an edge is often beyond one.
  struct Rules {
    double kept_of_sliver;  ///< what slivers have to keep of their quality
    double kept_of_fold;    ///< and folds, how far they are open; 0: none may become sharp
    bool at_ends;           ///< whether an end's place will do, where no better one is admissible
    bool may_turn;          ///< whether triangles may turn too far
  };
  static constexpr Rules of_bound{1, 0, false, false};
  static constexpr Rules rules[1 + most_of_all] = {{0.999, 0, false, false}, {0.7, 0, false, false},
                                                   {0.4, 0, false, false},   {0.4, 0.7, true, false},
                                                   {0.4, 0.4, true, false},  {0.4, 0.4, true, true}};
  /// A best place further off than this part of the edge is none.
  static constexpr double longest_step = 0.5;

  /// Those that keep the volume, the best one first.
  Places find_places(double t, const SolidCollapse<m> &collapse) const {
    const SolidEdge &edge = collapse.edge;
    const Place stays = mesh_.place(edge.stays), gone = mesh_.place(edge.gone);
    const Place d = minus(gone, stays), best = along(stays, t, d);
    StepConstraint constraint;
    if (collapse.of_boundary) constraint = keeping_volume(mesh_, edge, point_of(best));
    Places places;
    const auto add = [&](const Place &place) {
      if (keeps_volume(constraint, minus(place, best))) places.push(place);
    };
    const bool may_move = !mesh_.keeps_place(edge.stays, edge.gone);
    if (may_move) {
      Place least = best, step;
      if (step_to_least(quadric_at(edge, best), constraint, step) && is_short(step, d)) least = along(best, 1, step);
      if (collapse.of_boundary && keeps_planes_ && !constraint.is_flat) add_on_planes(edge, best, least, places);
      if (least != best) add(least);
    }
    add(best);
    if (may_move && rules_.at_ends) {
      add(t < 0.5 ? stays : gone);
      add(t < 0.5 ? gone : stays);
    }
    return places;
  }

  /// The end, or the best place along the edge, where planes around stay planes, if it costs hardly more than the
  /// least.
  void add_on_planes(const SolidEdge &edge, const Place &best, const Place &least, Places &places) const {
    constexpr double hardly_more = 1.1;
    const EndsOnPlanes on = ends_on_planes(mesh_, edge);
    if (!on.stays && !on.gone) return;
    const Place at =
        with_best_values(edge, on.stays && on.gone ? best : mesh_.place(on.stays ? edge.stays : edge.gone));
    if (cost_of(edge, at) <= hardly_more * cost_of(edge, least)) places.push(at);
  }

  Place with_best_values(const SolidEdge &edge, Place at) const {
    const LocalQuadric<3 + m> sum = quadric_at(edge, at);
    for (std::size_t i = 3; i < 3 + m; i++) at[i] -= sum.g[i] / sum.a[entry_of(i, i)];
    return at;
  }

  /// Of both ends, kept at a place.
  LocalQuadric<3 + m> quadric_at(const SolidEdge &edge, const Place &at) const {
    LocalQuadric<3 + m> sum = mesh_.quadric(edge.stays).moved(minus(at, mesh_.place(edge.stays)));
    sum.add(mesh_.quadric(edge.gone).moved(minus(at, mesh_.place(edge.gone))));
    return sum;
  }

  double cost_of(const SolidEdge &edge, const Place &at) const {
    const auto rise_from = [&](std::int32_t end) { return mesh_.quadric(end).rise(minus(at, mesh_.place(end))); };
    return rise_from(edge.stays) + rise_from(edge.gone);
  }

  bool keeps_volume(const StepConstraint &constraint, const Place &step) const {
    return constraint.missed_by(point_of(step)) / 6 <= volume_of_collapse_;
  }

  static bool is_short(const Place &step, const Place &edge) {
    return length2(point_of(step)) <= longest_step * longest_step * length2(point_of(edge));
  }

  bool suits(const Place &place, bool widened, SolidCollapse<m> &collapse) const {
    collapse.place = place;
    const Vec3 point = point_of(place);
    const bool suits_tets = widened ? widen_cavity(mesh_, blocks_, point, collapse.edge)
                                    : !flattens(mesh_, collapse.edge, point, kept_of_flat_);
    return suits_tets && (!collapse.of_boundary || suits_boundary(collapse));
  }

  bool suits_boundary(SolidCollapse<m> &collapse) const {
    Star &star = collapse.star;
    if (!look_around_on_boundary(mesh_, collapse.edge, point_of(collapse.place), star) ||
        (!rules_.may_turn && turns_too_far(star)) || makes_fold(star))
      return false;
    const bool is_sliver = makes_sliver(star, rules_.kept_of_sliver);
    collapse.met_sliver |= is_sliver;
    return !is_sliver;
  }

  bool makes_fold(const Star &star) const {
    return rules_.kept_of_fold > 0 ? sharpens(star, rules_.kept_of_fold) : folds(star);
  }

  const SolidMesh<m> &mesh_;
  const SolidBlocks &blocks_;
  bool keeps_planes_;  // with a bound slits would lose their ends
  const KeptOfFlat &kept_of_flat_;
  double volume_of_collapse_;
  Rules rules_;
};

}  // namespace tetlod
