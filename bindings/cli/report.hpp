// The JSON that --report asks for.
#pragma once

#include <string>

#include "arguments.hpp"
#include "output_file.hpp"
#include "simplify.hpp"

namespace cli {

// Seconds of the tool's own, beside those of tetlod_run.
struct ToolSeconds {
  double reading = 0, writing = 0, measuring = 0, pictures = 0;
};

// The counts of the last run. Throws Failure.
tetlod_run_report run_report(const tetlod_context *context);

void write_report(const OutputFile &file, const Arguments &arguments, const std::string &field,
                  const vtkTetlodSimplify &filter, const ToolSeconds &seconds);

}  // namespace cli
