// A file that appears whole or not at all: written under another name beside it, then renamed. Where the path is a link,
// its target is that file.
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

  // Where to write; ends as the path does.
  const std::string &temporary() const { return temporary_; }
  // Gives the file its name. Throws Failure.
  void keep();

 private:
  std::string path_, target_, temporary_;
};

// Throws Failure for a folder, a pipe, a device: opening one may block, and renaming onto it would replace it.
void require_file_or_nothing(const std::string &path);

// Whether two paths, however spelled, name one file, there or not yet.
bool same_file(const std::string &a, const std::string &b);

// ".vtu" of "a/b.VTU"; empty when there is none.
std::string file_ending(const std::string &path);

}  // namespace cli
