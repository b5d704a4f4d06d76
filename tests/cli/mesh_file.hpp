// Small meshes as legacy .vtk files in ASCII, written by hand: the unit cube cut into size^3 cells of one kind.
#pragma once

#include <string>

namespace cli_test {

enum class Kind { tet, hexahedron, voxel, wedge, pyramid, quadratic_tet, quadratic_hexahedron, polyhedron };

struct Cube {
  Kind kind = Kind::tet;
  int size = 6;
  std::string real = "double";  // type of coordinates and other values: float or double
  std::string heat = "double";  // type of its values
  double hottest = 6;           // value of "heat" in the last corner
  std::string other = "other";  // its name, encoded as the format has it
  std::string integer;          // int or vtktypeint64: format 5.1; empty: format 4.2
  double shift = 0;             // of all points along x
  double dent = 0;              // how far the middle of its top, of even size, is pushed in
  bool with_triangle = false;   // beside the volume cells
  bool with_bad_index = false;  // in the last cell
  bool vectors_alone = false;   // no scalars
  bool cells_alone = false;     // no point data
  bool one_part = false;        // all cells are of part 7
};

// Point data: the active scalars "heat" = x + 2 y + 3 z, as a part of `hottest`, further scalars "other" = x, vectors
// "flow" = (0, -x, 0). Cell data: "part", 5 or 6 in turns.
void write_cube(const std::string &path, const Cube &cube);

// The text of a .vtu file with the scalars "heat" and further point data, and the cell's type.
std::string one_tet_in_xml(const std::string &point_data, const std::string &type = "10");

}  // namespace cli_test
