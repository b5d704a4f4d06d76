#include "conforming.hpp"

#include <algorithm>

#include "close_quads.hpp"
#include "crossed_quads.hpp"
#include "divide_tets.hpp"
#include "hanging_vertices.hpp"
#include "nested_solids.hpp"
#include "status.hpp"

namespace tetlod {

namespace {

/// Of the tets: between levels one becomes eight, and most are not between levels. Where tets overlap there is no end.
constexpr std::size_t largest_growth = 8;
/// As many vertices may hang on one edge.
constexpr int most_rounds = 100;

bool has_gaps(const MeshView &mesh, const Boundary &boundary, Job &job) {
  const TriangleCorners corners(mesh.points.size(), boundary.triangles, job);
  return any_hanging_vertices(mesh, corners, job) || any_crossed_quads(mesh, corners, boundary.tet_of, job);
}

/// False: they come to no end.
bool close_gaps(Job &job, NumberedTets &tets, bool inside_too) {
  const std::size_t most = std::min(largest_growth * tets.tets.size(), std::size_t(max_count));
  bool is_refined = false;  // in places: others take no look at each triangle
  if (!tets.find_boundary(job)) return false;
  for (int round = 0;
       divide_at_hanging_vertices(job, tets) || (is_refined && divide_at_vertices_on_triangles(job, tets, inside_too));
       round++) {
    is_refined = true;
    if (round == most_rounds || tets.tets.size() > most || !tets.find_boundary(job)) return false;
  }
  close_crossed_quads(is_refined, job, tets);
  return tets.find_boundary(job);
}

/// Solids hang together, and none touches itself that did not before: thin ones have faces that only look like a gap's.
bool are_no_worse(const NumberedTets &tets, const MeshView &before, const Boundary &boundary, Job &job) {
  const auto are_sound = [&](MayTouch may_touch) {
    return is_sound(tets.view(), tets.boundary.triangles, may_touch, job);
  };
  return are_sound(MayTouch::itself) &&
         (are_sound(MayTouch::nothing) || !is_sound(before, boundary.triangles, MayTouch::nothing, job));
}

bool have_same_vertices(Tet one, Tet other) {
  std::sort(one.begin(), one.end());
  std::sort(other.begin(), other.end());
  return one == other;
}

/// Of the original's tets those that are not among these.
void take_replaced(const NumberedTets &tets, Job &job, Original &original) {
  const Span<const Tet> old = original.view.tets;
  const Array<std::int32_t> &number = original.tet_number;
  Array<std::uint8_t> is_left(old.size(), 0, &job.memory);
  for (std::size_t t = 0; t < tets.tets.size(); t++) {
    const std::int32_t of = tets.number[t];
    const auto place = number.empty()
                           ? std::size_t(of)
                           : std::size_t(std::lower_bound(number.begin(), number.end(), of) - number.begin());
    if (have_same_vertices(tets.tets[t], old[place])) is_left[place] = 1;
  }
  for (std::size_t t = 0; t < old.size(); t++) {
    if (is_left[t]) continue;
    original.replaced.push_back(old[t]);
    original.replaced_number.push_back(number.empty() ? std::int32_t(t) : number[t]);
  }
}

}  // namespace

void make_conforming(Job &job, Boundary &boundary, Original &original) {
  if (!has_gaps(original.view, boundary, job)) return;
  NumberedTets tets(original.view, original.tet_number, job.memory);
  if (!close_gaps(job, tets, true) || !are_no_worse(tets, original.view, boundary, job)) return;
  tets.boundary.flat_tets += boundary.flat_tets;
  tets.boundary.duplicate_tets += boundary.duplicate_tets;
  boundary = std::move(tets.boundary);
  take_replaced(tets, job, original);
  original.tets = std::move(tets.tets);
  original.tet_number = std::move(tets.number);
  original.view.tets = original.tets;
}

bool close_gaps_of(Job &job, NumberedTets &tets) {
  return tets.find_boundary(job) && (!has_gaps(tets.view(), tets.boundary, job) || close_gaps(job, tets, false));
}

bool can_conform(Job &job, NumberedTets &tets) {
  return tets.find_boundary(job) && has_gaps(tets.view(), tets.boundary, job) && close_gaps(job, tets, false) &&
         is_sound(tets.view(), tets.boundary.triangles, MayTouch::nothing, job);
}

}  // namespace tetlod
