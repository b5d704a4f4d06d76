// The call of the filter.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkTetlodSimplify.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "arguments.hpp"
#include "progress_bar.hpp"
#include "quiet_vtk.hpp"
#include "tetlod.h"

namespace cli {

// Throws Failure with the context's last message.
void check(tetlod_status status, const tetlod_context *context);

// A filter with the options of the command line; those out of bounds are wrong usage. It measures the error, too.
vtkSmartPointer<vtkTetlodSimplify> make_filter(const Arguments &arguments, VtkMessages &messages);

// The simplified grid. Warnings of the filter become notes. Throws Failure.
vtkUnstructuredGrid *simplify(vtkTetlodSimplify &filter, vtkUnstructuredGrid *original, const Arguments &arguments,
                              ProgressBar &bar, VtkMessages &messages, std::vector<std::string> &notes);

}  // namespace cli
