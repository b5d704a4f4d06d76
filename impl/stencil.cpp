#include "stencil.hpp"

#include <algorithm>

#include "locate.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// The heaviest first, so that a vertex is 1, 0, 0, 0; what has no weight repeats it.
void write_entry(Tet ids, std::array<double, 4> weights, std::size_t i, Stencil &stencil) {
  const auto heaviest = std::size_t(std::max_element(weights.begin(), weights.end()) - weights.begin());
  std::swap(ids[0], ids[heaviest]);
  std::swap(weights[0], weights[heaviest]);
  for (std::size_t k = 1; k < 4; k++)
    if (weights[k] == 0) ids[k] = ids[0];
  stencil.ids[i] = ids;
  stencil.weights[i] = weights;
}

}  // namespace

void find_stencils(const MeshView &mesh, Span<const Triangle> boundary, Span<const Vec3> points,
                   Span<const std::int32_t> solid, std::int64_t leaf, Job &job, Stencil &stencil) {
  Array<Place> places(&job.memory);
  locate(mesh, boundary, points, solid, leaf, job, places);
  grow(stencil.ids, points.size(), job);
  grow(stencil.weights, points.size(), job);
  for_each(points.size(), job, [&](std::size_t i) {
    const Place &place = places[i];
    if (place.tet >= 0) {
      write_entry(mesh.tets[std::size_t(place.tet)], place.weights, i, stencil);
    } else {
      const Triangle &t = boundary[std::size_t(place.triangle)];
      write_entry({t[0], t[1], t[2], t[0]}, place.weights, i, stencil);
    }
  });
}

}  // namespace tetlod
