// The call of the library.
#pragma once

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "carried_arrays.hpp"
#include "progress_bar.hpp"
#include "tetlod.h"

namespace cli {

// A mesh of tets in VTK's memory.
struct TetMesh {
  vtkSmartPointer<vtkDataArray> points, corners, values;
  std::string field;
  std::vector<CarriedArray> others;
};

struct DestroyContext {
  void operator()(tetlod_context *context) const { tetlod_destroy(context); }
};
using Context = std::unique_ptr<tetlod_context, DestroyContext>;

// Throws Failure with the context's last message; options out of bounds are wrong usage.
void check(tetlod_status status, const tetlod_context *context);

// A context with the options of the command line.
Context make_context(const Arguments &arguments);

// The mesh must live as long as the context. Warnings of the library become notes.
void simplify(tetlod_context *context, const TetMesh &mesh, ProgressBar &bar, std::vector<std::string> &notes);

// One sample a tet.
tetlod_error_report measure(tetlod_context *context);

}  // namespace cli
