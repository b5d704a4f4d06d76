#include "output_file.hpp"

#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "failure.hpp"

namespace cli {
namespace {

// The process number keeps runs side by side apart.
std::string temporary_name(const std::string &path) {
  const std::filesystem::path whole(path);
  const std::string name = "." + whole.stem().string() + "." + std::to_string(getpid());
  return (whole.parent_path() / (name + whole.extension().string())).string();
}

}  // namespace

OutputFile::OutputFile(const std::string &path) : path_(path), temporary_(temporary_name(path)) {
  require_file_or_nothing(path_);
  if (!std::ofstream(temporary_, std::ios::binary))
    throw Failure(path_ + ": cannot be written: " + std::strerror(errno));
  std::remove(temporary_.c_str());
}

OutputFile::~OutputFile() { std::remove(temporary_.c_str()); }

void OutputFile::keep() {
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) throw Failure(path_ + ": cannot be written: " + error.message());
}

void require_file_or_nothing(const std::string &path) {
  std::error_code ignored;  // opening the file tells
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw Failure(path + ": is not a file");
}

std::string file_ending(const std::string &path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char &c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

}  // namespace cli
