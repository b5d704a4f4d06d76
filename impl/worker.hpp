// Runs tetlod-remesh, one process of it or several at once: spawn, shared memory, deadline, cancel, death. Nothing that
// the worker does, or fails to do, reaches the host but as a value or a Status.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// One call of TetGen, as the worker is asked for it. The caller has checked that the coordinates are finite and
/// the corners in range.
struct TetgenRequest {
  const char *switches = "";  ///< at most 63 characters
  Span<const Vec3> points;    ///< boundary vertices first, then samples (unless they come in `insert`)
  Span<const Vec3> insert;    ///< samples for the -i switch, usually empty
  Span<const Triangle> triangles;
  /// What the job is told while TetGen runs, from the fraction of the call that is done; empty: that fraction.
  std::function<double(double)> progress;
};

/// What came back, copied into the host's memory; sizes and indices are already checked against each other, and
/// coordinates are finite.
struct TetgenReply {
  explicit TetgenReply(Memory &memory) : points(&memory), tets(&memory), regions(&memory) {}
  int code = 0;         ///< 0, or TetGen's error code, or one of the failures below
  std::string failure;  ///< what happened, empty when code == 0
  Array<Vec3> points;
  Array<Tet> tets;
  Array<std::int32_t> regions;   ///< region attribute of each tet, in [0, tets], empty without switch A
  std::uint64_t peak_bytes = 0;  ///< of the worker process
};

/// Codes of TetgenReply beyond TetGen's own.
constexpr int worker_died = 1001;       ///< crash, kill
constexpr int worker_lied = 1002;       ///< a reply that contradicts itself
constexpr int worker_exhausted = 1003;  ///< its time share for this attempt ran out; it was killed

class WorkerProcess;

/// Worker processes, each started when first needed (1.3 ms), alive between calls (0.13 ms for a tetrahedron), ended
/// with the object. Used by one thread at a time. After fork() the child starts processes of its own and leaves the
/// parent's alone.
class Worker {
 public:
  /// path: the executable; empty: TETLOD_REMESHER (secure_getenv), else beside this library, else libexec.
  /// address_space: limit of each process in bytes, 0: none.
  explicit Worker(std::string path = {}, std::uint64_t address_space = 0);
  ~Worker();
  Worker(const Worker &) = delete;
  Worker &operator=(const Worker &) = delete;

  /// Has TetGen called; several processes, numbered from 0, may have a call each: begin() with one that has none, and
  /// finish_any() waits, polling the job, and gives the number of one whose call is over. What the request points to
  /// has to live until then. `seconds` is the share of this attempt, of the worker's processor time, of which waiting
  /// is a part (0: only the job's limit). When one of them throws all calls are over. Throws Status::backend_missing
  /// (with the path looked at, or the version found), cancelled, time_limit, memory, memory_limit, mesh_too_large,
  /// state (the host has forked, or closed descriptors). Everything else that goes wrong with the process is a code in
  /// the reply.
  void begin(std::size_t process, const TetgenRequest &request, double seconds, Job &job);
  std::size_t finish_any(Job &job, TetgenReply &reply);
  /// Kills the processes that are in the middle of a call.
  void abandon() noexcept;

 private:
  void forget_lost();
  void wait_for_something() const;
  void refuse_exhaustion(const TetgenReply &reply) const;

  std::vector<std::unique_ptr<WorkerProcess>> processes_;
  std::string path_;
  std::uint64_t address_space_;
};

/// How long TetGen usually needs for so many points, in seconds; a guess for progress and deadlines.
double expected_seconds(std::size_t points);

/// The executable a Worker with an empty path would start.
std::string find_remesher();

}  // namespace tetlod
