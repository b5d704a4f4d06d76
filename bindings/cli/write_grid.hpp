// Writing the result.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <optional>
#include <string>
#include <vector>

#include "output_file.hpp"
#include "quiet_vtk.hpp"

namespace cli {

// Throws Failure where the format would lose an array or its name.
void check_arrays(const std::string &path, vtkUnstructuredGrid &grid);

// The file of the result, by its ending: .vtu, .vtk, or .pvtu, a summary of its one piece, NAME_0.vtu beside it.
class GridFile {
 public:
  // Throws Failure when the folder cannot be written to, before any work is done for the file.
  explicit GridFile(const std::string &path);

  // Throws Failure.
  void write(vtkUnstructuredGrid *grid, VtkMessages &messages, std::vector<std::string> &notes) const;
  // Gives it its name. Throws Failure.
  void keep();

 private:
  OutputFile file_;
  std::optional<OutputFile> piece_;
};

}  // namespace cli
