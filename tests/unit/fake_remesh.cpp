// A worker that misbehaves as the environment variable FAKE_REMESH says. Without one it fills a tetrahedron. As
// FAKE_REMESH_FAILURES=file it fails, each time leaving a byte in the file, until there are FAKE_REMESH bytes in it;
// from then on it is the real one.
#include <dirent.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "remesh_protocol.hpp"

namespace {

using namespace tetlod::protocol;

std::string mode;
Call call;

bool is(const char *name) { return mode == name; }

template <class Message>
bool receive(Message &message) {
  return ::recv(control_descriptor, &message, sizeof message, 0) == ssize_t(sizeof message);
}

template <class Message>
void send(const Message &message) {
  if (::send(control_descriptor, &message, sizeof message, MSG_NOSIGNAL) < 0) ::_exit(5);
}

[[noreturn]] void hang() {
  for (;;) ::pause();
}

void greet() {
  if (is("dies at start")) {
    std::fprintf(stderr, "no such library");
    std::exit(127);
  }
  if (is("is killed at start")) std::raise(SIGKILL);
  if (is("never greets")) hang();
  Hello hello;
  std::strcpy(hello.tetlod_version, TETLOD_VERSION);
  if (is("other version")) std::strcpy(hello.tetlod_version, "0.0.7");
  if (is("other protocol")) hello.version = 77;
  if (is("other magic")) hello.magic = 1;
  if (is("version without end")) std::memset(hello.tetlod_version, 'x', sizeof hello.tetlod_version);
  if (is("short greeting")) {
    ::send(control_descriptor, &hello, 7, 0);
    hang();
  }
  send(hello);
}

/// A number as the code of the answer, for what the test wants to know about this process.
void tell(int code, const char *text) {
  Reply reply;
  reply.number = call.number;
  reply.code = code;
  std::strcpy(reply.text, text);
  send(reply);
}

int open_descriptors() {
  int count = 0;
  DIR *folder = ::opendir("/proc/self/fd");
  while (const dirent *entry = ::readdir(folder)) count += entry->d_name[0] != '.';
  ::closedir(folder);
  return count - 1;  // the folder itself
}

int signals_not_as_they_should_be() {
  sigset_t blocked;
  sigprocmask(SIG_SETMASK, nullptr, &blocked);
  int count = 0;
  for (int signal = 1; signal < 32; signal++) {
    struct sigaction action;
    if (sigismember(&blocked, signal) == 1) count++;
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_DFL) count++;
  }
  return count;
}

void misbehave() {
  if (is("crashes")) std::raise(SIGSEGV);
  if (is("aborts")) std::abort();
  if (is("is killed")) std::raise(SIGKILL);
  if (is("is killed once") && ::unlink(std::getenv("FAKE_REMESH_ONCE")) == 0) std::raise(SIGKILL);
  if (is("exits")) std::exit(9);
  if (is("hangs")) hang();
  if (is("waits")) ::usleep(300000);
  if (is("stops")) std::raise(SIGSTOP);
  if (is("spins"))
    for (volatile int i = 0;; i = i + 1) {
    }
  if (is("hangs up")) {
    ::close(control_descriptor);
    hang();
  }
  if (is("leaves a child") && ::fork() == 0) {
    ::sleep(2);
    ::_exit(0);
  }
  if (is("leaves a child")) std::exit(9);
  if (is("prints for ever"))
    for (;;) std::printf("another line that nobody wants to read\n");
  if (is("prints")) {
    for (int i = 0; i < 100000; i++) std::printf("line %c%d\n", i == 0 ? '\0' : ' ', i);
    std::printf("%s", std::string(5000, 'x').c_str());
    std::fflush(stdout);
  }
  if (is("short message")) {
    ::send(control_descriptor, "hello", 5, 0);
    hang();
  }
  if (is("long message")) {
    const std::vector<char> noise(10000, 'x');
    ::send(control_descriptor, noise.data(), noise.size(), 0);
    hang();
  }
}

struct Arrays {
  std::vector<double> points;
  std::vector<std::int32_t> tets, regions;
};

