// What tests of the filter share: grids, what a filter says, and results that can be compared.
#pragma once

#include <gtest/gtest.h>
#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkErrorCode.h>
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

// Cells that another part of the mesh has: of the cube, half of it.
enum class Half { lower, upper };
void add_ghosts(vtkUnstructuredGrid &grid, Half half, int kind = vtkDataSetAttributes::DUPLICATECELL);

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

class Filter : public testing::Test {
 protected:
  // All boundary edges are kept: the cube stays a cube.
  Filter() : listener(*filter) {
    filter->SetInputData(cube_grid());
    filter->SetSigma(1);
  }
  vtkUnstructuredGrid *updated() {
    filter->Update();
    return filter->GetOutput();
  }
  void expect_silence() {
    EXPECT_TRUE(listener.errors.empty()) << listener.errors.front();
    EXPECT_TRUE(listener.warnings.empty()) << listener.warnings.front();
  }
  void use_field(const char *name) {
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
  }
  void expect_failure(const std::string &part, int status) {
    EXPECT_EQ(updated()->GetNumberOfPoints(), 0);
    EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::UserError + status));
    EXPECT_TRUE(listener.heard(part)) << "'" << part
                                      << "' is not in: " << (listener.errors.empty() ? "" : listener.errors.front());
  }

  vtkNew<vtkTetlodSimplify> filter;
  Listener listener;
};

// Hears a filter's progress, and may end its executions.
struct Watcher {
  vtkTetlodSimplify *filter;
  bool aborts;
  std::vector<double> seen;
  void on_progress(vtkObject *, unsigned long, void *) {
    seen.push_back(filter->GetProgress());
    if (aborts && seen.back() > 0) filter->AbortExecuteOn();
  }
};

inline cli_test::Cube large_cube() {
  cli_test::Cube cube;
  cube.size = 18;  // long enough for some events
  return cube;
}

}  // namespace vtk_test
