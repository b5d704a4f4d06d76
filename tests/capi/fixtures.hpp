// What the C++ tests of the ABI share: a mesh, a context that ends with its scope, a result as bytes, an allocator that
// counts and fails on demand.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "tetlod.h"

namespace tetlod_test {

/// The unit cube as n x n x n cells of 6 tets, with a field that bends.
struct Cube {
  explicit Cube(int n) {
    const auto number = [n](int x, int y, int z) { return std::int32_t((z * (n + 1) + y) * (n + 1) + x); };
    for (int z = 0; z <= n; z++)
      for (int y = 0; y <= n; y++)
        for (int x = 0; x <= n; x++) {
          xyz.insert(xyz.end(), {double(x) / n, double(y) / n, double(z) / n});
          values.push_back(double(x * x + 2 * y + z * y) / n);
        }
    static constexpr int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int z = 0; z < n; z++)
      for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++)
          for (const auto &axes : order) {
            std::array<int, 3> at = {x, y, z};
            corners.push_back(number(at[0], at[1], at[2]));
            for (int axis : axes) {
              at[std::size_t(axis)]++;
              corners.push_back(number(at[0], at[1], at[2]));
            }
          }
  }
  std::vector<double> xyz, values;
  std::vector<std::int32_t> corners;
};

/// Of more than 100,000 tets, so that `fast` makes haste, with a front that has no direction of its own.
inline Cube large_cube_with_front() {
  Cube cube(26);
  for (std::size_t v = 0; v < cube.values.size(); v++) {
    const double *const p = &cube.xyz[3 * v];
    cube.values[v] = std::tanh(6 * (std::hypot(p[0], p[1], p[2]) - 0.7));
  }
  return cube;
}

/// The cube's layers become spheres.
inline void make_ball(Cube &cube) {
  for (std::size_t v = 0; v < cube.values.size(); v++) {
    double *const p = &cube.xyz[3 * v];
    double largest = 0, length = 0;
    for (int k = 0; k < 3; k++) {
      p[k] = 2 * p[k] - 1;
      largest = std::max(largest, std::abs(p[k]));
      length = std::hypot(length, p[k]);
    }
    for (int k = 0; k < 3 && length > 0; k++) p[k] *= largest / length;
  }
}

inline tetlod_array array_of(std::int32_t type, std::size_t tuples, std::int32_t components, const void *data) {
  tetlod_array array{};
  array.struct_size = sizeof array;
  array.type = type;
  array.tuples = std::int64_t(tuples);
  array.components = components;
  array.data = const_cast<void *>(data);
  return array;
}

inline std::string message_of(const tetlod_context *context) {
  std::string message(tetlod_last_message(context, nullptr, 0), '\0');
  tetlod_last_message(context, message.data(), message.size() + 1);
  return message;
}

inline tetlod_config default_config() {
  tetlod_config config{};
  config.struct_size = sizeof config;
  config.api_version = TETLOD_API_VERSION;
  return config;
}

struct Destroy {
  void operator()(tetlod_context *context) const { tetlod_destroy(context); }
};
using Context = std::unique_ptr<tetlod_context, Destroy>;

inline Context make_context(const tetlod_config &config = default_config()) {
  tetlod_context *context = nullptr;
  EXPECT_EQ(tetlod_create(&config, &context), TETLOD_OK) << message_of(nullptr);
  return Context(context);
}

inline void submit(tetlod_context *context, const Cube &cube) {
  const std::size_t points = cube.values.size();
  const tetlod_array xyz = array_of(TETLOD_FLOAT64, points, 3, cube.xyz.data());
  const tetlod_array tets = array_of(TETLOD_INT32, cube.corners.size() / 4, 4, cube.corners.data());
  const tetlod_array values = array_of(TETLOD_FLOAT64, points, 1, cube.values.data());
  EXPECT_EQ(tetlod_submit_points(context, &xyz), TETLOD_OK);
  EXPECT_EQ(tetlod_submit_tets(context, &tets, 0), TETLOD_OK);
  EXPECT_EQ(tetlod_submit_scalars(context, "bent", &values), TETLOD_OK);
}

/// Points, tets and values of the last result, as they lie in memory.
inline std::vector<unsigned char> bytes_of(const tetlod_context *context) {
  std::vector<unsigned char> bytes;
  for (const auto view : {tetlod_view_points, tetlod_view_tets, tetlod_view_scalars}) {
    tetlod_array array{};
    array.struct_size = sizeof array;
    if (view(context, &array) != TETLOD_OK) return {};
    const auto *const data = static_cast<const unsigned char *>(array.data);
    bytes.insert(bytes.end(), data, data + array.tuples * array.tuple_stride);
  }
  return bytes;
}

