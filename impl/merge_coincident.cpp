#include "merge_coincident.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "budget.hpp"
#include "merge_points.hpp"

namespace tetlod {

namespace {

/// By how much coordinates of one place may differ that were computed twice.
double rounding_of(const Box &box) { return std::max(1e-12 * box.diagonal(), 1e-15 * box.largest_coordinate()); }

/// Whether many tets have two points that are not equal, but became one: the mesh is as thin as that.
bool flattens_many(Span<const Vec3> points, Span<const Tet> tets, Span<const std::int32_t> representative, Job &job) {
  const auto is_equal = [&](std::int32_t v, std::int32_t u) {
    return v == u || points[std::size_t(v)] == points[std::size_t(u)];
  };
  std::size_t v = 0;
  while (v < points.size() && is_equal(std::int32_t(v), representative[v])) job.poll_at(v++, 0.9);
  if (v == points.size()) return false;
  const auto is_flattened = [&](const Tet &t) {
    for (std::size_t i = 1; i < 4; i++)
      for (std::size_t j = 0; j < i; j++)
        if (representative[std::size_t(t[i])] == representative[std::size_t(t[j])] && !is_equal(t[i], t[j]))
          return true;
    return false;
  };
  constexpr std::size_t many = 50;  // one in so many
  std::size_t flattened = 0;
  for (std::size_t t = 0; t < tets.size(); t++) {
    job.poll_at(t, 0.9);
    flattened += is_flattened(tets[t]);
  }
  return many * flattened > tets.size();
}

std::int64_t merge_places(Span<const Vec3> points, Span<const Tet> tets, Span<const std::uint8_t> used,
                          double tolerance, double rounding, Job &job, Array<std::int32_t> &representative) {
  if (tolerance < rounding) {
    const std::int64_t merged = merge_rounded(points, used, rounding, job, representative);
    if (merged >= 0 && !flattens_many(points, tets, representative, job)) return merged;
  }
  return merge_points(points, used, tolerance, job, representative);
}

std::int64_t count_merged(Span<const std::int32_t> representative) {
  std::int64_t merged = 0;
  for (std::size_t v = 0; v < representative.size(); v++) merged += representative[v] != std::int32_t(v);
  return merged;
}

/// What lies on one side is not to be taken for something on the other.
Opening opening_of(double diagonal, const Options &options, const Moves *opened) {
  constexpr double part = 5e-7;
  const double most = options.max_deviation > 0 ? options.max_deviation / 2 : std::numeric_limits<double>::infinity();
  return {part * diagonal, most * diagonal, opened};
}

}  // namespace

Merged merge_coincident(const Input &input, Span<const Vec3> points, Span<const Tet> tets,
                        Span<const std::uint8_t> used, const Box &box, const Options &options, Job &job,
                        Array<std::int32_t> &representative, const Moves *opened) {
  const bool is_finite = std::isfinite(box.diagonal());
  const double tolerance = is_finite ? options.merge_tolerance * box.diagonal() : 0;
  const double rounding = is_finite ? rounding_of(box) : 0;
  Merged merged(job.memory);
  merged.points = merge_places(points, tets, used, tolerance, rounding, job, representative);
  merged.depends = merged.points > 0;
  if (merged.points == 0 || !takes_contacts(options)) return merged;
  const std::int64_t before = merged.points;
  const SubmittedMesh mesh{input, points, tets, used};
  KeptApart kept = keep_touching_parts_apart(mesh, job, representative);
  merged.cracks = keep_cracks_open(mesh, opening_of(box.diagonal(), options, opened), job, representative);
  merged.points = count_merged(representative);
  merged.asked = std::move(kept.asked);
  merged.asked.insert(merged.asked.end(), merged.cracks.asked.begin(), merged.cracks.asked.end());
  merged.depends = merged.points < before || !merged.asked.empty();
  merged.torn = std::move(kept.torn);
  return merged;
}

}  // namespace tetlod
