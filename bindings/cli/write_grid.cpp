#include "write_grid.hpp"

#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cerrno>
#include <cstring>

namespace cli {
namespace {

// VTK takes every write that failed for a full disk; the system knows better.
std::string reason_of(int system_error, unsigned long code) {
  return system_error != 0 ? std::strerror(system_error) : vtkErrorCode::GetStringFromErrorCode(code);
}

// The writers call some failures a success, but leave their code.
template <class Writer>
void write_with(Writer &writer, const OutputFile &file, vtkUnstructuredGrid *grid) {
  writer.SetFileName(file.temporary().c_str());
  writer.SetInputData(grid);
  errno = 0;
  const bool written = writer.Write() == 1;
  const int system_error = errno;
  const unsigned long code = writer.GetErrorCode();
  if (!written || code != vtkErrorCode::NoError) file.fail(reason_of(system_error, code));
}

void write_xml(const OutputFile &file, vtkUnstructuredGrid *grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  write_with(*writer, file, grid);
}

// Version 4.2 is what every reader of the format knows.
void write_legacy(const OutputFile &file, vtkUnstructuredGrid *grid) {
  vtkNew<vtkUnstructuredGridWriter> writer;
  writer->SetFileTypeToBinary();
  writer->SetFileVersion(vtkUnstructuredGridWriter::VTK_LEGACY_READER_VERSION_4_2);
  write_with(*writer, file, grid);
}

}  // namespace

void write_grid(const OutputFile &file, vtkUnstructuredGrid *grid, VtkMessages &messages,
                std::vector<std::string> &notes) {
  if (file_ending(file.path()) == ".vtk")
    write_legacy(file, grid);
  else
    write_xml(file, grid);
  messages.check(file.path(), notes);
}

}  // namespace cli
