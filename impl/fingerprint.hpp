// Has an array of the caller changed since it was last looked at? Is a result the same? A number of the contents tells.
#pragma once
#include <cstdint>
#include <cstring>

#include "job.hpp"
#include "strided.hpp"

namespace tetlod {

/// 128 bits: two different inputs have the same with a chance of 2^-128, unless somebody looks for such.
class Fingerprint {
 public:
  void add(std::uint64_t word) {
    lane_[at_] = (lane_[at_] ^ word) * 0x9e3779b97f4a7c15u;
    lane_[at_] ^= lane_[at_] >> 29;
    at_ = (at_ + 1) % lanes;
  }
  void add(double real) {
    std::uint64_t word;
    std::memcpy(&word, &real, sizeof word);
    add(word);
  }
  template <class T>
  void add(Span<const T> items, Job &job) {
    add(std::uint64_t(items.size()));
    add_bytes(reinterpret_cast<const unsigned char *>(items.data()), items.size() * sizeof(T), job);
  }
  /// Contents, type and layout; not where it lies.
  void add(const StridedArray &array, Job &job);

  /// Half of it.
  std::uint64_t number() const { return word(0); }
  friend bool operator==(const Fingerprint &a, const Fingerprint &b) {
    return a.word(0) == b.word(0) && a.word(1) == b.word(1);
  }

 private:
  static constexpr std::size_t lanes = 4;  // the multiplications of different lanes overlap

  std::uint64_t word(std::size_t half) const {
    std::uint64_t all = at_;
    for (std::size_t k = 0; k < lanes; k++) {
      all = (all ^ lane_[(k + half) % lanes]) * (half ? 0xbf58476d1ce4e5b9u : 0x94d049bb133111ebu);
      all ^= all >> 31;
    }
    return all;
  }
  template <class Word>
  void add_elements(const StridedArray &array, Job &job);
  void add_bytes(const unsigned char *bytes, std::size_t count, Job &job);
  template <class Add>
  void add_parts(std::size_t count, Job &job, const Add &add_item);

  std::size_t at_ = 0;
  std::uint64_t lane_[lanes] = {0x51ed270b0a1f39c1u, 0x2545f4914f6cdd1du, 0x9e6c63d0676a9a99u, 0xd6e8feb86659fd93u};
};

}  // namespace tetlod
