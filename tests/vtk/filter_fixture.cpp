#include "filter_fixture.hpp"

#include <vtkCellData.h>
#include <vtkExecutive.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace vtk_test {

Grid cube_grid(const cli_test::Cube &cube) {
  const cli_test::Folder folder;
  cli_test::write_cube(folder / "cube.vtk", cube);
  vtkNew<vtkUnstructuredGridReader> reader;
  reader->SetFileName((folder / "cube.vtk").c_str());
  reader->ReadAllScalarsOn();
  reader->Update();
  return reader->GetOutput();
}

void add_ghosts(vtkUnstructuredGrid &grid, Half half, int kind) {
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++) {
    const bool is_lower = c < grid.GetNumberOfCells() / 2;
    ghosts->InsertNextValue(static_cast<unsigned char>(is_lower == (half == Half::lower) ? kind : 0));
  }
  grid.GetCellData()->AddArray(ghosts);
}

Listener::Listener(vtkTetlodSimplify &filter) {
  filter.AddObserver(vtkCommand::ErrorEvent, this, &Listener::on_error);
  filter.AddObserver(vtkCommand::WarningEvent, this, &Listener::on_warning);
  filter.GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this, &Listener::on_error);
}

bool Listener::heard(const std::string &part) const {
  for (const std::string &error : errors) {
    if (error.find(part) != std::string::npos) return true;
  }
  return false;
}

void write_grid(vtkUnstructuredGrid *grid, const std::string &path) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->Write();
}

std::string bytes_of(vtkUnstructuredGrid *grid) {
  const cli_test::Folder folder;
  write_grid(grid, folder / "grid.vtu");
  return cli_test::contents_of(folder / "grid.vtu");
}

}  // namespace vtk_test
