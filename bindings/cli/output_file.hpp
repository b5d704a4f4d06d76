// A file that appears whole or not at all: written under another name beside it, then renamed. Where the path is a
// link, its target is that file.
#pragma once

#include <string>

namespace cli {

class OutputFile {
 public:
  // Throws Failure when the folder cannot be written to, before any work is done for the file.
  explicit OutputFile(const std::string &path);
  ~OutputFile();
  OutputFile(const OutputFile &) = delete;
  OutputFile &operator=(const OutputFile &) = delete;

  // As it was asked for.
  const std::string &path() const { return path_; }
  // Where to write; ends as the path does.
  const std::string &temporary() const { return temporary_; }
  // Writes all that is to be in the file. Throws Failure.
  void write(const std::string &bytes) const;
  // Gives the file its name. Throws Failure.
  void keep();
  // Throws Failure: the path cannot be written, and why.
  [[noreturn]] void fail(const std::string &reason) const;

 private:
  std::string path_, target_, temporary_;
};

// A folder that goes with this, and all that is in it.
class PassingFolder {
 public:
  // Throws Failure.
  explicit PassingFolder(const std::string &path);
  ~PassingFolder();
  PassingFolder(const PassingFolder &) = delete;
  PassingFolder &operator=(const PassingFolder &) = delete;

  std::string operator/(const std::string &name) const;

 private:
  std::string path_;
};

// Throws Failure for a folder, a pipe, a device: opening one may block, and renaming onto it would replace it. So it
// would the file that /dev/stdout leads to.
void require_file_or_nothing(const std::string &path);

// From here on a write beyond a limit of files' sizes fails as on a full disk; the signal would end the process.
void report_full_files();

// Whether two paths, however spelled, name one file, there or not yet.
bool same_file(const std::string &a, const std::string &b);

// ".vtu" of "a/b.VTU"; empty when there is none.
std::string file_ending(const std::string &path);

// Of a summary .pvtu the file beside it that its one piece is written to; empty: it is none.
std::string piece_of(const std::string &path);

}  // namespace cli
