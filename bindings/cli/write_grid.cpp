#include "write_grid.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "arrays.hpp"
#include "failure.hpp"
#include "output_file.hpp"

namespace cli {
namespace {

constexpr int kTheyKeepTheirMemory = 1;

// The library's own points, not copied.
vtkSmartPointer<vtkPoints> points_of(const tetlod_context *context) {
  tetlod_array view{};
  view.struct_size = sizeof view;
  check(tetlod_view_points(context, &view), context);
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetArray(static_cast<double *>(view.data), 3 * view.tuples, kTheyKeepTheirMemory);
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(coordinates);
  return points;
}

vtkSmartPointer<vtkCellArray> tets_of(const tetlod_context *context) {
  tetlod_array view{};
  view.struct_size = sizeof view;
  check(tetlod_view_tets(context, &view), context);
  vtkNew<vtkTypeInt32Array> corners;
  corners->SetArray(static_cast<vtkTypeInt32 *>(view.data), 4 * view.tuples, kTheyKeepTheirMemory);
  auto tets = vtkSmartPointer<vtkCellArray>::New();
  if (!tets->SetData(4, corners)) throw Failure("VTK did not take the result's tets");
  return tets;
}

vtkSmartPointer<vtkDataArray> values_of(const tetlod_context *context, const TetMesh &original, int64_t points) {
  auto values = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(original.values->GetDataType()));
  values->SetName(original.field.c_str());
  values->SetNumberOfTuples(points);
  tetlod_array room = borrowed(values, 1);
  check(tetlod_fetch_scalars(context, &room), context);
  return values;
}

bool write_xml(const std::string &path, vtkUnstructuredGrid *grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  return writer->Write() == 1;
}

// Version 4.2 is what every reader of the format knows.
bool write_legacy(const std::string &path, vtkUnstructuredGrid *grid) {
  vtkNew<vtkUnstructuredGridWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(grid);
  writer->SetFileTypeToBinary();
  writer->SetFileVersion(vtkUnstructuredGridWriter::VTK_LEGACY_READER_VERSION_4_2);
  return writer->Write() == 1;
}

}  // namespace

void write_grid(const std::string &path, const tetlod_context *context, const TetMesh &original, VtkMessages &messages,
                std::vector<std::string> &notes) {
  const auto points = points_of(context);
  const auto values = values_of(context, original, points->GetNumberOfPoints());
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(VTK_TETRA, tets_of(context));
  grid->GetPointData()->SetScalars(values);
  for (const CarriedArray &other : original.others) {
    const bool of_cells = other.association == TETLOD_CELL_FIELD;
    vtkDataSetAttributes *data =
        of_cells ? static_cast<vtkDataSetAttributes *>(grid->GetCellData()) : grid->GetPointData();
    data->AddArray(fetch_carried(context, other, of_cells ? grid->GetNumberOfCells() : grid->GetNumberOfPoints()));
  }
  const bool written = file_ending(path) == ".vtk" ? write_legacy(path, grid) : write_xml(path, grid);
  messages.check(path, notes);
  if (!written) throw Failure(path + ": VTK could not write it");
}

}  // namespace cli
