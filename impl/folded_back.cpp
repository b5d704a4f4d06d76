#include "folded_back.hpp"

#include "lies_on.hpp"
#include "triangle_corners.hpp"

namespace tetlod {

Array<std::pair<std::int32_t, std::int32_t>> find_folded_back(const NumberedTets &tets, Job &job) {
  const Boundary &boundary = tets.boundary;
  const TriangleCorners corners(tets.points.size(), boundary.triangles, job);
  const auto normal = [&](std::int32_t triangle) {
    return area_vector(tets.points, boundary.triangles[std::size_t(triangle)]);
  };
  Array<std::pair<std::int32_t, std::int32_t>> found(&job.memory);
  for (std::size_t v = 0; v < tets.points.size(); v++) {
    if (v % 256 == 0) job.poll(0.9);  // at some there is much to look at
    const Span<const Corner> at = corners.of(std::int32_t(v));
    for (const Corner &one : at)
      for (const Corner &other : at)
        if (one.next == other.last && std::int32_t(v) < one.next &&
            are_back_to_back(normal(one.triangle), normal(other.triangle)))
          found.emplace_back(boundary.tet_of[std::size_t(one.triangle)], boundary.tet_of[std::size_t(other.triangle)]);
  }
  return found;
}

}  // namespace tetlod
