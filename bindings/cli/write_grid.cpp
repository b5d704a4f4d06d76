#include "write_grid.hpp"

#include <vtkNew.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "failure.hpp"
#include "output_file.hpp"

namespace cli {
namespace {

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

void write_grid(const std::string &path, vtkUnstructuredGrid *grid, VtkMessages &messages,
                std::vector<std::string> &notes) {
  const bool written = file_ending(path) == ".vtk" ? write_legacy(path, grid) : write_xml(path, grid);
  messages.check(path, notes);
  if (!written) throw Failure(path + ": VTK could not write it");
}

}  // namespace cli
