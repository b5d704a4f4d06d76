#include "cell_means.hpp"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkGenericCell.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
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

vtkSmartPointer<vtkDataArray> means_of(vtkDataArray &of_cells, vtkUnstructuredGrid &grid) {
  const int components = of_cells.GetNumberOfComponents();
  auto means = vtkSmartPointer<vtkDoubleArray>::New();
  means->SetName(of_cells.GetName());
  means->SetNumberOfComponents(components);
  means->SetNumberOfTuples(grid.GetNumberOfPoints());
  means->Fill(0);
  double *const sums = means->GetPointer(0);
  std::vector<double> cells(std::size_t(grid.GetNumberOfPoints()), 0);
  for_each_corner(grid, [&](vtkIdType, vtkIdType point) { cells[std::size_t(point)]++; });
  for_each_corner(grid, [&](vtkIdType cell, vtkIdType point) {
    for (int k = 0; k < components; k++)  // each a part: a sum may be more than a double holds
      sums[point * components + k] += of_cells.GetComponent(cell, k) / cells[std::size_t(point)];
  });
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
