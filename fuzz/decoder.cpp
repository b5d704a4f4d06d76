#include "decoder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace fuzz {

namespace {

constexpr std::size_t most_tets = 220;

Mesh decode_grid(Bytes &in) {
  const std::uint32_t cells = in.one_in(3) ? in.raw<std::uint32_t>() : known_cells(in.below(known_cells_count()));
  Mesh mesh = grid_mesh(cells);
  if (in.one_in(2)) jitter(mesh, in);
  if (in.one_in(2)) turn(mesh, in);
  return mesh;
}

Mesh decode_kind(Bytes &in) {
  switch (in.below(8)) {
    case 0: return raw_mesh(in);
    case 1:
    case 2: return lattice_mesh(in);
    default: return decode_grid(in);
  }
}

// ---- The field -----------------------------------------------------------------------------------------------------

double smooth(const Point &p) { return p[0] + 2 * p[1] * p[1] - p[2] * p[0]; }

void decode_values(Bytes &in, Mesh &mesh) {
  const std::size_t kind = in.below(6);
  const double factor = kind == 5 ? in.real() : 1;
  for (const Point &p : mesh.points) {
    switch (kind) {
      case 0: mesh.values.push_back(smooth(p)); break;
      case 1: mesh.values.push_back(7); break;
      case 2: mesh.values.push_back(double(in.raw<std::int8_t>())); break;
      case 3: mesh.values.push_back(p[0] > 1 ? 1 : 0); break;
      case 4: mesh.values.push_back(in.real()); break;
      default: mesh.values.push_back(factor * smooth(p));
    }
    if (!std::isfinite(mesh.values.back())) mesh.sound = false;
  }
}

// ---- Edits ---------------------------------------------------------------------------------------------------------

template <class T>
T &any_of(std::vector<T> &things, Bytes &in) {
  return things[in.below(things.size())];
}

void move_point(Mesh &mesh, Bytes &in) {
  mesh.sound = false;
  Point &p = any_of(mesh.points, in);
  switch (in.below(4)) {
    case 0: p = any_of(mesh.points, in); break;
    case 1: p[in.below(3)] = in.real(); break;
    case 2: p = {double(in.below(4)), double(in.below(4)), double(in.below(4))}; break;
    default: p[in.below(3)] += double(in.raw<std::int8_t>()) / 64;
  }
}

void spoil_point(Mesh &mesh, Bytes &in) {
  mesh.sound = false;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  any_of(mesh.points, in)[in.below(3)] = in.one_in(2) ? infinity : std::nan("");
}

void spoil_value(Mesh &mesh, Bytes &in) {
  mesh.sound = false;
  any_of(mesh.values, in) = std::nan("");
}

/// Either winding is allowed.
void swap_corners(Mesh &mesh, Bytes &in) {
  Corners &tet = any_of(mesh.tets, in);
  std::swap(tet[in.below(4)], tet[in.below(4)]);
}

/// What is left is a sound mesh, as long as something is.
void drop_tets(Mesh &mesh, Bytes &in) {
  const std::size_t first = in.below(mesh.tets.size());
  const std::size_t count = std::min(1 + in.below(8), mesh.tets.size() - first);
  mesh.tets.erase(mesh.tets.begin() + std::ptrdiff_t(first), mesh.tets.begin() + std::ptrdiff_t(first + count));
  mesh.sound = mesh.sound && !mesh.tets.empty();
}

/// Duplicates are left out by default.
void duplicate_tet(Mesh &mesh, Bytes &in) {
  Corners tet = any_of(mesh.tets, in);
  std::swap(tet[in.below(4)], tet[in.below(4)]);
  mesh.tets.push_back(tet);
}

void retarget_corner(Mesh &mesh, Bytes &in) {
  mesh.sound = false;
  std::int64_t &corner = any_of(mesh.tets, in)[in.below(4)];
  corner = in.one_in(8) ? in.raw<std::int64_t>() : in.between(-1, mesh.point_count());
}

/// One point becomes two at the same place, for some of its tets. They are merged by default.
void split_point(Mesh &mesh, Bytes &in) {
  const std::size_t old = in.below(mesh.points.size());
  mesh.points.push_back(Point(mesh.points[old]));
  mesh.values.push_back(mesh.values[old]);
  for (Corners &tet : mesh.tets)
    for (std::int64_t &v : tet)
      if (v == std::int64_t(old) && in.one_in(2)) v = mesh.point_count() - 1;
}

/// No tet uses it, so it may be anything.
void add_unused_point(Mesh &mesh, Bytes &in) {
  mesh.points.push_back({in.real(), in.real(), in.real()});
  mesh.values.push_back(in.real());
}

void scale_all(Mesh &mesh, Bytes &in) {
  const int exponent = int(in.between(-300, 300));
  scale(mesh, {exponent, exponent, exponent});
}

/// A plate or a needle.
void flatten(Mesh &mesh, Bytes &in) {
  std::array<int, 3> exponents{};
  exponents[in.below(3)] = -int(in.below(16));
  scale(mesh, exponents);
}

double extent(const std::vector<Point> &points, std::size_t axis) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Point &p : points) {
    low = std::min(low, p[axis]);
    high = std::max(high, p[axis]);
  }
  return high - low;
}

