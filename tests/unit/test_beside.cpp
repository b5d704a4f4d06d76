// What is done beside something else: once, by one thread or by several, and never longer than it is wanted.
#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "beside.hpp"
#include "meshes.hpp"
#include "status.hpp"
#include "whole_arrays.hpp"

namespace tetlod {
namespace {

using namespace test;

constexpr std::chrono::milliseconds a_while{20};

class DoneBeside : public testing::TestWithParam<int> {
 protected:
  Host host{GetParam()};
  std::atomic<int> begun{0};

  bool has_other_threads() const { return GetParam() > 1 && std::thread::hardware_concurrency() > 1; }
  void wait_until_begun() const {
    while (begun == 0) std::this_thread::sleep_for(a_while);
  }
  /// Nothing but a poll ends it.
  void poll_on() {
    begun++;
    for (;;) host.job.poll(0);
  }
  std::vector<std::size_t> squares() {
    std::vector<std::size_t> of(5 * stretch);
    for_each(of.size(), host.job, [&](std::size_t i) { of[i] = i * i; });
    return of;
  }
};

TEST_P(DoneBeside, BothUseAllThreads) {
  std::vector<std::size_t> beside;
  Beside other(host.job, [&] {
    begun++;
    beside = squares();
  });
  const std::vector<std::size_t> here = squares();
  other.finish();
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(beside, here);
}

TEST_P(DoneBeside, WhatItThrowsIsThrownWhereItIsWaitedFor) {
  Beside other(host.job, [] { throw std::runtime_error("beside"); });
  EXPECT_THROW(other.finish(), std::runtime_error);
}

TEST_P(DoneBeside, EndsWithWhatItIsFor) {
  {
    Beside other(host.job, [&] { poll_on(); });
    if (has_other_threads()) wait_until_begun();
  }
  EXPECT_EQ(begun, has_other_threads());
}

TEST_P(DoneBeside, TheHostMayCancelTheWait) {
  host.job.progress = [](Stage, double) { return true; };
  Beside other(host.job, [&] { poll_on(); });
  if (has_other_threads()) wait_until_begun();
  try {
    other.finish();
    FAIL() << "not cancelled";
  } catch (const Error &error) {
    EXPECT_EQ(error.status(), Status::cancelled);
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, DoneBeside, testing::Values(1, 2));

}  // namespace
}  // namespace tetlod
