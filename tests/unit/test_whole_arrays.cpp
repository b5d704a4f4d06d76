// Steps over whole arrays against loops, at the borders of stretches, by one thread and by several.
#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <vector>

#include "fingerprint.hpp"
#include "meshes.hpp"
#include "whole_arrays.hpp"

namespace tetlod {
namespace {

using namespace test;

static_assert(!std::is_copy_constructible_v<Array<double>>, "a copy would leave the caller's memory");

class WholeArrays : public testing::TestWithParam<int> {
 protected:
  Host host{GetParam()};
  const std::vector<std::size_t> sizes{0, 1, stretch - 1, stretch, stretch + 1, 5 * stretch + 7};

  Array<std::int32_t> random_numbers(std::size_t size) {
    Array<std::int32_t> numbers = array_of(size, 0, host.job);
    std::mt19937 random(std::uint32_t(size) + 1);
    for (std::int32_t &n : numbers) n = std::int32_t(random() % 100);
    return numbers;
  }
};

TEST_P(WholeArrays, KeepInOrder) {
  for (std::size_t size : sizes)
    for (int most : {0, 3, 60, 100}) {
      Array<std::int32_t> numbers = random_numbers(size);
      std::vector<std::int32_t> expected;
      for (std::int32_t n : numbers)
        if (n < most) expected.push_back(n);
      keep_where(numbers, host.job, [&](std::size_t i) { return numbers[i] < most; });
      ASSERT_EQ(std::vector<std::int32_t>(numbers.begin(), numbers.end()), expected) << size << ' ' << most;
      EXPECT_LE(numbers.capacity(), 2 * expected.size()) << size << ' ' << most;
    }
}

/// Of several huge pages, which threads touch: nothing else is written to.
TEST_P(WholeArrays, GrowOverManyPages) {
  for (std::size_t before : {0, 1, 300001}) {
    Array<double> numbers(before, 0.5, &host.memory);
    grow(numbers, 1000003, host.job, 1.5);
    ASSERT_EQ(numbers.size(), 1000003U);
    for (std::size_t i = 0; i < numbers.size(); i++) ASSERT_EQ(numbers[i], i < before ? 0.5 : 1.5) << i;
  }
}

TEST_P(WholeArrays, PartsAddUp) {
  for (std::size_t size : sizes) {
    const Array<std::int32_t> numbers = random_numbers(size);
    const auto sum = [&](std::size_t begin, std::size_t end) {
      return std::accumulate(numbers.begin() + std::ptrdiff_t(begin), numbers.begin() + std::ptrdiff_t(end), 0l);
    };
    const Array<std::int64_t> parts =
        parts_of(size, std::int64_t(0), host.job, [&](std::int64_t &part, std::size_t i) { part += numbers[i]; });
    ASSERT_EQ(parts.size(), size / stretch + 1);
    for (std::size_t i = 0; i < parts.size(); i++)
      ASSERT_EQ(parts[i], sum(std::min(size, i * stretch), std::min(size, (i + 1) * stretch))) << size << ' ' << i;
  }
}

/// Whatever the threads, and another whichever word changes.
TEST_P(WholeArrays, FingerprintsTellEveryWord) {
  Host alone;
  const std::size_t size = 3 * stretch + 5;
  Array<double> reals = array_of(size, 1.5, host.job);
  const auto fingerprint = [&](Job &job) {
    Fingerprint of;
    of.add(Span<const double>(reals), job);
    return of;
  };
  const Fingerprint before = fingerprint(alone.job);
  EXPECT_TRUE(fingerprint(host.job) == before);
  for (std::size_t i : {std::size_t(0), stretch - 1, stretch, 2 * stretch + 77, size - 1}) {
    reals[i] = -0.0;
    EXPECT_FALSE(fingerprint(host.job) == before) << i;
    reals[i] = 1.5;
  }
  reals[3] = 2;
  const Fingerprint first = fingerprint(host.job);
  std::swap(reals[3], reals[stretch + 3]);
  EXPECT_FALSE(fingerprint(host.job) == first) << "the order of the parts";
}

INSTANTIATE_TEST_SUITE_P(Threads, WholeArrays, testing::Values(1, 2, 3));

}  // namespace
}  // namespace tetlod
