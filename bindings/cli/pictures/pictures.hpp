// What --pictures asks for: a folder with PNG files and report.html.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <filesystem>
#include <string>
#include <vector>

#include "report.hpp"

namespace cli {

class PicturesFolder {
 public:
  PicturesFolder() = default;
  // Removes what it has made and nothing was put into.
  ~PicturesFolder();
  PicturesFolder(const PicturesFolder &) = delete;
  PicturesFolder &operator=(const PicturesFolder &) = delete;

  // Makes the folder where it is missing. Throws Failure when nothing can be written there, before any work is done.
  void make(const std::string &folder);

 private:
  std::vector<std::filesystem::path> made_;  // the innermost first
};

// Draws both grids; seconds.pictures is set. Throws Failure.
void write_pictures(const Arguments &arguments, vtkUnstructuredGrid *original, vtkUnstructuredGrid *simplified,
                    const std::string &field, const vtkTetlodSimplify &filter, ToolSeconds &seconds);

}  // namespace cli
