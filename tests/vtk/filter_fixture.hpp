// What tests of the filter share: grids, what a filter says, and results that can be compared.
#pragma once

#include <gtest/gtest.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkTetlodSimplify.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "mesh_file.hpp"
#include "tool.hpp"

namespace vtk_test {

using Grid = vtkSmartPointer<vtkUnstructuredGrid>;

// The cube of mesh_file.hpp, read by VTK.
Grid cube_grid(const cli_test::Cube &cube = {});

// Hears the errors and warnings of a filter and of its executive, which are then not printed.
class Listener {
 public:
  explicit Listener(vtkTetlodSimplify &filter);
  std::vector<std::string> errors, warnings;
  // Whether an error says so.
  bool heard(const std::string &part) const;

 private:
  void on_error(vtkObject *, unsigned long, void *text) { errors.emplace_back(static_cast<const char *>(text)); }
  void on_warning(vtkObject *, unsigned long, void *text) { warnings.emplace_back(static_cast<const char *>(text)); }
};

// As the tool writes it.
void write_grid(vtkUnstructuredGrid *grid, const std::string &path);
std::string bytes_of(vtkUnstructuredGrid *grid);

}  // namespace vtk_test
