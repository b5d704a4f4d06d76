#include "quiet_vtk.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>

#include <algorithm>

namespace cli {
namespace {

// VTK writes "ERROR: In file, line 1\nvtkClass (0x1234): what was wrong\n\n", or "Generic Warning: In file, line 1\n"
// and that.
std::string what_was_wrong(const char *text) {
  const std::string whole(text);
  const std::size_t object = whole.find("): "), generic = whole.find("Generic Warning: "), line = whole.find('\n');
  if (object != std::string::npos) return one_line(whole.substr(object + 3));
  return one_line(generic == 0 && line != std::string::npos ? whole.substr(line) : whole);
}

// Where a .vtk file has more numbers than it says, or a word of text is none to VTK, it takes the next ones for names.
std::string with_reason(const std::string &message) {
  const bool is_about_a_name = message.find("Unsupported") == 0 && message.find(" attribute type: ") != message.npos;
  return message +
         (is_about_a_name ? " (more numbers than said, or one that VTK does not read from text, as nan)" : "");
}

// That one of its algorithms failed VTK says with all that it knows of it.
bool says_nothing(const std::string &message) {
  return message.find("Algorithm ") == 0 && message.find("returned failure for request") != message.npos;
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
  errors.insert(errors.end(), unread_.begin(), unread_.end());
  unread_.clear();
  for (const std::string &warning : warnings_) notes.push_back(where + warning);
  warnings_.clear();
  if (errors.empty()) return;
  const auto said = std::find_if_not(errors.begin(), errors.end(), says_nothing);
  throw Failure(where + (said != errors.end() ? *said : "VTK cannot read it"), status);
}

void VtkMessages::DisplayErrorText(const char *text) { errors_.push_back(with_reason(what_was_wrong(text))); }
void VtkMessages::DisplayWarningText(const char *text) { warnings_.push_back(what_was_wrong(text)); }

// Of a .vtk file whose data ends too soon VTK says no more than that; where it finds more to say, that is said first.
void VtkMessages::DisplayGenericWarningText(const char *text) {
  const bool is_error = std::string(text).find("Error reading") != std::string::npos;
  (is_error ? unread_ : warnings_).push_back(what_was_wrong(text));
}

}  // namespace cli
