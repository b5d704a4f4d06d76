// What ends the tool: a message of one line and an exit status.
#pragma once

#include <stdexcept>
#include <string>

namespace cli {

enum ExitStatus { kDone = 0, kFailed = 1, kWrongUsage = 2 };

class Failure : public std::runtime_error {
 public:
  explicit Failure(const std::string &message, ExitStatus status = kFailed)
      : std::runtime_error(message), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

// The words of a text of several lines, a blank between them; other control characters become question marks.
inline std::string one_line(const std::string &text) {
  std::string line;
  for (char c : text) {
    const bool blank = c == '\n' || c == '\r' || c == '\t' || c == ' ';
    if (!blank) line += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? '?' : c;
    if (blank && !line.empty() && line.back() != ' ') line += ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

}  // namespace cli
