#include "quiet_vtk.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>

namespace cli {
namespace {

// VTK writes "ERROR: In file, line 1\nvtkClass (0x1234): what was wrong\n\n".
std::string what_was_wrong(const char *text) {
  const std::string whole(text);
  const std::size_t object = whole.find("): ");
  return one_line(object == std::string::npos ? whole : whole.substr(object + 3));
}

}  // namespace

vtkStandardNewMacro(VtkMessages);

void VtkMessages::install() {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkOutputWindow::SetInstance(this);
}

void VtkMessages::check(const std::string &path, std::vector<std::string> &notes, ExitStatus status) {
  const std::string where = path.empty() ? "" : path + ": ";
  std::vector<std::string> errors;
  errors.swap(errors_);
  for (const std::string &warning : warnings_) notes.push_back(where + warning);
  warnings_.clear();
  if (!errors.empty()) throw Failure(where + errors.front(), status);
}

void VtkMessages::DisplayErrorText(const char *text) { errors_.push_back(what_was_wrong(text)); }
void VtkMessages::DisplayWarningText(const char *text) { warnings_.push_back(what_was_wrong(text)); }
void VtkMessages::DisplayGenericWarningText(const char *text) { warnings_.push_back(what_was_wrong(text)); }

}  // namespace cli