/// Far from the origin, in extents: the coordinates are rounded, and tets with them.
void shift_all(Mesh &mesh, Bytes &in) {
  const int exponent = int(in.below(20));
  if (exponent > 5) mesh.sound = false;
  const std::size_t axis = in.below(3);
  const double offset = std::ldexp(in.one_in(2) ? -1.0 : 1.0, exponent) * extent(mesh.points, axis);
  for (Point &p : mesh.points) p[axis] += offset;
}

using Edit = void (*)(Mesh &, Bytes &);
constexpr Edit edits[] = {move_point,      spoil_point, spoil_value,      swap_corners, drop_tets, duplicate_tet,
                          retarget_corner, split_point, add_unused_point, scale_all,    flatten,   shift_all,
                          move_point,      drop_tets,   drop_tets,        swap_corners};

void edit(Mesh &mesh, Bytes &in) {
  for (std::size_t count = in.below(6); count > 0; count--) {
    if (mesh.points.empty() || mesh.tets.empty()) return;
    edits[in.below(std::size(edits))](mesh, in);
  }
}

std::vector<Point> used_points(const Mesh &mesh) {
  std::vector<Point> used;
  for (const Corners &tet : mesh.tets)
    for (const std::int64_t v : tet)
      if (v >= 0 && v < mesh.point_count()) used.push_back(mesh.points[std::size_t(v)]);
  return used;
}

/// At the ends of the range of doubles the edits have rounded too much away, and TetGen may fail on plates and needles
/// thinner than a millionth.
void judge_range(Mesh &mesh) {
  const std::vector<Point> used = used_points(mesh);
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t axis = 0; axis < 3; axis++) {
    least = std::min(least, extent(used, axis));
    most = std::max(most, extent(used, axis));
    for (const Point &p : used) {
      const double size = std::abs(p[axis]);
      if (!(size < 1e305) || (size != 0 && size < 1e-305)) mesh.sound = false;
    }
  }
  if (!(least > 1e-6 * most)) mesh.sound = false;
}

}  // namespace

Mesh decode_mesh(Bytes &in) {
  Mesh mesh = decode_kind(in);
  decode_values(in, mesh);
  edit(mesh, in);
  if (mesh.tets.size() > most_tets) mesh.tets.resize(most_tets);
  judge_range(mesh);
  static long meshes = 0;
  mesh.id = ++meshes;
  return mesh;
}

std::int32_t decode_option(Bytes &in) { return in.one_in(16) ? in.raw<std::int32_t>() : std::int32_t(in.below(24)); }

Setting decode_value(std::int32_t option, const Bounds &bounds, Bytes &in) {
  Setting setting;
  setting.option = option;
  const double width = std::min(bounds.most, 2.0) - bounds.least;
  switch (in.below(8)) {
    case 0: setting.real = bounds.least; break;
    case 1: setting.real = bounds.integer ? std::min(bounds.most, 8.0) : bounds.most; break;
    case 2: setting.real = bounds.preset; break;
    case 3: setting.real = in.real(); break;
    case 4: setting.real = bounds.least + width * in.fraction() * in.fraction() * in.fraction(); break;
    default: setting.real = bounds.least + width * in.fraction();
  }
  const bool fits = std::abs(setting.real) < 9e18;
  setting.integer = fits ? std::int64_t(setting.real) : in.raw<std::int64_t>();
  return setting;
}

}  // namespace fuzz
