#include "output_file.hpp"

#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "failure.hpp"

namespace cli {
namespace {

using Path = std::filesystem::path;

// What a path names after at most so many links, there or not yet.
Path target_of(const Path &path, int links = 40) {
  std::error_code not_a_link;
  const Path link = std::filesystem::read_symlink(path, not_a_link);
  if (not_a_link || links == 0) return path;
  return target_of(path.parent_path() / link, links - 1);
}

// The process number and a count keep files apart, and the name short. It ends as the path does, which a link's target
// may not.
Path temporary_name(const Path &path, const Path &target) {
  static int count = 0;
  const std::string name = ".tetlod." + std::to_string(getpid()) + "." + std::to_string(count++);
  return target.parent_path() / (name + path.extension().string());
}

// Who may read what is replaced may read what replaces it, nobody else.
void copy_permissions(const std::string &from, const std::string &to) {
  std::error_code nothing_there;
  const auto status = std::filesystem::status(from, nothing_there);
  if (std::filesystem::exists(status)) std::filesystem::permissions(to, status.permissions(), nothing_there);
}

}  // namespace

OutputFile::OutputFile(const std::string &path)
    : path_(path), target_(target_of(path).string()), temporary_(temporary_name(path, target_).string()) {
  require_file_or_nothing(path_);
  if (access(target_.c_str(), F_OK) == 0 && access(target_.c_str(), W_OK) != 0) fail(std::strerror(errno));
  if (!std::ofstream(temporary_, std::ios::binary)) fail(std::strerror(errno));
  std::remove(temporary_.c_str());
}

OutputFile::~OutputFile() { std::remove(temporary_.c_str()); }

void OutputFile::keep() {
  std::error_code error;
  copy_permissions(target_, temporary_);
  std::filesystem::rename(temporary_, target_, error);
  if (error) fail(error.message());
}

void OutputFile::write(const std::string &bytes) const {
  std::ofstream stream(temporary_, std::ios::binary);
  stream << bytes;
  stream.close();
  if (!stream) fail(std::strerror(errno));
}

void OutputFile::fail(const std::string &reason) const { throw Failure(path_ + ": cannot be written: " + reason); }

PassingFolder::PassingFolder(const std::string &path) : path_(path) {
  std::error_code error;
  if (!std::filesystem::create_directory(path, error)) throw Failure(path + ": cannot be made: " + error.message());
}

PassingFolder::~PassingFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string PassingFolder::operator/(const std::string &name) const { return (Path(path_) / name).string(); }

void require_file_or_nothing(const std::string &path) {
  std::error_code ignored;  // opening the file tells
  const auto status = std::filesystem::status(path, ignored);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const bool is_open_already = folder == "/dev" || folder == "/dev/fd" || folder.rfind("/proc/", 0) == 0;
  if (is_open_already || (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)))
    throw Failure(path + ": is not a file");
}

void report_full_files() { std::signal(SIGXFSZ, SIG_IGN); }

bool same_file(const std::string &a, const std::string &b) {
  const auto whole = [](const std::string &path) {
    std::error_code error;
    const Path plain = std::filesystem::weakly_canonical(std::filesystem::absolute(target_of(path)), error);
    return error ? Path(path) : plain;
  };
  return whole(a) == whole(b);
}

std::string file_ending(const std::string &path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char &c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

std::string piece_of(const std::string &path) {
  if (file_ending(path) != ".pvtu") return "";
  std::filesystem::path piece = path;
  piece.replace_filename(piece.stem().string() + "_0.vtu");
  return piece.string();
}

}  // namespace cli
