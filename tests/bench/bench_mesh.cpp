#include "bench_mesh.hpp"

#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace bench {
namespace {

namespace fs = std::filesystem;

// ---- A file ----

vtkDataArray *steering_array(vtkPointData &data) {
  if (vtkDataArray *const active = data.GetScalars()) return active;
  for (int i = 0; i < data.GetNumberOfArrays(); i++) {
    vtkDataArray *const array = data.GetArray(i);
    if (array != nullptr && array->GetNumberOfComponents() == 1) return array;
  }
  return nullptr;
}

std::vector<Point> points_of(vtkUnstructuredGrid &grid) {
  std::vector<Point> points(static_cast<std::size_t>(grid.GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); i++) grid.GetPoint(static_cast<vtkIdType>(i), points[i].data());
  return points;
}

std::vector<Tet> tets_of(vtkUnstructuredGrid &grid) {
  std::vector<Tet> tets;
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++) {
    if (grid.GetCellType(c) != VTK_TETRA) continue;
    grid.GetCellPoints(c, corners);
    Tet tet;
    for (int k = 0; k < 4; k++) tet[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(corners->GetId(k));
    tets.push_back(tet);
  }
  return tets;
}

std::vector<double> values_of(vtkDataArray &array) {
  std::vector<double> values(static_cast<std::size_t>(array.GetNumberOfTuples()));
  for (std::size_t i = 0; i < values.size(); i++) values[i] = array.GetTuple1(static_cast<vtkIdType>(i));
  return values;
}

// ---- The front ----

// A lattice of n cells along each axis over the unit cube.
struct Lattice {
  std::int32_t n;
  std::int32_t node(const std::array<std::int32_t, 3> &at) const { return (at[2] * (n + 1) + at[1]) * (n + 1) + at[0]; }
};

constexpr double kSteepness = 14.0;  // of the front, in units of the box's width
constexpr double kPi = 3.14159265358979323846;

double front_value(const Point &p, double time) {
  const double front = 0.2 + 0.6 * time + 0.12 * std::sin(kPi * (p[1] + 0.5 * p[2])) - 0.1 * p[2] * p[2];
  const double swell = 0.15 * std::cos(2.0 * kPi * p[1]) * std::sin(kPi * (p[0] + p[2]));
  return std::tanh(kSteepness * (p[0] - front)) + swell;
}

void add_points(const Lattice &lattice, double time, Mesh &mesh) {
  for (std::int32_t k = 0; k <= lattice.n; k++) {
    for (std::int32_t j = 0; j <= lattice.n; j++) {
      for (std::int32_t i = 0; i <= lattice.n; i++) {
        const Point p{double(i) / lattice.n, double(j) / lattice.n, double(k) / lattice.n};
        mesh.points.push_back(p);
        mesh.values.push_back(front_value(p, time));
      }
    }
  }
}

// The path from a cube's low to its high corner takes the axes in one of six orders; the odd ones are mirror images.
void add_cube(const Lattice &lattice, const std::array<std::int32_t, 3> &low, std::vector<Tet> &tets) {
  static constexpr std::size_t orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int order = 0; order < 6; order++) {
    std::array<std::int32_t, 3> at = low;
    Tet tet{lattice.node(at)};
    for (std::size_t step = 0; step < 3; step++) {
      at[orders[order][step]]++;
      tet[step + 1] = lattice.node(at);
    }
    if (order >= 3) std::swap(tet[2], tet[3]);
    tets.push_back(tet);
  }
}

void add_tets(const Lattice &lattice, std::vector<Tet> &tets) {
  for (std::int32_t k = 0; k < lattice.n; k++) {
    for (std::int32_t j = 0; j < lattice.n; j++) {
      for (std::int32_t i = 0; i < lattice.n; i++) add_cube(lattice, {i, j, k}, tets);
    }
  }
}

}  // namespace

double range_of(const std::vector<double> &values) {
  if (values.empty()) return 1.0;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most > *least ? *most - *least : 1.0;
}

Mesh read_mesh(const std::string &path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkUnstructuredGrid *const grid = reader->GetOutput();
  vtkDataArray *const field = steering_array(*grid->GetPointData());
  if (grid->GetNumberOfCells() == 0 || field == nullptr) {
    throw std::runtime_error(path + ": no mesh with a field in it");
  }
  return {points_of(*grid), tets_of(*grid), values_of(*field)};
}

std::optional<std::string> find_data(const std::string &name) {
  std::vector<fs::path> folders{fs::path(TETLOD_SOURCE_DIR) / ".." / "shared" / "data"};
  if (const char *const named = std::getenv("TETLOD_DATA_DIR")) folders.insert(folders.begin(), named);
  for (const fs::path &folder : folders) {
    if (fs::exists(folder / name)) return (folder / name).string();
  }
  return std::nullopt;
}

Mesh make_front_mesh(std::int64_t tets, double time) {
  const Lattice lattice{std::max<std::int32_t>(2, static_cast<std::int32_t>(std::lround(std::cbrt(double(tets) / 6))))};
  Mesh mesh;
  add_points(lattice, time, mesh);
  add_tets(lattice, mesh.tets);
  return mesh;
}

}  // namespace bench
