#include "merge_points.hpp"

#include <cstring>

#include "geometry.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// A hash table of points by a key of three numbers: their coordinates, or the cell of a grid that they lie in.
class PointTable {
 public:
  /// For points with these keys.
  template <class KeyOf>
  PointTable(std::size_t points, const KeyOf &key_of, Job &job)
      : first_(&job.memory), next_(points, -1, &job.memory), slots_(&job.memory) {
    std::size_t size = 16;
    while (size < 2 * points) size *= 2;
    first_.assign(size, -1);
    grow(slots_, points, job);
    for_each(points, job, [&](std::size_t v) { slots_[v] = slot(key_of(v)); });
  }

  void insert(std::int32_t v) {
    std::int32_t &head = first_[slots_[std::size_t(v)]];
    next_[std::size_t(v)] = head;
    head = v;
  }

  /// Of those that are in it, the ones with that key, and some others.
  template <class Visit>
  void for_key(const Vec3 &key, const Visit &visit) const {
    for_slot(slot(key), visit);
  }
  /// The ones with the key of v.
  template <class Visit>
  void for_key_of(std::int32_t v, const Visit &visit) const {
    for_slot(slots_[std::size_t(v)], visit);
  }

 private:
  template <class Visit>
  void for_slot(std::uint32_t slot, const Visit &visit) const {
    for (std::int32_t v = first_[slot]; v >= 0; v = next_[std::size_t(v)]) visit(v);
  }

  std::uint32_t slot(const Vec3 &key) const {
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; k++) {
      const double positive_zero = key[k] + 0.0;
      std::uint64_t bits;
      std::memcpy(&bits, &positive_zero, sizeof bits);
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return std::uint32_t(hash & (first_.size() - 1));
  }

  Array<std::int32_t> first_, next_;
  Array<std::uint32_t> slots_;  // of each point, found by all threads
};

std::int32_t find_equal(const PointTable &table, Span<const Vec3> points, std::int32_t v) {
  std::int32_t found = v;
  const Vec3 &p = points[std::size_t(v)];
  table.for_key_of(v, [&](std::int32_t other) {
    if (points[std::size_t(other)] == p) found = other;
  });
  return found;
}

Box box_of_used(Span<const Vec3> points, Span<const std::uint8_t> used, Job &job) {
  Box box;
  for (std::size_t v = 0; v < points.size(); v++) {
    job.poll_at(v, 0);
    if (used[v]) box.add(points[v]);
  }
  return box;
}

/// The cells of a grid, from its low corner.
struct Cells {
  Vec3 low;
  double size;
  /// Rounding keeps the order of points, so that none is missed.
  Vec3 of(const Vec3 &p) const { return glm::floor((p - low) / size); }
};

/// Points by the cells that they lie in, to look for those within a tolerance.
class PointGrid {
 public:
  PointGrid(Span<const Vec3> points, const Cells &cells, double tolerance, Job &job)
      : points_(points),
        cells_(cells),
        tolerance_(tolerance),
        table_(
            points.size(), [&](std::size_t v) { return cells.of(points[v]); }, job),
        is_inside_(array_of(points.size(), std::uint8_t(0), job)) {
    for_each(points.size(), job, [&](std::size_t v) {
      is_inside_[v] = cells.of(points[v] - tolerance) == cells.of(points[v] + tolerance);
    });
  }

  void insert(std::int32_t v) { table_.insert(v); }

  /// The lowest, v itself included.
  std::int32_t find_near(std::int32_t v) {
    std::int32_t found = v;
    const Vec3 &p = points_[std::size_t(v)];
    const auto look_at = [&](std::int32_t other) {
      looked_at_++;
      if (other < found && length2(points_[std::size_t(other)] - p) <= tolerance_ * tolerance_) found = other;
    };
    if (is_inside_[std::size_t(v)]) {
      table_.for_key_of(v, look_at);
      return found;
    }
    const Vec3 first = cells_.of(p - tolerance_), last = cells_.of(p + tolerance_);
    for (double x = first.x; x <= last.x; x++)
      for (double y = first.y; y <= last.y; y++)
        for (double z = first.z; z <= last.z; z++) table_.for_key(Vec3(x, y, z), look_at);
    return found;
  }
  /// How many others, in all.
  std::size_t looked_at() const { return looked_at_; }

 private:
  Span<const Vec3> points_;
  Cells cells_;
  double tolerance_;
  PointTable table_;
  Array<std::uint8_t> is_inside_;  // whether what is near each point lies in its cell
  std::size_t looked_at_ = 0;
};

/// find(v): the lowest point that v is merged into; insert(v): others may be into v.
template <class Find, class Insert>
std::int64_t merge(Span<const std::uint8_t> used, Job &job, Array<std::int32_t> &representative, const Find &find,
                   const Insert &insert) {
  std::int64_t merged = 0;
  representative.resize(used.size());
  for (std::size_t i = 0; i < used.size(); i++) {
    const auto v = std::int32_t(i);
    if (i % 4096 == 0) job.poll(double(i) / double(used.size()));
    representative[i] = v;
    if (!used[i]) continue;
    const std::int32_t found = find(v);
    representative[i] = found;
    merged += found != v;
    if (found == v) insert(v);
  }
  return merged;
}

std::int64_t merge_equal(Span<const Vec3> points, Span<const std::uint8_t> used, Job &job,
                         Array<std::int32_t> &representative) {
  PointTable table(
      points.size(), [&](std::size_t v) { return points[v]; }, job);
  const auto find = [&](std::int32_t v) { return find_equal(table, points, v); };
  return merge(used, job, representative, find, [&](std::int32_t v) { table.insert(v); });
}

}  // namespace

std::int64_t merge_points(Span<const Vec3> points, Span<const std::uint8_t> used, double tolerance, Job &job,
                          Array<std::int32_t> &representative) {
  constexpr double finest = 1e-12;  // of the box: others have no cell
  if (!(tolerance > 0)) return merge_equal(points, used, job, representative);
  const Box box = box_of_used(points, used, job);
  PointGrid grid(points, {box.low, std::max(tolerance, finest * box.diagonal())}, tolerance, job);
  const auto find = [&](std::int32_t v) { return grid.find_near(v); };
  return merge(used, job, representative, find, [&](std::int32_t v) { grid.insert(v); });
}

std::int64_t merge_rounded(Span<const Vec3> points, Span<const std::uint8_t> used, double rounding, Job &job,
                           Array<std::int32_t> &representative) {
  constexpr double cell = 64;                // so that most points are farther than that from other cells
  constexpr std::size_t most_looked_at = 8;  // for each point
  PointGrid grid(points, {Vec3(0), cell * rounding}, rounding, job);
  bool are_crowded = false;
  const auto find = [&](std::int32_t v) {
    if (grid.looked_at() > most_looked_at * (std::size_t(v) + 1024)) are_crowded = true;
    return are_crowded ? v : grid.find_near(v);
  };
  const std::int64_t merged = merge(used, job, representative, find, [&](std::int32_t v) { grid.insert(v); });
  return are_crowded ? -1 : merged;
}

}  // namespace tetlod
