#include "meshes.hpp"

#include <cmath>
#include <iterator>
#include <utility>

#include "demand.hpp"

namespace fuzz {

namespace {

constexpr int side = 3;

constexpr std::uint32_t cell(int x, int y, int z) { return 1u << (9 * z + 3 * y + x); }

constexpr std::uint32_t whole = (1u << 27) - 1;

constexpr std::uint32_t block(int nx, int ny, int nz) {
  std::uint32_t cells = 0;
  for (int z = 0; z < nz; z++)
    for (int y = 0; y < ny; y++)
      for (int x = 0; x < nx; x++) cells |= cell(x, y, z);
  return cells;
}

constexpr std::uint32_t known[] = {
    cell(0, 0, 0),
    block(2, 1, 1),                                                 // two cells that share a face
    block(2, 2, 2),                                                 // one vertex inside
    block(3, 3, 1),                                                 // a plate
    block(3, 1, 1),                                                 // a rod
    cell(0, 0, 0) | cell(1, 1, 0),                                  // ... an edge
    cell(0, 0, 0) | cell(1, 1, 1),                                  // ... a vertex
    cell(0, 0, 0) | cell(2, 2, 2),                                  // ... nothing
    whole & ~cell(1, 1, 1),                                         // a cavity
    block(3, 3, 1) & ~cell(1, 1, 0),                                // a ring
    whole & ~(cell(1, 1, 1) | cell(1, 1, 0)),                       // a dent
    whole & ~(cell(1, 1, 1) | cell(0, 1, 0)),                       // a cavity that touches a dent at an edge
    whole & ~(cell(1, 1, 1) | cell(0, 0, 0)),                       // ... at a vertex
    whole & ~(cell(1, 1, 0) | cell(1, 1, 1) | cell(1, 1, 2)),       // a tube
    cell(0, 0, 0) | cell(2, 0, 0) | cell(0, 2, 0) | cell(0, 0, 2),  // four solids
    whole,
};

std::int64_t number(int x, int y, int z) { return (z * (side + 1) + y) * (side + 1) + x; }

/// Six tets around the diagonal; the same in each cell, so that neighbours agree.
void add_cell(int x, int y, int z, Mesh &mesh) {
  static constexpr int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (const auto &axes : order) {
    std::array<int, 3> at = {x, y, z};
    Corners tet{number(x, y, z), 0, 0, 0};
    for (std::size_t step = 0; step < 3; step++) {
      at[std::size_t(axes[step])]++;
      tet[step + 1] = number(at[0], at[1], at[2]);
    }
    mesh.tets.push_back(tet);
  }
}

/// Points that no tet uses go, the others keep their order.
void drop_unused(Mesh &mesh) {
  std::vector<std::int64_t> renamed(mesh.points.size(), -1);
  for (const Corners &tet : mesh.tets)
    for (const std::int64_t v : tet) renamed[std::size_t(v)] = 0;
  std::size_t kept = 0;
  for (std::size_t v = 0; v < renamed.size(); v++) {
    if (renamed[v] < 0) continue;
    mesh.points[kept] = mesh.points[v];
    renamed[v] = std::int64_t(kept++);
  }
  mesh.points.resize(kept);
  for (Corners &tet : mesh.tets)
    for (std::int64_t &v : tet) v = renamed[std::size_t(v)];
}

}  // namespace

std::uint32_t known_cells(std::size_t which) { return known[which % std::size(known)]; }
std::size_t known_cells_count() { return std::size(known); }

Mesh grid_mesh(std::uint32_t cells) {
  Mesh mesh;
  mesh.sound = (cells & whole) != 0;
  for (int z = 0; z <= side; z++)
    for (int y = 0; y <= side; y++)
      for (int x = 0; x <= side; x++) mesh.points.push_back({double(x), double(y), double(z)});
  for (int z = 0; z < side; z++)
    for (int y = 0; y < side; y++)
      for (int x = 0; x < side; x++)
        if (cells & cell(x, y, z)) add_cell(x, y, z, mesh);
  drop_unused(mesh);
  return mesh;
}

void jitter(Mesh &mesh, Bytes &in) {
  for (Point &p : mesh.points)
    for (double &x : p) x += double(in.raw<std::int8_t>()) / 1024;
}

void turn(Mesh &mesh, Bytes &in) {
  const double shear = double(in.raw<std::int8_t>()) / 64;
  const std::size_t way = in.below(3);
  for (Point &p : mesh.points) {
    const Point q = {0.75 * p[0] - 0.5 * p[1] + 0.25 * p[2], 0.5 * p[0] + 0.75 * p[1] - 0.125 * p[2],
                     p[2] + shear * p[0] - 0.25 * p[1]};
    if (way) p = {q[way % 3], q[(way + 1) % 3], q[(way + 2) % 3]};
  }
}

void scale(Mesh &mesh, const std::array<int, 3> &exponents) {
  for (Point &p : mesh.points)
    for (std::size_t k = 0; k < 3; k++) p[k] *= std::pow(10.0, exponents[k]);
}

Mesh lattice_mesh(Bytes &in) {
  Mesh mesh;
  const std::size_t steps = 2 + in.below(3), points = 4 + in.below(32), tets = 1 + in.below(60);
  for (std::size_t i = 0; i < points; i++) {
    const std::size_t place = in.below(steps * steps * steps);
    mesh.points.push_back({double(place % steps), double(place / steps % steps), double(place / steps / steps)});
  }
  for (std::size_t t = 0; t < tets; t++) {
    Corners tet;
    for (std::int64_t &v : tet) v = std::int64_t(in.below(points));
    mesh.tets.push_back(tet);
  }
  return mesh;
}

Mesh raw_mesh(Bytes &in) {
  Mesh mesh;
  const std::size_t points = in.below(24), tets = in.below(24);
  for (std::size_t i = 0; i < points; i++) mesh.points.push_back({in.real(), in.real(), in.real()});
  const bool wild = in.one_in(4);
  for (std::size_t t = 0; t < tets; t++) {
    Corners tet;
    for (std::int64_t &v : tet) v = wild ? in.raw<std::int64_t>() : std::int64_t(in.below(points));
    mesh.tets.push_back(tet);
  }
  return mesh;
}

void trace(const Mesh &mesh) {
  for (std::size_t i = 0; i < mesh.points.size(); i++) {
    const Point &p = mesh.points[i];
    trace("v %zu  %.17g %.17g %.17g  %.17g\n", i, p[0], p[1], p[2], i < mesh.values.size() ? mesh.values[i] : 0);
  }
  for (const Corners &t : mesh.tets)
    trace("t %lld %lld %lld %lld\n", (long long)t[0], (long long)t[1], (long long)t[2], (long long)t[3]);
  trace("%zu points, %zu tets, %s\n", mesh.points.size(), mesh.tets.size(), mesh.sound ? "sound" : "perhaps not sound");
}

}  // namespace fuzz
