#include "face_pass.hpp"

#include <stdexcept>
#include <thread>

namespace bench {

FacePass::FacePass(const std::vector<Tet> &tets, std::int64_t threads)
    : tets_(tets),
      threads_(threads > 0 ? std::size_t(threads) : std::thread::hardware_concurrency()),
      faces_(4 * tets.size()) {}

Cost FacePass::run() {
  const Stopwatch watch;
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < threads_; i++) others.emplace_back([this, i] { part(i); });
  part(0);
  for (std::thread &other : others) other.join();
  const Cost cost = watch.cost();
  // What nobody reads, the compiler need not write.
  for (std::size_t i = 0; i < faces_.size(); i += 1 << 16) {
    if (faces_[i][0] < 0) throw std::runtime_error("a tet has a negative vertex");
  }
  return cost;
}

void FacePass::part(std::size_t i) {
  const std::size_t end = tets_.size() * (i + 1) / threads_;
  for (std::size_t t = tets_.size() * i / threads_; t < end; t++) {
    const auto [a, b, c, d] = tets_[t];
    faces_[4 * t] = {b, c, d};
    faces_[4 * t + 1] = {a, d, c};
    faces_[4 * t + 2] = {a, b, d};
    faces_[4 * t + 3] = {a, c, b};
  }
}

}  // namespace bench
