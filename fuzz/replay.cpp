// A fuzz target without libFuzzer, for the ordinary tests: runs the inputs that are named (files, or folders of files;
// a folder that does not exist has none), and with `--made COUNT` as many inputs that are always the same.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);
extern "C" int LLVMFuzzerInitialize(int *argc, char ***argv);

namespace {

using Input = std::vector<std::uint8_t>;

Input read(const std::filesystem::path &path) {
  std::ifstream file(path, std::ios::binary);
  return Input(std::istreambuf_iterator<char>(file), {});
}

/// The name is said before, so that a crash tells whose it is. The bytes are in a block of their own size, so that a
/// sanitizer sees who reads beyond.
void run(const std::string &name, const Input &input) {
  std::fprintf(stderr, "%s\n", name.c_str());
  const Input exact(input.begin(), input.end());
  LLVMFuzzerTestOneInput(exact.data(), exact.size());
}

std::vector<std::filesystem::path> files_of(const std::filesystem::path &folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto &entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::size_t run_all_of(const std::filesystem::path &path) {
  if (std::filesystem::is_regular_file(path)) {
    run(path.string(), read(path));
    return 1;
  }
  const auto files = files_of(path);
  for (const auto &file : files) run(file.string(), read(file));
  return files.size();
}

std::size_t run_made(int count) {
  std::mt19937 random(1);
  for (int i = 0; i < count; i++) {
    Input input(random() % 400);
    for (std::uint8_t &byte : input) byte = std::uint8_t(random());
    run("made input " + std::to_string(i), input);
  }
  return std::size_t(std::max(count, 0));
}

}  // namespace

int main(int argc, char **argv) {
  LLVMFuzzerInitialize(&argc, &argv);
  std::size_t count = 0;
  for (int i = 1; i < argc; i++) {
    if (std::strcmp(argv[i], "--made") == 0 && i + 1 < argc)
      count += run_made(std::atoi(argv[++i]));
    else
      count += run_all_of(argv[i]);
  }
  std::fprintf(stderr, "%zu inputs\n", count);
  return count ? 0 : 1;
}
