// The first of many that breaks a rule, which threads look for at once: the same for any number of them.
#pragma once
#include <atomic>
#include <cstddef>

namespace tetlod {

class FirstCulprit {
 public:
  void report(std::size_t i) {
    std::size_t now = first_.load();
    while (i < now && !first_.compare_exchange_weak(now, i)) {
    }
  }
  bool any() const { return first_.load() != none; }
  /// Of those reported so far; larger than any number if there is none.
  std::size_t index() const { return first_.load(); }

 private:
  static constexpr std::size_t none = std::size_t(-1);
  std::atomic<std::size_t> first_{none};
};

}  // namespace tetlod
