#include "read_grid.hpp"

#include <vtkUnstructuredGridReader.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "checked_readers.hpp"
#include "failure.hpp"
#include "output_file.hpp"

namespace cli {
namespace {

using Grid = vtkSmartPointer<vtkUnstructuredGrid>;

void check_readable(const std::string &path) {
  require_file_or_nothing(path);
  if (!std::ifstream(path)) throw Failure(path + ": cannot be read: " + std::strerror(errno));
}

template <class Reader>
Grid read_with(Reader &reader, const std::string &path) {
  reader.SetFileName(path.c_str());
  reader.Update();
  return reader.GetOutput();
}

Grid read_legacy(const std::string &path) {
  vtkNew<vtkUnstructuredGridReader> reader;
  reader->ReadAllScalarsOn();  // otherwise only the first ones
  reader->ReadAllFieldsOn();
  return read_with(*reader, path);
}

Grid read_whole(const std::string &path, std::vector<std::string> &notes) {
  vtkNew<CheckedReader> reader;
  const Grid grid = read_with(*reader, path);
  if (const int steps = reader->GetNumberOfTimeSteps(); steps > 1)
    notes.push_back(path + ": the first of " + std::to_string(steps) + " time steps is taken");
  return grid;
}

Grid read_by_ending(const std::string &path, std::vector<std::string> &notes) {
  const std::string ending = file_ending(path);
  if (ending == ".vtk") return read_legacy(path);
  if (ending == ".pvtu") return read_with(*vtkNew<CheckedPartsReader>(), path);
  return read_whole(path, notes);
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string &path, VtkMessages &messages,
                                               std::vector<std::string> &notes) {
  check_readable(path);
  Grid grid = read_by_ending(path, notes);
  messages.check(path, notes);
  if (grid == nullptr || grid->GetNumberOfCells() == 0) throw Failure(path + ": holds no cells");
  return grid;
}

}  // namespace cli
