// What the library and its worker process tetlod-remesh say to each other.
//
// The worker is started with three descriptors: a SOCK_SEQPACKET socket for the messages below, and two shared
// files. The host writes the arrays of a call into the request file and sends Call; the worker writes the arrays
// of its answer into the response file and sends Reply. Arrays follow each other without gaps, in native layout.
#pragma once
#include <cstdint>
#include <type_traits>

namespace tetlod::protocol {

/// Numbers of the inherited descriptors in the worker. 0 reads nothing; 1 and 2 are the host's log.
constexpr int control_descriptor = 3;
constexpr int request_descriptor = 4;
constexpr int response_descriptor = 5;
constexpr int first_free_descriptor = 6;

/// Status that the worker exits with before it greets, where the system has no thread that would watch the host.
constexpr int no_thread = 4;

constexpr std::uint32_t magic = 0x54455431;
constexpr std::uint32_t version = 1;

/// Host to worker, first. The layouts of Start and Hello are the same in every version.
struct Start {
  std::uint32_t magic = protocol::magic;
  std::uint32_t version = protocol::version;
  std::int64_t host_pid = 0;        ///< the worker ends when this is no longer its parent
  std::uint64_t address_space = 0;  ///< limit of the worker in bytes, 0: none
};

/// Worker to host, the answer to Start.
struct Hello {
  std::uint32_t magic = protocol::magic;
  std::uint32_t version = protocol::version;
  char tetlod_version[48] = {};
};

/// Host to worker. Request file: points, inserted points (3 doubles each), triangles (3 int32 each).
struct Call {
  std::uint64_t number = 0;  ///< of the call, so that no answer is taken for that to another
  std::int64_t points = 0;
  std::int64_t inserted = 0;
  std::int64_t triangles = 0;
  char switches[64] = {};
};

/// Worker to host, the answer to Call. Response file: points (3 doubles each), tets (4 int32 each), regions (int32).
/// After a code that is not 0 the worker ends.
struct Reply {
  std::uint64_t number = 0;  ///< the call's
  std::int64_t points = 0;
  std::int64_t tets = 0;
  std::int64_t regions = 0;  ///< as many as tets with switch A, else 0
  std::uint64_t peak_bytes = 0;
  std::int32_t code = 0;  ///< 0, or TetGen's
  char text[180] = {};    ///< what happened when code is not 0
};

/// TetGen's code for "out of memory"; the worker uses it for its own arrays too.
constexpr int out_of_memory = 1;
/// TetGen's code for "internal error"; the worker uses it for failed assertions too.
constexpr int internal_error = 2;

constexpr std::uint64_t point_bytes = 24, triangle_bytes = 12, tet_bytes = 16, region_bytes = 4;

static_assert(std::is_trivially_copyable_v<Start> && sizeof(Start) == 24, "no padding goes through the socket");
static_assert(std::is_trivially_copyable_v<Hello> && sizeof(Hello) == 56, "no padding goes through the socket");
static_assert(std::is_trivially_copyable_v<Call> && sizeof(Call) == 96, "no padding goes through the socket");
static_assert(std::is_trivially_copyable_v<Reply> && sizeof(Reply) == 224, "no padding goes through the socket");

}  // namespace tetlod::protocol
