// Edges or faces brought together by their smallest vertex, as sorted 64-bit keys: what is equal lies side by side.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

class KeyFile {
 public:
  explicit KeyFile(Memory &memory) : begin_(&memory), keys_(&memory) {}

  /// enumerate(visit) calls visit(vertex, key) for every key, twice the same. `fraction` of the stage is done.
  template <class Enumerate>
  void build(std::size_t vertices, const Enumerate &enumerate, double fraction, Job &job) {
    begin_.assign(vertices + 2, 0);
    enumerate([this](std::int32_t vertex, std::uint64_t) { begin_[std::size_t(vertex) + 2]++; });
    for (std::size_t v = 2; v < begin_.size(); v++) begin_[v] += begin_[v - 1];
    keys_.resize(begin_.back());
    job.poll(fraction);
    enumerate([this](std::int32_t vertex, std::uint64_t key) { keys_[begin_[std::size_t(vertex) + 1]++] = key; });
    job.parallel.for_blocks(vertices, 4096, [&](std::size_t first, std::size_t last) {
      job.poll(fraction);
      for (std::size_t v = first; v < last; v++) {
        const Span<std::uint64_t> drawer(keys_.data() + begin_[v], begin_[v + 1] - begin_[v]);
        std::sort(drawer.begin(), drawer.end());
      }
    });
  }

  std::size_t vertices() const { return begin_.empty() ? 0 : begin_.size() - 2; }

  /// The keys filed under a vertex, ascending.
  Span<const std::uint64_t> of(std::size_t vertex) const {
    return {keys_.data() + begin_[vertex], begin_[vertex + 1] - begin_[vertex]};
  }

 private:
  Array<std::size_t> begin_;
  Array<std::uint64_t> keys_;
};

/// A face as a key: the same for the same three corners but for the lowest bit, which tells the two sides apart.
struct FaceKey {
  std::int32_t vertex;  ///< the smallest
  std::uint64_t key;
  FaceKey(std::int32_t a, std::int32_t b, std::int32_t c) {
    while (a > b || a > c) {
      const std::int32_t first = a;
      a = b;
      b = c;
      c = first;
    }
    vertex = a;
    key = std::uint64_t(std::min(b, c)) << 32 | std::uint64_t(std::max(b, c)) << 1 | std::uint64_t(b > c);
  }
  explicit FaceKey(const Triangle &t) : FaceKey(t[0], t[1], t[2]) {}
  std::uint64_t other_side() const { return key ^ 1; }
};

/// The faces that these triangles are; both sides of one are two.
inline void file_faces(Span<const Triangle> triangles, std::size_t vertices, double fraction, Job &job,
                       KeyFile &faces) {
  const auto enumerate = [&](const auto &visit) {
    for (const Triangle &t : triangles) {
      const FaceKey face(t);
      visit(face.vertex, face.key);
    }
  };
  faces.build(vertices, enumerate, fraction, job);
}

}  // namespace tetlod
