// The plain structs that the stages hand to each other.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "memory.hpp"
#include "values.hpp"

namespace tetlod {

using Vec3 = glm::dvec3;
using Tet = std::array<std::int32_t, 4>;
using Triangle = std::array<std::int32_t, 3>;

/// Vertices and tets are numbered with 32 bits inside, and TetGen overflows beyond this many tets.
constexpr std::int64_t max_count = (std::int64_t(1) << 29) - 1;

/// A borrowed piece of contiguous memory.
template <class T>
class Span {
 public:
  constexpr Span() = default;
  constexpr Span(T *data, std::size_t size) : data_(data), size_(size) {}
  template <class U>
  Span(const Array<U> &array) : data_(array.data()), size_(array.size()) {}
  constexpr T *data() const { return data_; }
  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr T &operator[](std::size_t i) const { return data_[i]; }
  constexpr T *begin() const { return data_; }
  constexpr T *end() const { return data_ + size_; }

 private:
  T *data_ = nullptr;
  std::size_t size_ = 0;
};

/// The original mesh as the stages read it. Tets may have either winding; a point that no tet uses is allowed.
struct MeshView {
  Span<const Vec3> points;
  Span<const double> scalars;  ///< of each point, one of each field that steers
  Span<const Tet> tets;
  std::size_t fields = 1;
  FieldScales scales{};
  Span<const std::uint8_t> used{};   ///< of each point, whether a tet has it; empty: nobody has looked
  Span<const std::int32_t> solid{};  ///< of each point, where solids are in contact, else empty; -1: of several
  Span<const Vec3> submitted{};      ///< where points were submitted, if some have been moved since; else empty

  /// Of point v, where errors are measured.
  const Vec3 &place(std::size_t v) const { return submitted.empty() ? points[v] : submitted[v]; }

  template <std::size_t m>
  Span<const Values<m>> values() const {
    return {reinterpret_cast<const Values<m> *>(scalars.data()), scalars.size() / m};
  }
};

inline MeshView without_fields(Span<const Vec3> points, Span<const Tet> tets) {
  MeshView mesh{points, {}, tets};
  mesh.fields = 0;
  return mesh;
}

inline bool has_repeated_vertex(const Tet &t) {
  return t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] || t[1] == t[3] || t[2] == t[3];
}

/// The corners of the face opposite corner k, seen counter-clockwise from outside a tet with
/// det(p1 - p0, p2 - p0, p3 - p0) > 0.
constexpr int tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

inline Triangle face_opposite(const Tet &t, std::size_t corner) {
  const int *const face = tet_face[corner];
  return {t[std::size_t(face[0])], t[std::size_t(face[1])], t[std::size_t(face[2])]};
}

inline bool has(const Tet &t, std::int32_t v) { return (t[0] == v) | (t[1] == v) | (t[2] == v) | (t[3] == v); }
inline bool has(const Triangle &t, std::int32_t v) { return (t[0] == v) | (t[1] == v) | (t[2] == v); }

template <class Simplex, class Vertices>
bool has_all(const Simplex &simplex, const Vertices &vertices) {
  bool all = true;  // without branches
  for (std::int32_t v : vertices) all &= has(simplex, v);
  return all;
}

/// A closed surface, triangles counter-clockwise seen from outside the solid. It may touch itself at
/// vertices and along edges where the solid does (an edge then has four or more triangles).
struct Surface {
  explicit Surface(Memory &memory) : points(&memory), scalars(&memory), origin(&memory), triangles(&memory) {}
  Array<Vec3> points;
  Array<double> scalars;       ///< of each point, one of each field that steers
  Array<std::int32_t> origin;  ///< the original vertex a point is, or -1 where decimation placed it
  Array<Triangle> triangles;
  std::size_t fields = 1;
};

/// A simplified mesh: every tet positive, boundary vertices first.
struct TetMesh {
  explicit TetMesh(Memory &memory)
      : points(&memory), scalars(&memory), tets(&memory), boundary(&memory), solid(&memory) {}
  Array<Vec3> points;
  Array<double> scalars;  ///< one a point; while it is being made, one of each field that steers
  Array<Tet> tets;
  Array<Triangle> boundary;   ///< faces used once, outward
  Array<std::int32_t> solid;  ///< of each point, the original's that it is of, where MeshView::solid says of several
};

/// Of a tet or a triangle, by its corners; -1: not known.
template <class Corners>
std::int32_t solid_of(Span<const std::int32_t> of_points, const Corners &corners) {
  std::int32_t solid = -1;
  for (const std::int32_t v : corners) solid = std::max(solid, of_points[std::size_t(v)]);
  return solid;
}

/// Two are the same, or one of them is not known.
inline bool may_be_one(std::int32_t a, std::int32_t b) { return a < 0 || b < 0 || a == b; }

struct Box {
  Vec3 low{std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity()};
  void add(const Vec3 &p) {
    for (int k = 0; k < 3; k++) {
      low[k] = p[k] < low[k] ? p[k] : low[k];
      high[k] = p[k] > high[k] ? p[k] : high[k];
    }
  }
  void add(const Box &other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  double diagonal() const { return glm::length(high - low); }
  double largest_coordinate() const {
    double largest = 0;
    for (int k = 0; k < 3; k++) largest = std::max({largest, std::abs(low[k]), std::abs(high[k])});
    return largest;
  }
  int longest_axis() const {
    const Vec3 extent = high - low;
    return extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  }
};

inline bool overlap(const Box &a, const Box &b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// Of two that overlap.
inline Box common(const Box &a, const Box &b) { return {glm::max(a.low, b.low), glm::min(a.high, b.high)}; }

/// 0 inside.
inline double distance2(const Box &box, const Vec3 &p) {
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    const double d = std::max(0.0, std::max(box.low[k] - p[k], p[k] - box.high[k]));
    sum += d * d;
  }
  return sum;
}

/// Of a triangle or tet.
template <std::size_t corners>
Box box_of(Span<const Vec3> points, const std::array<std::int32_t, corners> &simplex) {
  Box box;
  for (std::int32_t v : simplex) box.add(points[std::size_t(v)]);
  return box;
}

inline Box box_of(Span<const Vec3> points) {
  Box box;
  for (const Vec3 &p : points) box.add(p);
  return box;
}

}  // namespace tetlod
