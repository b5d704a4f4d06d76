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
#include <cstdio>
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

// ---- Middles of edges ----

using Edge = std::array<std::int32_t, 2>;

Edge edge_of(const Tet &tet, std::size_t from, std::size_t to) {
  return {std::min(tet[from], tet[to]), std::max(tet[from], tet[to])};
}

constexpr std::size_t kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

std::vector<Edge> edges_of(const std::vector<Tet> &tets) {
  std::vector<Edge> edges;
  for (const Tet &tet : tets) {
    for (const auto &[from, to] : kEdges) edges.push_back(edge_of(tet, from, to));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

// ---- The front ----

// A lattice of n cells along each axis over the unit cube.
struct Lattice {
  std::int32_t n;
  std::int32_t node(const std::array<std::int32_t, 3> &at) const { return (at[2] * (n + 1) + at[1]) * (n + 1) + at[0]; }
};

constexpr double kSteepness = 14.0;  // of the front, in units of the box's width
constexpr double kPi = 3.14159265358979323846;

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

std::optional<std::string> find_set(const std::string &name) {
  if (fs::path(name).has_extension()) return name;
  std::optional<std::string> path = find_data(name + ".vtu");
  if (!path) std::printf("%s: skipped, there is no such set in TETLOD_DATA_DIR or in ../shared/data\n", name.c_str());
  return path;
}

Mesh refined(const Mesh &mesh) {
  // Corners of the parts: 0 to 3 are the tet's, 4 to 9 the middles of its edges.
  static constexpr std::size_t parts[8][4] = {{0, 4, 5, 6}, {4, 1, 7, 8}, {5, 7, 2, 9}, {6, 8, 9, 3},
                                              {4, 5, 6, 8}, {4, 7, 5, 8}, {5, 9, 6, 8}, {5, 7, 9, 8}};
  const std::vector<Edge> edges = edges_of(mesh.tets);
  Mesh fine{mesh.points, {}, mesh.values};
  for (const Edge &edge : edges) {
    const auto a = static_cast<std::size_t>(edge[0]), b = static_cast<std::size_t>(edge[1]);
    Point middle;
    for (std::size_t k = 0; k < 3; k++) middle[k] = 0.5 * (mesh.points[a][k] + mesh.points[b][k]);
    fine.points.push_back(middle);
    fine.values.push_back(0.5 * (mesh.values[a] + mesh.values[b]));
  }
  for (const Tet &tet : mesh.tets) {
    std::int32_t corners[10] = {tet[0], tet[1], tet[2], tet[3]};
    for (std::size_t e = 0; e < 6; e++) {
      const Edge edge = edge_of(tet, kEdges[e][0], kEdges[e][1]);
      const auto place = std::lower_bound(edges.begin(), edges.end(), edge) - edges.begin();
      corners[4 + e] = static_cast<std::int32_t>(mesh.points.size()) + static_cast<std::int32_t>(place);
    }
    for (const auto &part : parts) {
      fine.tets.push_back({corners[part[0]], corners[part[1]], corners[part[2]], corners[part[3]]});
    }
  }
  return fine;
}

double front_value(const Point &p, double time) {
  const double front = 0.2 + 0.6 * time + 0.12 * std::sin(kPi * (p[1] + 0.5 * p[2])) - 0.1 * p[2] * p[2];
  const double swell = 0.15 * std::cos(2.0 * kPi * p[1]) * std::sin(kPi * (p[0] + p[2]));
  return std::tanh(kSteepness * (p[0] - front)) + swell;
}

Mesh make_front_mesh(std::int64_t tets, double time) {
  const Lattice lattice{std::max<std::int32_t>(2, static_cast<std::int32_t>(std::lround(std::cbrt(double(tets) / 6))))};
  Mesh mesh;
  add_points(lattice, time, mesh);
  add_tets(lattice, mesh.tets);
  return mesh;
}

}  // namespace bench
