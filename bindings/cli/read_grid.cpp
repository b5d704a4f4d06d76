#include "read_grid.hpp"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkUnstructuredGridReader.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>

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

Original read_parts(const std::string &path) {
  vtkNew<CheckedPartsReader> reader;
  const Grid grid = read_with(*reader, path);
  return {grid, reader->parts()};
}

Original read_by_ending(const std::string &path, std::vector<std::string> &notes) {
  const std::string ending = file_ending(path);
  if (ending == ".pvtu") return read_parts(path);
  return {ending == ".vtk" ? read_legacy(path) : read_whole(path, notes), {}};
}

// VTK writes them last: of a file that is cut off there they are missing, and read as none.
void check_types(vtkUnstructuredGrid &grid, const std::string &path) {
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++)
    if (grid.GetCellType(c) == VTK_EMPTY_CELL && grid.GetCells()->GetCellSize(c) > 0)
      throw Failure(path + ": is damaged: cell " + std::to_string(c) + " has points, but no type");
}

}  // namespace

Original read_grid(const std::string &path, VtkMessages &messages, std::vector<std::string> &notes) try {
  check_readable(path);
  Original original = read_by_ending(path, notes);
  messages.check(path, notes);
  if (original.grid == nullptr || original.grid->GetNumberOfCells() == 0) throw Failure(path + ": holds no cells");
  check_types(*original.grid, path);
  return original;
} catch (const std::bad_alloc &) {
  throw Failure(path + ": not enough memory to read it");
}

}  // namespace cli
