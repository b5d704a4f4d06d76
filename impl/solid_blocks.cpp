#include "solid_blocks.hpp"

namespace tetlod {

namespace {

/// Vertices that a block must have, so that most of them are inside.
constexpr std::size_t least_in_block = 4000;
/// Where the cuts go, as shares of the vertices, in one round after another.
constexpr double shares[] = {0.5, 0.4, 0.6, 0.45, 0.55, 0.35, 0.65};

/// Halves of halves of halves, each across its longest side; the first cut is number 1, those below i are 2 i, 2 i + 1.
class Cuts {
 public:
  Cuts(Array<Vec3> &sample, std::size_t blocks, double share) : blocks_(blocks) {
    if (!sample.empty()) cut({sample.data(), sample.size()}, 1, share);
  }

  std::size_t block_of(const Vec3 &p) const {
    std::size_t i = 1;
    while (i < blocks_) i = 2 * i + (p[axis_[i]] < at_[i] ? 0 : 1);
    return i - blocks_;
  }

 private:
  void cut(Span<Vec3> part, std::size_t i, double share) {
    if (i >= blocks_ || part.empty()) return;
    const int axis = box_of(Span<const Vec3>(part.data(), part.size())).longest_axis();
    const auto first = std::size_t(share * double(part.size()));
    std::nth_element(part.begin(), part.begin() + first, part.end(),
                     [&](const Vec3 &a, const Vec3 &b) { return a[axis] < b[axis]; });
    axis_[i] = axis;
    at_[i] = part[first][axis];
    cut({part.data(), first}, 2 * i, share);
    cut({part.data() + first, part.size() - first}, 2 * i + 1, share);
  }

  std::size_t blocks_;
  int axis_[SolidBlocks::most] = {};
  double at_[SolidBlocks::most] = {};
};

}  // namespace

void SolidBlocks::cut(const SolidComplex &mesh, Span<const std::int32_t> left, int round, std::size_t most_blocks,
                      Job &job) {
  constexpr std::size_t enough = 4096;
  count_ = 1;
  while (2 * count_ <= most_blocks && left.size() >= 2 * count_ * least_in_block) count_ *= 2;
  if (count_ == 1) return;
  Array<Vec3> sample(&job.memory);
  for (std::size_t i = 0; i < left.size(); i += left.size() / enough + 1) sample.push_back(mesh.point(left[i]));
  const Cuts cuts(sample, count_, shares[std::size_t(round) % std::size(shares)]);
  job.parallel.for_blocks(left.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) {
      const auto v = std::size_t(left[i]);
      block_[v] = std::uint8_t(cuts.block_of(mesh.points[v]));
      at_border_[v] = 0;
    }
  });
  find_borders(mesh, job);
}

/// Tet by tet: in order of memory, and once, unlike the stars of the vertices.
void SolidBlocks::find_borders(const SolidComplex &mesh, Job &job) {
  const auto block_of = [&](std::int32_t v) { return unsigned(block_[std::size_t(v)]); };
  const auto crosses = [&](const Tet &t) {
    const unsigned first = block_of(t[0]);
    return ((first ^ block_of(t[1])) | (first ^ block_of(t[2])) | (first ^ block_of(t[3]))) != 0;
  };
  for_each(mesh.tets.size(), job, [&](std::size_t t) {
    if (!mesh.has_tet(std::int32_t(t)) || !crosses(mesh.tets[t])) return;
    for (std::int32_t v : mesh.tets[t]) set_flag(at_border_[std::size_t(v)]);
  });
}

}  // namespace tetlod
