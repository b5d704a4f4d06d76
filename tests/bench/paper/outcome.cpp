#include "outcome.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "run_peer.hpp"

namespace bench {
namespace {

static_assert(std::is_trivially_copyable_v<Outcome>, "it goes through a pipe");

Outcome failed(const std::string &why) {
  Outcome outcome{};
  std::snprintf(outcome.why_not, sizeof outcome.why_not, "%s", why.c_str());
  return outcome;
}

Outcome measured(const Original &original, const Mesh &result, double cpu) {
  Outcome outcome{};
  const Shape shape = shape_of(result);
  outcome.done = true;
  outcome.tets = std::int64_t(result.tets.size());
  outcome.kept = double(result.tets.size()) / double(original.mesh.tets.size());
  outcome.cpu = cpu;
  outcome.volume = shape.volume / original.shape.volume;
  outcome.error = measure_field_error(original.mesh, result, shape.boundary);
  outcome.valid = is_valid(original.shape, shape);
  outcome.same_topology = topology_of(shape.boundary) == original.topology;
  return outcome;
}

// Runs in the child.
[[noreturn]] void send_peer_run(const Original &original, std::int64_t tets, unsigned seconds, int to) {
  const rlimit limit{seconds, seconds};
  setrlimit(RLIMIT_CPU, &limit);
  Outcome outcome{};
  try {
    const PeerRun run = Peer(original.mesh).run(tets);
    const rlimit none{RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(RLIMIT_CPU, &none);
    outcome = run.result.tets.empty() ? failed("nothing is left") : measured(original, run.result, run.cost.cpu);
  } catch (const std::exception &error) {
    outcome = failed(error.what());
  }
  const bool sent = write(to, &outcome, sizeof outcome) == ssize_t(sizeof outcome);
  _exit(sent ? 0 : 1);
}

}  // namespace

Original original_of(const std::string &name, const std::string &path) {
  Original original{name, read_mesh(path), {}, {}};
  original.shape = shape_of(original.mesh);
  original.topology = topology_of(original.shape.boundary);
  return original;
}

Outcome run_peer_within(const Original &original, std::int64_t tets, unsigned seconds) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("cannot make a pipe");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) send_peer_run(original, tets, seconds, ends[1]);
  close(ends[1]);
  Outcome outcome{};
  const bool whole = read(ends[0], &outcome, sizeof outcome) == ssize_t(sizeof outcome);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (whole) return outcome;
  const bool late = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
  return failed(late ? "no end after " + std::to_string(seconds) + " s" : "it crashed");
}

Outcome run_ours(const Original &original, const Parameters &parameters, TetlodRun *run) {
  try {
    TetlodRun made = run_tetlod(original.mesh, parameters);
    const Outcome outcome = measured(original, made.result, made.cost.cpu);
    if (run != nullptr) *run = std::move(made);
    return outcome;
  } catch (const std::exception &error) {
    return failed(error.what());
  }
}

}  // namespace bench
