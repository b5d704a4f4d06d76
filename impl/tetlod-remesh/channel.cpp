// SPDX-License-Identifier: AGPL-3.0-or-later
#include "channel.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace tetlod::worker {

namespace {

/// What one system call is asked to move; Linux stops short of 2^31 bytes anyway.
constexpr std::uint64_t chunk = std::uint64_t(1) << 28;

/// Of the call that is being served. A failure may come from anywhere below TetGen, hence the variable.
std::uint64_t current_call = 0;

/// Moves `bytes` with pread or pwrite, which may do less than they are asked.
template <class Call>
bool transfer(std::uint64_t bytes, const Call &call) {
  for (std::uint64_t done = 0; done < bytes;) {
    const ssize_t moved = call(done, std::min(chunk, bytes - done));
    if (moved < 0 && errno == EINTR) continue;
    if (moved <= 0) return false;
    done += std::uint64_t(moved);
  }
  return true;
}

/// The highest resident size of this process so far. Not getrusage: its maximum is inherited from the host, which
/// posix_spawn shares its memory with for a moment.
std::uint64_t peak_bytes() {
  std::FILE *status = std::fopen("/proc/self/status", "re");
  if (!status) return 0;
  unsigned long long kilobytes = 0;
  char line[256];
  while (std::fgets(line, sizeof line, status))
    if (std::sscanf(line, "VmHWM: %llu", &kilobytes) == 1) break;
  std::fclose(status);
  return std::uint64_t(kilobytes) * 1024;
}

}  // namespace

bool receive(void *message, std::size_t bytes) {
  ssize_t received;
  do {
    received = ::recv(protocol::control_descriptor, message, bytes, MSG_TRUNC);
  } while (received < 0 && errno == EINTR);
  return received == ssize_t(bytes);
}

bool send(const void *message, std::size_t bytes) {
  ssize_t sent;
  do {
    sent = ::send(protocol::control_descriptor, message, bytes, MSG_NOSIGNAL);
  } while (sent < 0 && errno == EINTR);
  return sent == ssize_t(bytes);
}

bool receive_call(protocol::Call &call) {
  if (!receive(&call, sizeof call)) return false;
  current_call = call.number;
  return true;
}

bool send_reply(protocol::Reply &reply) {
  reply.number = current_call;
  reply.peak_bytes = peak_bytes();
  return send(&reply, sizeof reply);
}

void RequestReader::read(void *data, std::uint64_t bytes) {
  const bool complete = transfer(bytes, [&](std::uint64_t done, std::uint64_t size) {
    return ::pread(protocol::request_descriptor, static_cast<char *>(data) + done, size, off_t(offset_ + done));
  });
  if (!complete) fail(protocol::internal_error, "the request file is shorter than the call says");
  offset_ += bytes;
}

void ResponseWriter::write(const void *data, std::uint64_t bytes) {
  const bool complete = transfer(bytes, [&](std::uint64_t done, std::uint64_t size) {
    return ::pwrite(protocol::response_descriptor, static_cast<const char *>(data) + done, size, off_t(offset_ + done));
  });
  if (!complete) fail(protocol::out_of_memory, "no room in the response file");
  offset_ += bytes;
}

void fail(int code, const char *text) noexcept {
  protocol::Reply reply;
  reply.code = code;
  std::strncpy(reply.text, text, sizeof reply.text - 1);
  send_reply(reply);
  ::_exit(3);
}

}  // namespace tetlod::worker
