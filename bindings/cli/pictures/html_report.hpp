// report.html: one file that tells a newcomer what a run did.
#pragma once

#include <string>
#include <vector>

#include "report.hpp"

namespace cli {

struct DrawnFigure {
  std::string name, title, caption;
  std::string light, dark;  // bytes of PNG files
  int width;
};

// The page with the pictures in it; it refers to nothing outside. `field`: its name, with its unit.
std::string html_report(const Arguments &arguments, const std::string &field, const vtkTetlodSimplify &filter,
                        const ToolSeconds &seconds, const std::vector<DrawnFigure> &figures);

}  // namespace cli
