// The faces of a tetrahedral mesh, the uses of each side by side: a counting sort by the lowest vertex, in a few chunks
// of vertices so that memory stays small, then a match of pairs inside the buckets of the vertices.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "whole_arrays.hpp"

namespace tetlod {

/// A tet's use of a face, in the bucket of the face's lowest vertex.
struct FaceUse {
  std::int32_t middle, high;  ///< the two other vertices
  std::uint32_t use;          ///< 4 t + k: the face of tet t opposite its corner k
  std::uint64_t others() const { return std::uint64_t(middle) << 32 | std::uint32_t(high); }
  /// As good as others() to tell faces apart, and sooner read: the first two members.
  std::uint64_t key() const {
    std::uint64_t key;
    std::memcpy(&key, this, sizeof key);
    return key;
  }
  std::size_t tet() const { return use / 4; }
  std::size_t corner() const { return use % 4; }
};

/// The corner of its tet that is none of the face's.
inline std::int32_t tip_of(const FaceUse &use, Span<const Tet> tets) { return tets[use.tet()][use.corner()]; }

/// Two tets on one face are neighbours; not so more, and one that is given twice.
inline bool are_neighbours(Span<const FaceUse> uses, Span<const Tet> tets) {
  return uses.size() == 2 && tip_of(uses[0], tets) != tip_of(uses[1], tets);
}

/// Which of the uses of one face are of tets that an earlier one is, too: given twice, as their tips say.
Array<std::uint8_t> find_given_again(Span<const FaceUse> uses, Span<const Tet> tets, Job &job);

class FaceSweep {
 public:
  /// Tets with excluded[t] != 0 are left out (empty: none).
  FaceSweep(const MeshView &mesh, Span<const std::uint8_t> excluded, Job &job)
      : mesh_(mesh), excluded_(excluded), job_(job), begin_(mesh.points.size() + 1, 0, &job.memory) {
    for_each_tet(0, [&](std::size_t, std::int32_t low, std::int32_t second) {
      begin_[std::size_t(low) + 1] += 3;
      begin_[std::size_t(second) + 1]++;
    });
    for (std::size_t v = 0; v + 1 < begin_.size(); v++) begin_[v + 1] += begin_[v];
  }

  std::size_t chunks() const { return std::clamp<std::size_t>(begin_.back() / least_faces, 1, most_chunks); }

  /// visit(chunk, lowest vertex, first, last) for the uses of every face, by their tets; by vertex, of which faces used
  /// once, as all where one is used more than twice, come by the middle and the highest vertex. Chunks are visited by
  /// different threads at once, each in order.
  template <class Visit>
  void visit(const Visit &visit) const {
    job_.parallel.for_blocks(chunks(), 1, [&](std::size_t chunk, std::size_t) { visit_chunk(chunk, visit); });
  }

 private:
  static constexpr std::size_t most_chunks = 4;
  static constexpr std::size_t least_faces = 1 << 14;

  /// The first vertex of a chunk: each has about as many faces.
  std::size_t first_vertex(std::size_t chunk) const {
    const std::size_t faces = std::size_t(std::uint64_t(begin_.back()) * chunk / chunks());
    if (chunk == chunks()) return begin_.size() - 1;
    return std::size_t(std::lower_bound(begin_.begin(), begin_.end() - 1, faces) - begin_.begin());
  }

  template <class Visit>
  void visit_chunk(std::size_t chunk, const Visit &visit) const {
    const std::size_t first = first_vertex(chunk), last = first_vertex(chunk + 1);
    if (first >= last) return;
    Array<std::uint32_t> place(begin_.begin() + std::ptrdiff_t(first), begin_.begin() + std::ptrdiff_t(last),
                               &job_.memory);
    const std::uint32_t base = begin_[first];
    Array<FaceUse> faces(&job_.memory);
    grow(faces, begin_[last] - base, job_);
    const auto put = [&](std::int32_t low, std::int32_t middle, std::int32_t high, std::uint32_t use) {
      const std::size_t v = std::size_t(low) - first;  // wraps below the chunk
      if (v < place.size()) faces[place[v]++ - base] = {middle, high, use};
    };
    for_each_tet(double(chunk) / double(chunks()), [&](std::size_t t, std::int32_t low, std::int32_t second) {
      if ((std::size_t(low) - first < place.size()) | (std::size_t(second) - first < place.size())) for_faces(t, put);
    });
    for (std::size_t v = first; v < last; v++) {
      visit_bucket(chunk, std::int32_t(v), faces.data() + (begin_[v] - base), faces.data() + (begin_[v + 1] - base),
                   visit);
      if (v % 4096 == 0) job_.poll(double(v) / double(begin_.size()));
    }
  }

  template <class Visit>
  static void visit_bucket(std::size_t chunk, std::int32_t low, FaceUse *first, FaceUse *last, const Visit &visit) {
    const auto visit_uses = [&](const FaceUse *from, const FaceUse *to) { visit(chunk, low, from, to); };
    if (!visit_pairs(first, last, visit_uses)) visit_sorted(first, last, visit_uses);
  }

