// Where the worker's executable is.
#include <dlfcn.h>
#include <unistd.h>

#include <climits>
#include <cstdlib>

#include "worker.hpp"

namespace tetlod {

namespace {

constexpr const char *program = "tetlod-remesh";

std::string resolved(const char *path) {
  char buffer[PATH_MAX];
  return ::realpath(path, buffer) ? std::string(buffer) : std::string();
}

/// The file that this code was loaded from: libtetlod.so, or a program that has it built in (whose name the loader
/// knows only as it was typed).
std::string own_file() {
  Dl_info information;
  const void *here = reinterpret_cast<const void *>(&find_remesher);
  if (!::dladdr(here, &information) || !information.dli_fname) return {};
  const std::string name = information.dli_fname;
  return resolved(name.find('/') == std::string::npos ? "/proc/self/exe" : name.c_str());
}

bool is_executable(const std::string &path) { return ::access(path.c_str(), X_OK) == 0; }

}  // namespace

std::string find_remesher() {
  if (const char *chosen = ::secure_getenv("TETLOD_REMESHER"); chosen && *chosen) return chosen;
  const std::string file = own_file();
  const std::string folder = file.substr(0, file.find_last_of('/') + 1);
  if (!folder.empty()) {
    // beside it; <prefix>/lib; <prefix>/lib/<triplet>
    for (const char *relative : {"", "../libexec/tetlod/", "../../libexec/tetlod/"}) {
      const std::string path = folder + relative + program;
      if (is_executable(path)) return resolved(path.c_str());
    }
  }
  return std::string(TETLOD_LIBEXECDIR "/") + program;
}

}  // namespace tetlod