Arrays honest_arrays() {
  Arrays arrays;
  arrays.points.resize(std::size_t(3 * call.points));
  if (::pread(request_descriptor, arrays.points.data(), arrays.points.size() * 8, 0) < 0) std::exit(6);
  arrays.tets = {0, 1, 2, 3};
  return arrays;
}

void tamper(Arrays &arrays) {
  if (is("index too large")) arrays.tets[2] = std::int32_t(arrays.points.size() / 3);
  if (is("index negative")) arrays.tets[2] = -1;
  if (is("nan")) arrays.points[4] = std::numeric_limits<double>::quiet_NaN();
  if (is("more regions")) arrays.regions = {0, 1};
  if (is("region too large")) arrays.regions = {2};  // of one tet
  if (is("region negative")) arrays.regions = {-1};
  if (is("too few points")) arrays.points.resize(9), arrays.tets = {0, 1, 2, 0};
  if (is("no points")) arrays.points.clear(), arrays.tets.clear();
  if (is("no tets")) arrays.tets.clear();
  if (is("moved point")) arrays.points[0] += 1e-9;
  if (is("inside out")) arrays.tets = {1, 0, 2, 3};
  if (is("tet twice")) arrays.tets = {0, 1, 2, 3, 0, 1, 2, 3};
  if (is("flat tet")) arrays.tets = {0, 1, 2, 2};
  if (is("region")) arrays.regions = {1};
}

void write_arrays(const Arrays &arrays) {
  off_t offset = 0;
  const auto write = [&](const void *data, std::size_t size) {
    if (is("dies half-way") && offset > 0) std::raise(SIGKILL);
    if (::pwrite(response_descriptor, data, size, offset) != ssize_t(size)) std::exit(7);
    offset += off_t(size);
  };
  write(arrays.points.data(), arrays.points.size() * 8);
  write(arrays.tets.data(), arrays.tets.size() * 4);
  write(arrays.regions.data(), arrays.regions.size() * 4);
}

void tamper(Reply &reply) {
  if (is("answers another call")) reply.number--;
  if (is("negative counts")) reply.points = -1;
  if (is("huge counts")) reply.tets = std::numeric_limits<std::int64_t>::max();
  if (is("more than written")) reply.points = 500000000;
  if (is("less than written")) reply.points--;
  if (is("other regions")) reply.regions = 3;
  if (is("hole") || is("hole of terabytes")) {
    reply.points = is("hole") ? 400000000 : std::int64_t(1) << 40;
    if (::ftruncate(response_descriptor, off_t(reply.points * 24 + 16)) != 0) std::exit(8);
  }
  if (is("text without end")) {
    reply.code = 2;
    std::memset(reply.text, 'x', sizeof reply.text);
  }
}

void become_real_after_failures(const char *file) {
  struct stat status = {};
  ::stat(file, &status);
  if (status.st_size >= std::atoi(mode.c_str())) ::execl(TETLOD_REMESH, TETLOD_REMESH, nullptr);
}

void fail_once_more(const char *file) {
  const int descriptor = ::open(file, O_WRONLY | O_CREAT | O_APPEND, 0600);
  if (::write(descriptor, "x", 1) != 1) std::exit(10);
  tell(internal_error, "failed as told");
}

void serve() {
  if (const char *file = std::getenv("FAKE_REMESH_FAILURES")) return fail_once_more(file);
  misbehave();
  if (is("descriptors")) return tell(100 + open_descriptors(), "descriptors");
  if (is("signals")) return tell(100 + signals_not_as_they_should_be(), "signals");
  Arrays arrays = honest_arrays();
  tamper(arrays);
  write_arrays(arrays);
  Reply reply;
  reply.number = call.number;
  reply.points = std::int64_t(arrays.points.size() / 3);
  reply.tets = std::int64_t(arrays.tets.size() / 4);
  reply.regions = std::int64_t(arrays.regions.size());
  tamper(reply);
  send(reply);
  if (is("dies afterwards")) std::raise(SIGKILL);
  if (is("answers twice")) send(reply);
}

}  // namespace

int main() {
  const char *chosen = std::getenv("FAKE_REMESH");
  mode = chosen ? chosen : "";
  if (const char *file = std::getenv("FAKE_REMESH_FAILURES")) become_real_after_failures(file);
  Start start;
  if (!receive(start)) return 4;
  greet();
  while (receive(call)) serve();
}
