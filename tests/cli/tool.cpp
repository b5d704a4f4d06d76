#include "tool.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

extern char **environ;

namespace cli_test {
namespace {

std::vector<char *> pointers(std::vector<std::string> &words) {
  std::vector<char *> list;
  for (std::string &word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

pid_t spawn(std::vector<std::string> words, const std::string &out, const std::string &err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), flags, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), flags, 0600);
  pid_t child = -1;
  const int failed = posix_spawn(&child, words[0].c_str(), &actions, nullptr, pointers(words).data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot start " + words[0]);
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool has_ended(pid_t child) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
}

// Whether the process has a handler of its own for SIGINT; Linux tells in a mask of hexadecimal digits.
bool catches_interrupts(pid_t child) {
  std::ifstream status("/proc/" + std::to_string(child) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("SigCgt:", 0) == 0) return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1) != 0;
  }
  return false;
}

void interrupt(pid_t child, int signal) {
  while (!has_ended(child) && !catches_interrupts(child)) usleep(1000);
  kill(child, signal);  // not waited for yet, so the number is still its own
}

void end_after_a_minute(pid_t child) {
  for (int hundredths = 0; hundredths < 6000 && !has_ended(child); hundredths++) usleep(10000);
  if (!has_ended(child)) kill(child, SIGKILL);
}

// Of this process while it lives, and for ever of those that it starts meanwhile.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(long bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{static_cast<rlim_t>(bytes), before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit &) = delete;
  FileSizeLimit &operator=(const FileSizeLimit &) = delete;

 private:
  rlimit before_{};
};

template <class Meanwhile>
Outcome run_and(const std::vector<std::string> &arguments, const Meanwhile &meanwhile,
                const std::string &printed_to = "") {
  const Folder folder;
  const std::string out = printed_to.empty() ? folder / "out" : printed_to, err = folder / "err";
  std::vector<std::string> words = {TETLOD_TOOL};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const pid_t child = spawn(words, out, err);
  meanwhile(child);
  Outcome outcome;
  outcome.status = wait_for(child);
  if (printed_to.empty()) outcome.out = contents_of(out);
  outcome.err = contents_of(err);
  return outcome;
}

}  // namespace

Outcome run_tool(const std::vector<std::string> &arguments) {
  return run_and(arguments, [](pid_t) {});
}

Outcome run_tool_for_a_minute(const std::vector<std::string> &arguments) {
  return run_and(arguments, end_after_a_minute);
}

Outcome run_tool_with_room(const std::vector<std::string> &arguments, long bytes) {
  const FileSizeLimit limit(bytes);
  return run_tool(arguments);
}

Outcome run_tool_printing_to(const std::string &device, const std::vector<std::string> &arguments) {
  return run_and(
      arguments, [](pid_t) {}, device);
}

Outcome interrupt_tool(const std::vector<std::string> &arguments, int signal) {
  return run_and(arguments, [signal](pid_t child) { interrupt(child, signal); });
}

Folder::Folder() {
  std::string name = (std::filesystem::temp_directory_path() / "tetlod-cli-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  for (const auto &entry : std::filesystem::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

long lines_of(const std::string &text) {
  if (!text.empty() && text.back() != '\n') return -1;
  return std::count(text.begin(), text.end(), '\n');
}

std::string contents_of(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace cli_test
