// SPDX-License-Identifier: AGPL-3.0-or-later
// The worker's end of the socket and of the shared files.
#pragma once
#include <cstddef>
#include <cstdint>

#include "remesh_protocol.hpp"

namespace tetlod::worker {

bool receive(void *message, std::size_t bytes);
bool send(const void *message, std::size_t bytes);

bool receive_call(protocol::Call &call);
/// Answers the call that was received last.
bool send_reply(protocol::Reply &reply);

/// Arrays of the request file, one after the other. Ends the process when the file is too short.
class RequestReader {
 public:
  void read(void *data, std::uint64_t bytes);

 private:
  std::uint64_t offset_ = 0;
};

/// Arrays of the response file, one after the other. Ends the process when there is no room.
class ResponseWriter {
 public:
  void write(const void *data, std::uint64_t bytes);

 private:
  std::uint64_t offset_ = 0;
};

/// Tells the host why the call failed and ends the process at once. Nothing is unwound or freed: after a failure
/// TetGen's structures are in no state to be destroyed, and the host starts another worker.
[[noreturn]] void fail(int code, const char *text) noexcept;

}  // namespace tetlod::worker
