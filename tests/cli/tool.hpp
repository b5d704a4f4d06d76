// Runs the command line tool and keeps what it said.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cli_test {

struct Outcome {
  int status = -1;  // 128 and more: died of a signal
  std::string out, err;
};

// Arguments are passed as they are, no shell between. The tool's stdout and stderr are files, not terminals.
Outcome run_tool(const std::vector<std::string> &arguments);

// The same, killed after a minute: for what might wait for ever.
Outcome run_tool_for_a_minute(const std::vector<std::string> &arguments);

// The same, where no file may grow beyond so many bytes.
Outcome run_tool_with_room(const std::vector<std::string> &arguments, long bytes);

// The same with another stdout, which is not read again.
Outcome run_tool_printing_to(const std::string &device, const std::vector<std::string> &arguments);

// The same, interrupted by that signal as soon as the tool is ready for SIGINT.
Outcome interrupt_tool(const std::vector<std::string> &arguments, int signal);

// A folder of its own for a test, gone with it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder &) = delete;
  Folder &operator=(const Folder &) = delete;

  std::string operator/(const std::string &name) const { return (path_ / name).string(); }
  // Names of what is in it, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

// Number of lines; the last one must end.
long lines_of(const std::string &text);

std::string contents_of(const std::string &path);

}  // namespace cli_test
