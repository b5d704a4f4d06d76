// What --pictures asks for: a folder with PNG files and report.html.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <string>

#include "report.hpp"

namespace cli {

// Makes the folder where it is missing. Throws Failure when nothing can be written there, before any work is done.
void prepare_pictures(const std::string &folder);

// Draws both grids; seconds.pictures is set. Throws Failure.
void write_pictures(const Arguments &arguments, vtkUnstructuredGrid *original, vtkUnstructuredGrid *simplified,
                    const std::string &field, const vtkTetlodSimplify &filter, ToolSeconds &seconds);

}  // namespace cli
