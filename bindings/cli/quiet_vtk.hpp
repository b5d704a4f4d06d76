// Catches what VTK would print.
#pragma once

#include <vtkOutputWindow.h>

#include <string>
#include <vector>

#include "failure.hpp"

namespace cli {

class VtkMessages : public vtkOutputWindow {
 public:
  static VtkMessages *New();
  VtkMessages(const VtkMessages &) = delete;
  VtkMessages &operator=(const VtkMessages &) = delete;

  // Makes this the place that VTK prints to.
  void install();
  // Throws Failure with the first error that came; warnings become notes. Both are forgotten. A path goes before them.
  void check(const std::string &path, std::vector<std::string> &notes, ExitStatus status = kFailed);

  void DisplayErrorText(const char *text) override;
  void DisplayWarningText(const char *text) override;
  void DisplayGenericWarningText(const char *text) override;
  void DisplayText(const char *) override {}
  void DisplayDebugText(const char *) override {}

 protected:
  VtkMessages() = default;
  ~VtkMessages() override = default;

 private:
  std::vector<std::string> errors_, unread_, warnings_;
};

}  // namespace cli