  /// False, and nothing is visited: there are many uses, or more than two of one face.
  template <class Visit>
  static bool visit_pairs(FaceUse *first, FaceUse *last, const Visit &visit) {
    constexpr std::size_t most = 96, slots = 256;
    constexpr std::uint8_t none = 255;
    const auto count = std::size_t(last - first);
    if (count > most) return false;
    std::uint8_t slot[slots], mate[most];  // by hash, the first use of a face; of a use, the other one
    std::fill(std::begin(slot), std::end(slot), none);
    for (std::size_t i = 0; i < count; i++) {
      mate[i] = none;
      const std::uint64_t face = first[i].key();
      std::size_t at = (face * 0x9e3779b97f4a7c15u) >> 56;
      while (slot[at] != none && first[slot[at]].key() != face) at = (at + 1) % slots;
      const std::uint8_t other = slot[at];
      if (other == none) {
        slot[at] = std::uint8_t(i);
        continue;
      }
      if (mate[other] != none) return false;
      mate[other] = std::uint8_t(i);
      mate[i] = other;
    }
    FaceUse single[most];
    std::size_t singles = 0;
    for (std::size_t i = 0; i < count; i++) {
      if (mate[i] == none) {
        single[singles++] = first[i];
      } else if (mate[i] > i) {
        const FaceUse pair[2] = {first[i], first[mate[i]]};
        visit(pair, pair + 2);
      }
    }
    visit_sorted(single, single + singles, visit);
    return true;
  }

  template <class Visit>
  static void visit_sorted(FaceUse *first, FaceUse *last, const Visit &visit) {
    std::sort(first, last, [](const FaceUse &a, const FaceUse &b) {  // one branch, for none can be foreseen
      return (a.others() < b.others()) | ((a.others() == b.others()) & (a.use < b.use));
    });
    while (first != last) {
      const FaceUse *same = first + 1;
      while (same != last && same->others() == first->others()) same++;
      visit(static_cast<const FaceUse *>(first), same);
      first += same - first;
    }
  }

  /// visit(t, the lowest vertex of tet t, the second lowest).
  template <class Visit>
  void for_each_tet(double fraction, const Visit &visit) const {
    for (std::size_t t = 0; t < mesh_.tets.size(); t++) {
      if (t % (1 << 18) == 0) job_.poll(fraction);
      if (!excluded_.empty() && excluded_[t]) continue;
      const Tet &v = mesh_.tets[t];
      const auto [low, high] = std::pair(std::min(v[0], v[1]), std::max(v[0], v[1]));
      const auto [other_low, other_high] = std::pair(std::min(v[2], v[3]), std::max(v[2], v[3]));
      visit(t, std::min(low, other_low), std::min(std::max(low, other_low), std::min(high, other_high)));
    }
  }

  /// visit(lowest, middle, highest vertex, use) of the faces of tet t.
  template <class Visit>
  void for_faces(std::size_t t, const Visit &visit) const {
    std::uint64_t sorted[4];  // 4 v + k, once for all four faces
    for (std::size_t k = 0; k < 4; k++) sorted[k] = 4 * std::uint64_t(mesh_.tets[t][k]) + k;
    const auto order = [&](std::size_t a, std::size_t b) {
      const auto [low, high] = std::pair(std::min(sorted[a], sorted[b]), std::max(sorted[a], sorted[b]));
      sorted[a] = low;
      sorted[b] = high;
    };
    const auto v = [&](std::size_t k) { return std::int32_t(sorted[k] / 4); };
    const auto use = [&](std::size_t k) { return std::uint32_t(4 * t + sorted[k] % 4); };
    order(0, 1);
    order(2, 3);
    order(0, 2);
    order(1, 3);
    order(1, 2);
    visit(v(0), v(1), v(2), use(3));
    visit(v(0), v(1), v(3), use(2));
    visit(v(0), v(2), v(3), use(1));
    visit(v(1), v(2), v(3), use(0));
  }

  const MeshView &mesh_;
  Span<const std::uint8_t> excluded_;
  Job &job_;
  Array<std::uint32_t> begin_;  // of the bucket of each vertex
};

/// visit(first, last) for the uses of every face, as FaceSweep has them, by the calling thread alone.
template <class Visit>
void for_each_face(const MeshView &mesh, Span<const std::uint8_t> excluded, Job &job, const Visit &visit) {
  const Parallel one_thread(1);
  Job alone(job.memory, one_thread);
  alone.cancel = job.cancel;
  alone.progress = [&](Stage, double fraction) {
    job.poll(fraction);
    return false;
  };
  FaceSweep(mesh, excluded, alone).visit([&](std::size_t, std::int32_t, const FaceUse *first, const FaceUse *last) {
    visit(first, last);
  });
}

}  // namespace tetlod