/// Of the last run.
inline tetlod_run_report report_of(const tetlod_context *context) {
  tetlod_run_report report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(tetlod_fetch_report(context, &report), TETLOD_OK);
  return report;
}

/// What a run of this mesh gives in an undisturbed context.
inline std::vector<unsigned char> undisturbed(const Cube &cube) {
  const Context context = make_context();
  submit(context.get(), cube);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  std::vector<unsigned char> bytes = bytes_of(context.get());
  EXPECT_FALSE(bytes.empty());
  return bytes;
}

/// Hooks for tetlod_config. Each block remembers what it was asked as, to be compared when it is released.
class CountingAllocator {
 public:
  tetlod_config config() {
    tetlod_config config = default_config();
    config.allocate = [](void *user, std::size_t bytes, std::size_t alignment) {
      return static_cast<CountingAllocator *>(user)->allocate(bytes, alignment);
    };
    config.release = [](void *user, void *pointer, std::size_t bytes, std::size_t alignment) {
      static_cast<CountingAllocator *>(user)->release(pointer, bytes, alignment);
    };
    config.allocator_user = this;
    return config;
  }

  /// The allocation after `count` others fails, once; negative: none.
  void fail_after(long count) { left_ = count; }
  bool failed() const { return failed_; }
  void forget_failure() { failed_ = false, left_ = -1; }
  /// Lets the first allocation of call() fail, then the second, and so on, from `dense` on in growing steps, until it
  /// passes undisturbed; returns how many failed. A failure is TETLOD_ERR_MEMORY and leaves nothing behind;
  /// after(failed) looks at the rest.
  template <class Call, class After>
  long fail_each(tetlod_context *context, const Call &call, const After &after, long dense = 100000) {
    const std::size_t before = in_use_;
    long failures = 0;
    for (long n = 0; n < 200000 && !testing::Test::HasFailure(); n += n < dense ? 1 : 1 + n / 20, failures++) {
      fail_after(n);
      const tetlod_status status = call();
      const bool failed = failed_;
      forget_failure();
      EXPECT_EQ(status, failed ? TETLOD_ERR_MEMORY : TETLOD_OK) << "allocation " << n << ": " << message_of(context);
      if (failed) {
        EXPECT_EQ(in_use_, before) << "allocation " << n;
      }
      after(failed);
      if (!failed) return failures;
    }
    ADD_FAILURE() << "after " << failures << " failures of an allocation";
    return failures;
  }
  std::size_t in_use() const { return in_use_; }
  std::size_t most() const { return most_; }
  std::size_t in_all() const { return in_all_; }  ///< bytes that were asked for
  long mismatches() const { return mismatches_; }

 private:
  struct Head {
    std::size_t bytes, alignment;
  };

  static std::size_t room(std::size_t alignment) { return std::max(alignment, sizeof(Head)); }

  void *allocate(std::size_t bytes, std::size_t alignment) {
    if (left_ >= 0 && left_-- == 0) {
      failed_ = true;
      return nullptr;
    }
    const std::size_t head = room(alignment);
    auto *const block = static_cast<unsigned char *>(
        ::operator new(bytes + head, std::align_val_t(std::max(alignment, alignof(Head))), std::nothrow));
    if (!block) return nullptr;
    const Head asked{bytes, alignment};
    std::memcpy(block, &asked, sizeof asked);
    in_all_ += bytes;
    const std::size_t now = in_use_ += bytes;
    for (std::size_t most = most_; now > most && !most_.compare_exchange_weak(most, now);) {
    }
    return block + head;
  }

  void release(void *pointer, std::size_t bytes, std::size_t alignment) {
    unsigned char *const block = static_cast<unsigned char *>(pointer) - room(alignment);
    Head asked;
    std::memcpy(&asked, block, sizeof asked);
    if (asked.bytes != bytes || asked.alignment != alignment) mismatches_++;
    in_use_ -= bytes;
    ::operator delete(block, std::align_val_t(std::max(alignment, alignof(Head))));
  }

  std::atomic<long> left_{-1};
  std::atomic<bool> failed_{false};
  std::atomic<std::size_t> in_use_{0}, most_{0}, in_all_{0};
  std::atomic<long> mismatches_{0};
};

}  // namespace tetlod_test
