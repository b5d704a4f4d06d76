#include "mesh_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

namespace cli_test {
namespace {

using Node = std::array<int, 3>;
using Ids = std::vector<long>;

struct Cell {
  int type;
  Ids ids;
};

// Points stand on a lattice; cells are `step` wide in it. Kinds with points between their corners need two steps.
class Lattice {
 public:
  Lattice(const Cube &cube, int step)
      : size_(cube.size), step_(step), row_(cube.size * step + 1), shift_(cube.shift), dent_(cube.dent) {}

  int step() const { return step_; }
  long points() const { return static_cast<long>(row_) * row_ * row_; }
  long id(const Node &n) const { return (static_cast<long>(n[2]) * row_ + n[1]) * row_ + n[0]; }
  std::array<double, 3> point(const Node &n) const {
    const double whole = row_ - 1;
    const bool is_dented = n[0] == row_ / 2 && n[1] == row_ / 2 && n[2] == row_ - 1;
    return {n[0] / whole + shift_, n[1] / whole, n[2] / whole - (is_dented ? dent_ : 0)};
  }

  template <class Use>
  void for_each_node(const Use &use) const {
    for_each({row_, row_, row_}, 1, use);
  }
  template <class Use>
  void for_each_cell(const Use &use) const {
    for_each({size_, size_, size_}, step_, use);
  }

 private:
  template <class Use>
  static void for_each(const Node &counts, int step, const Use &use) {
    for (int k = 0; k < counts[2]; k++) {
      for (int j = 0; j < counts[1]; j++) {
        for (int i = 0; i < counts[0]; i++) use(Node{i * step, j * step, k * step});
      }
    }
  }

  int size_, step_, row_;
  double shift_, dent_;
};

// Corner `c` of a cell: bits 0, 1, 2 are x, y, z.
Node corner(const Node &cell, int c, int step) {
  return {cell[0] + step * (c & 1), cell[1] + step * ((c >> 1) & 1), cell[2] + step * ((c >> 2) & 1)};
}

Node middle(const Node &a, const Node &b) { return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}; }

Ids ids_of(const Lattice &lattice, const std::vector<Node> &nodes) {
  Ids ids;
  for (const Node &node : nodes) ids.push_back(lattice.id(node));
  return ids;
}

std::vector<Node> corners(const Lattice &lattice, const Node &cell, const std::vector<int> &which) {
  std::vector<Node> nodes;
  for (int c : which) nodes.push_back(corner(cell, c, lattice.step()));
  return nodes;
}

const std::vector<int> kHexahedron = {0, 1, 3, 2, 4, 5, 7, 6};
const std::vector<std::vector<int>> kSixTets = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7},
                                                {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};
const std::vector<std::vector<int>> kSides = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                              {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

void add_middles(std::vector<Node> &nodes, const std::vector<std::array<int, 2>> &edges) {
  for (const auto &[a, b] : edges) {
    nodes.push_back(middle(nodes[static_cast<std::size_t>(a)], nodes[static_cast<std::size_t>(b)]));
  }
}

std::vector<Cell> tets(const Lattice &lattice, const Node &cell, bool quadratic) {
  std::vector<Cell> cells;
  for (const auto &which : kSixTets) {
    std::vector<Node> nodes = corners(lattice, cell, which);
    if (quadratic) add_middles(nodes, {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}});
    cells.push_back({quadratic ? 24 : 10, ids_of(lattice, nodes)});
  }
  return cells;
}

std::vector<Cell> hexahedron(const Lattice &lattice, const Node &cell, bool quadratic) {
  std::vector<Node> nodes = corners(lattice, cell, kHexahedron);
  if (quadratic) {
    add_middles(nodes,
                {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}});
  }
  return {{quadratic ? 25 : 12, ids_of(lattice, nodes)}};
}

std::vector<Cell> pyramids(const Lattice &lattice, const Node &cell) {
  std::vector<Cell> cells;
  const Node top = middle(corner(cell, 0, lattice.step()), corner(cell, 7, lattice.step()));
  for (const auto &side : kSides) {
    std::vector<Node> nodes = corners(lattice, cell, side);
    nodes.push_back(top);
    cells.push_back({14, ids_of(lattice, nodes)});
  }
  return cells;
}

// A face stream: how many faces, then each with its size.
Cell polyhedron(const Lattice &lattice, const Node &cell) {
  Ids stream = {static_cast<long>(kSides.size())};
  for (const auto &side : kSides) {
    const Ids ids = ids_of(lattice, corners(lattice, cell, side));
    stream.push_back(static_cast<long>(ids.size()));
    stream.insert(stream.end(), ids.begin(), ids.end());
  }
  return {42, stream};
}

