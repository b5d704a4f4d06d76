// Meshes to fuzz with, as a host has them: nothing of the library is in here.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bytes.hpp"

namespace fuzz {

using Point = std::array<double, 3>;
using Corners = std::array<std::int64_t, 4>;

struct Mesh {
  std::vector<Point> points;
  std::vector<double> values;  ///< one a point
  std::vector<Corners> tets;
  bool sound = false;  ///< nothing is wrong with it that is not repaired: a run has to succeed
  long id = 0;         ///< another for each mesh that was decoded

  std::int64_t point_count() const { return std::int64_t(points.size()); }
};

/// Cells of a 3 x 3 x 3 grid, 6 tets each, that fit together: solids with cavities, handles, several components, solids
/// that touch at vertices and edges. Bit 9 z + 3 y + x of `cells` is the cell (x, y, z).
Mesh grid_mesh(std::uint32_t cells);

/// Sets of cells that mean something: one cell, a block, a cavity, a ring, two cells that share a vertex, an edge, ...
std::uint32_t known_cells(std::size_t which);
std::size_t known_cells_count();

/// Bends the mesh without harm: each coordinate moves by less than a fifth of a cell, and all are multiples of 2^-10.
void jitter(Mesh &mesh, Bytes &in);
/// A shear and a turn by fractions that are exact.
void turn(Mesh &mesh, Bytes &in);
/// Times a power of ten on each axis.
void scale(Mesh &mesh, const std::array<int, 3> &exponents);

/// Few places and many tets on them: coincident points, flat, inverted, duplicate, overlapping, non-manifold tets.
Mesh lattice_mesh(Bytes &in);

/// Whatever the bytes say.
Mesh raw_mesh(Bytes &in);

/// For a reader, see trace().
void trace(const Mesh &mesh);

}  // namespace fuzz
