// What the user may not have expected of a run that did what was asked.
#pragma once

#include <string>
#include <vector>

#include "simplify.hpp"

namespace cli {

// A field that is hardly meant, options that mean nothing beside others, a size that was not met. Of a filter that has
// run.
void add_notes(vtkTetlodSimplify &filter, const Arguments &arguments, std::vector<std::string> &notes);

}  // namespace cli