std::vector<Cell> cells_of(Kind kind, const Lattice &lattice, const Node &cell) {
  const auto ids = [&](const std::vector<int> &which) { return ids_of(lattice, corners(lattice, cell, which)); };
  switch (kind) {
    case Kind::tet: return tets(lattice, cell, false);
    case Kind::quadratic_tet: return tets(lattice, cell, true);
    case Kind::hexahedron: return hexahedron(lattice, cell, false);
    case Kind::quadratic_hexahedron: return hexahedron(lattice, cell, true);
    case Kind::voxel: return {{11, ids({0, 1, 2, 3, 4, 5, 6, 7})}};
    case Kind::wedge: return {{13, ids({0, 1, 3, 4, 5, 7})}, {13, ids({0, 3, 2, 4, 7, 6})}};
    case Kind::pyramid: return pyramids(lattice, cell);
    case Kind::polyhedron: return {polyhedron(lattice, cell)};
  }
  return {};
}

bool has_middles(Kind kind) {
  return kind == Kind::pyramid || kind == Kind::quadratic_tet || kind == Kind::quadratic_hexahedron;
}

std::vector<Cell> all_cells(const Cube &cube, const Lattice &lattice) {
  std::vector<Cell> cells;
  lattice.for_each_cell([&](const Node &cell) {
    for (Cell &part : cells_of(cube.kind, lattice, cell)) cells.push_back(std::move(part));
  });
  if (cube.with_triangle) cells.push_back({5, {0, 1, 2}});
  if (cube.with_bad_index) cells.back().ids.back() = lattice.points();
  return cells;
}

void write_cells(std::ostream &file, const std::vector<Cell> &cells) {
  std::size_t numbers = cells.size();
  for (const Cell &cell : cells) numbers += cell.ids.size();
  file << "CELLS " << cells.size() << ' ' << numbers << '\n';
  for (const Cell &cell : cells) {
    file << cell.ids.size();
    for (long id : cell.ids) file << ' ' << id;
    file << '\n';
  }
}

void write_cells_5(std::ostream &file, const std::vector<Cell> &cells, const std::string &integer) {
  std::size_t numbers = 0;
  for (const Cell &cell : cells) numbers += cell.ids.size();
  file << "CELLS " << cells.size() + 1 << ' ' << numbers << "\nOFFSETS " << integer << "\n0\n";
  numbers = 0;
  for (const Cell &cell : cells) file << (numbers += cell.ids.size()) << '\n';
  file << "CONNECTIVITY " << integer << '\n';
  for (const Cell &cell : cells) {
    for (long id : cell.ids) file << id << ' ';
    file << '\n';
  }
}

void write_points(std::ostream &file, const Cube &cube, const Lattice &lattice) {
  file << "POINTS " << lattice.points() << ' ' << cube.real << '\n';
  lattice.for_each_node([&](const Node &n) {
    for (double x : lattice.point(n)) file << x << ' ';
    file << '\n';
  });
}

void write_scalars(std::ostream &file, const Cube &cube, const Lattice &lattice) {
  file << "SCALARS heat " << cube.heat << " 1\nLOOKUP_TABLE default\n";
  lattice.for_each_node([&](const Node &n) {
    const auto [x, y, z] = lattice.point(n);
    file << cube.hottest / 6 * (x + 2 * y + 3 * z) << '\n';
  });
  file << "SCALARS " << cube.other << ' ' << cube.real << " 1\nLOOKUP_TABLE default\n";
  lattice.for_each_node([&](const Node &n) { file << lattice.point(n)[0] << '\n'; });
}

void write_point_data(std::ostream &file, const Cube &cube, const Lattice &lattice) {
  file << "POINT_DATA " << lattice.points() << '\n';
  if (!cube.vectors_alone) write_scalars(file, cube, lattice);
  file << "VECTORS flow float\n";
  lattice.for_each_node([&](const Node &n) { file << "0 " << -lattice.point(n)[0] << " 0\n"; });
}

}  // namespace

void write_cube(const std::string &path, const Cube &cube) {
  const Lattice lattice(cube, has_middles(cube.kind) ? 2 : 1);
  const std::vector<Cell> cells = all_cells(cube, lattice);
  std::ofstream file(path);
  file.precision(17);
  file << "# vtk DataFile Version " << (cube.integer.empty() ? "4.2" : "5.1") << "\ncube\nASCII\n";
  file << "DATASET UNSTRUCTURED_GRID\n";
  write_points(file, cube, lattice);
  if (cube.integer.empty()) {
    write_cells(file, cells);
  } else {
    write_cells_5(file, cells, cube.integer);
  }
  file << "CELL_TYPES " << cells.size() << '\n';
  for (const Cell &cell : cells) file << cell.type << '\n';
  file << "CELL_DATA " << cells.size() << "\nSCALARS part int 1\nLOOKUP_TABLE default\n";
  for (std::size_t i = 0; i < cells.size(); i++) file << (cube.one_part ? 7 : 5 + i % 2) << '\n';
  if (!cube.cells_alone) write_point_data(file, cube, lattice);
}

std::string one_tet_in_xml(const std::string &point_data, const std::string &type) {
  return R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1"><PointData Scalars="heat">
<DataArray type="Float64" Name="heat" format="ascii">0 1 2 3</DataArray>)" +
         point_data + R"(</PointData><Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">)" +
         type + R"(</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>)";
}

}  // namespace cli_test
