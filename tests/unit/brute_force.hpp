// What the tests compare with: slow, simple, and without a line of the library's own geometry.
#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesh.hpp"
#include "meshes.hpp"

namespace tetlod::test {

/// Counts over a surface, edges by their two vertices.
struct SurfaceFacts {
  std::int64_t vertices = 0, edges = 0, triangles = 0;
  std::int64_t euler = 0;
  std::int64_t components = 0;         ///< triangles that share a vertex are of one
  std::int64_t nonmanifold_edges = 0;  ///< with more than two triangles
  bool closed = true;                  ///< every edge is run through as often one way as the other
};
SurfaceFacts facts_of(Span<const Triangle> triangles);

/// By the divergence theorem.
double volume_inside(Span<const Vec3> points, Span<const Triangle> triangles);

/// The triangle with its lowest corner first, the winding kept: equal for equal oriented triangles.
Triangle lowest_first(Triangle t);
std::multiset<Triangle> oriented_triangles(Span<const Triangle> triangles);

/// Faces used once, outward, by a map of all faces.
std::multiset<Triangle> brute_boundary(const Mesh &mesh);

/// Pairs of triangles that share more than the vertices they have in common.
std::vector<std::pair<std::int32_t, std::int32_t>> crossings(const Surface &surface, Memory &memory);

/// 1 inside, 0 outside: the sum of the solid angles over 4 pi.
double winding_number(Span<const Vec3> points, Span<const Triangle> triangles, const Vec3 &p);

struct BruteNearest {
  std::int32_t triangle = -1;
  double distance = 0;
  Vec3 point{0};
};
BruteNearest brute_nearest(Span<const Vec3> points, Span<const Triangle> triangles, const Vec3 &p);

/// Of a mesh's values at the original's vertices, each in the tet that it is least outside of, by at most 1e-6 of a
/// weight; over the original's range.
double brute_largest_error(const Mesh &original, const TetMesh &mesh);

}  // namespace tetlod::test
