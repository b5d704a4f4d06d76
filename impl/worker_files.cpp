#include "worker_files.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "geometry.hpp"
#include "status.hpp"

namespace tetlod {

namespace {

constexpr std::size_t chunk = std::size_t(1) << 22;  // bytes moved between two polls of the job

/// A process that may not write so large a file is killed by SIGXFSZ when it tries: so ask first.
void check_file_size_limit(std::uint64_t bytes) {
  rlimit limit;
  if (::getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || bytes <= limit.rlim_cur) return;
  fail(Status::memory, "the request to the remeshing process has %llu bytes, the file size limit (ulimit -f) is %llu",
       static_cast<unsigned long long>(bytes), static_cast<unsigned long long>(limit.rlim_cur));
}

/// Consecutive arrays written to a shared file.
class FileWriter {
 public:
  FileWriter(const Descriptor &file, const Patience &patience, Job &job)
      : file_(file), patience_(patience), job_(job) {}
  template <class T>
  void write(Span<const T> array) {
    const char *data = reinterpret_cast<const char *>(array.data());
    for (std::size_t left = array.size() * sizeof(T); left;) {
      const ssize_t written = ::pwrite(file_.number(), data, std::min(left, chunk), off_t(offset_));
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) fail(Status::memory, "no shared memory for the request to the remeshing process");
      data += written;
      left -= std::size_t(written);
      offset_ += std::uint64_t(written);
      patience_.poll(job_);
    }
  }

 private:
  const Descriptor &file_;
  const Patience &patience_;
  Job &job_;
  std::uint64_t offset_ = 0;
};

/// Consecutive arrays read from a shared file. Never mapped: a file that is cut short is an answer, not a signal.
class FileReader {
 public:
  FileReader(const Descriptor &file, const Patience &patience, Job &job)
      : file_(file), patience_(patience), job_(job) {}
  template <class T>
  bool read(std::int64_t count, Array<T> &array) {
    array.resize(std::size_t(count));
    char *data = reinterpret_cast<char *>(array.data());
    for (std::size_t left = array.size() * sizeof(T); left;) {
      const ssize_t size = ::pread(file_.number(), data, std::min(left, chunk), off_t(offset_));
      if (size < 0 && errno == EINTR) continue;
      if (size <= 0) return false;
      data += size;
      left -= std::size_t(size);
      offset_ += std::uint64_t(size);
      patience_.poll(job_);
    }
    return true;
  }

 private:
  const Descriptor &file_;
  const Patience &patience_;
  Job &job_;
  std::uint64_t offset_ = 0;
};

bool counts_agree(const protocol::Reply &answer) {
  return is_count(answer.points) && is_count(answer.tets) && (answer.regions == 0 || answer.regions == answer.tets);
}

/// Asks for the blocks in use, not for the length: a hole of terabytes would be read as zeros.
bool holds_arrays(const Descriptor &response, const protocol::Reply &answer) {
  const std::uint64_t bytes = std::uint64_t(answer.points) * protocol::point_bytes +
                              std::uint64_t(answer.tets) * protocol::tet_bytes +
                              std::uint64_t(answer.regions) * protocol::region_bytes;
  struct stat status;
  return ::fstat(response.number(), &status) == 0 && std::uint64_t(status.st_size) == bytes &&
         std::uint64_t(status.st_blocks) * 512 >= bytes;
}

bool points_are_finite(const TetgenReply &reply) {
  return std::all_of(reply.points.begin(), reply.points.end(), is_finite);
}

bool corners_are_in_range(const TetgenReply &reply) {
  const auto count = std::int32_t(reply.points.size());
  return std::all_of(reply.tets.begin(), reply.tets.end(), [count](const Tet &tet) {
    return std::all_of(tet.begin(), tet.end(), [count](std::int32_t v) { return v >= 0 && v < count; });
  });
}

bool regions_are_in_range(const TetgenReply &reply) {
  const auto count = std::int64_t(reply.tets.size());
  return std::all_of(reply.regions.begin(), reply.regions.end(),
                     [count](std::int32_t region) { return region >= 0 && region <= count; });
}

}  // namespace

bool is_count(std::int64_t count) { return count >= 0 && count <= max_count; }

void write_arrays(const Descriptor &request_file, const TetgenRequest &request, const Patience &patience, Job &job) {
  check_file_size_limit(request.points.size() * protocol::point_bytes + request.insert.size() * protocol::point_bytes +
                        request.triangles.size() * protocol::triangle_bytes);
  FileWriter writer(request_file, patience, job);
  writer.write(request.points);
  writer.write(request.insert);
  writer.write(request.triangles);
}

const char *read_arrays(const Descriptor &response_file, const protocol::Reply &answer, const Patience &patience,
                        Job &job, TetgenReply &reply) {
  if (!counts_agree(answer)) return "impossible numbers of points, tets or regions";
  if (!holds_arrays(response_file, answer)) return "fewer or more bytes than it says";
  FileReader reader(response_file, patience, job);
  if (!reader.read(answer.points, reply.points) || !reader.read(answer.tets, reply.tets) ||
      !reader.read(answer.regions, reply.regions))
    return "arrays that end too soon";
  if (!points_are_finite(reply)) return "coordinates that are not finite";
  if (!corners_are_in_range(reply)) return "corners that are no points";
  if (!regions_are_in_range(reply)) return "more regions than tets";
  return nullptr;
}

}  // namespace tetlod
