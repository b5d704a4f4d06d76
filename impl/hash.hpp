// A number for the bytes of a result: the same result, the same number.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Of the bytes, eight at a time.
class Hash {
 public:
  template <class T>
  void add(const Array<T> &array, Job &job) {
    const auto *bytes = reinterpret_cast<const unsigned char *>(array.data());
    const std::size_t size = array.size() * sizeof(T);
    mix(size);
    for (std::size_t i = 0; i < size; i += 8) {
      if (i % (std::size_t(1) << 24) == 0) job.poll(1);
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + i, std::min<std::size_t>(8, size - i));
      mix(word);
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  void mix(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9e3779b97f4a7c15u;
    value_ ^= value_ >> 29;
  }
  std::uint64_t value_ = 0x51ed270b0a1f39c1u;
};

inline std::uint64_t hash_of(const TetMesh &mesh, Job &job) {
  Hash hash;
  hash.add(mesh.points, job);
  hash.add(mesh.scalars, job);
  hash.add(mesh.tets, job);
  return hash.value();
}

}  // namespace tetlod
