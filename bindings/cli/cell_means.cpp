#include "cell_means.hpp"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkGenericCell.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <limits>
#include <map>

namespace cli {
namespace {

bool is_field(vtkDataSetAttributes &data, vtkDataArray *array) {
  return array != nullptr && array->GetName() != nullptr && array->GetNumberOfComponents() <= 3 &&
         array != data.GetGlobalIds() && array != data.GetArray(vtkDataSetAttributes::GhostArrayName());
}

std::vector<vtkDataArray *> fields_of(vtkDataSetAttributes &data) {
  std::vector<vtkDataArray *> fields;
  for (int i = 0; i < data.GetNumberOfArrays(); i++)
    if (is_field(data, data.GetArray(i))) fields.push_back(data.GetArray(i));
  return fields;
}

bool is_real(vtkDataArray *array) { return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE; }

vtkDataArray *field_of_cells(const std::string &name, vtkUnstructuredGrid &grid) {
  vtkCellData &data = *grid.GetCellData();
  if (!name.empty()) return grid.GetPointData()->HasArray(name.c_str()) ? nullptr : data.GetArray(name.c_str());
  const std::vector<vtkDataArray *> fields = fields_of(data);
  if (fields.empty() || !fields_of(*grid.GetPointData()).empty()) return nullptr;
  if (is_field(data, data.GetScalars())) return data.GetScalars();
  const auto real = std::find_if(fields.begin(), fields.end(), is_real);
  return real == fields.end() ? fields.front() : *real;
}

class SolidTypes {
 public:
  bool has(int type) {
    const auto [at, is_new] = known_.emplace(type, false);
    if (is_new) {
      const auto cell = vtk::TakeSmartPointer(vtkGenericCell::InstantiateCell(type));
      at->second = cell != nullptr && cell->GetCellDimension() == 3;
    }
    return at->second;
  }

 private:
  std::map<int, bool> known_;
};

// Calls use(cell, point) for each point that a solid cell has. A file may name points that there are not, which
// VTK's own filter for such means trusts; whoever reads the cells afterwards refuses them.
template <class Use>
void for_each_corner(vtkUnstructuredGrid &grid, const Use &use) {
  SolidTypes solids;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++) {
    if (!solids.has(grid.GetCellType(c))) continue;
    vtkIdType size = 0;
    const vtkIdType *ids = nullptr;
    grid.GetCells()->GetCellAtId(c, size, ids);
    for (vtkIdType k = 0; k < size; k++)
      if (ids[k] >= 0 && ids[k] < grid.GetNumberOfPoints()) use(c, ids[k]);
  }
}

// Each between the least and the largest of its values, which a sum may pass by rounding: what is constant stays so.
vtkSmartPointer<vtkDataArray> means_of(vtkDataArray &of_cells, vtkUnstructuredGrid &grid) {
  const int components = of_cells.GetNumberOfComponents();
  const auto points = std::size_t(grid.GetNumberOfPoints());
  auto means = vtkSmartPointer<vtkDoubleArray>::New();
  means->SetName(of_cells.GetName());
  means->SetNumberOfComponents(components);
  means->SetNumberOfTuples(grid.GetNumberOfPoints());
  std::vector<double> cells(points, 0);
  for_each_corner(grid, [&](vtkIdType, vtkIdType point) { cells[std::size_t(point)]++; });
  for (int k = 0; k < components; k++) {
    std::vector<double> sum(points, 0), least(points, std::numeric_limits<double>::infinity()), most(points);
    for (std::size_t v = 0; v < points; v++) most[v] = -least[v];
    for_each_corner(grid, [&](vtkIdType cell, vtkIdType point) {
      const auto v = std::size_t(point);
      const double value = of_cells.GetComponent(cell, k);
      sum[v] += value / cells[v];  // a part: the whole may be more than a double holds
      least[v] = std::min(least[v], value);
      most[v] = std::max(most[v], value);
    });
    for (std::size_t v = 0; v < points; v++)
      means->SetComponent(vtkIdType(v), k, cells[v] > 0 ? std::min(std::max(sum[v], least[v]), most[v]) : 0);
  }
  return means;
}

}  // namespace

void add_means_of_cells(const std::string &field, vtkUnstructuredGrid &grid, std::vector<std::string> &notes) {
  vtkDataArray *const of_cells = field_of_cells(field, grid);
  if (of_cells == nullptr || of_cells->GetNumberOfTuples() != grid.GetNumberOfCells()) return;
  grid.GetPointData()->AddArray(means_of(*of_cells, grid));
  notes.push_back("the cell data '" + std::string(of_cells->GetName()) +
                  "' steers by the means of the cells around each point");
}

}  // namespace cli
