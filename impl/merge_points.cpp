#include "merge_points.hpp"

#include <cstring>

#include "geometry.hpp"

namespace tetlod {

namespace {

/// A hash table of points by a key of three numbers: their coordinates, or the cell of a grid that they lie in.
class PointTable {
 public:
  PointTable(std::size_t points, Job &job) : first_(&job.memory), next_(&job.memory) {
    std::size_t size = 16;
    while (size < 2 * points) size *= 2;
    first_.assign(size, -1);
    next_.assign(points, -1);
  }

  void insert(const Vec3 &key, std::int32_t v) {
    std::int32_t &head = first_[slot(key)];
    next_[std::size_t(v)] = head;
    head = v;
  }

  template <class Visit>
  void for_each(const Vec3 &key, const Visit &visit) const {
    for (std::int32_t v = first_[slot(key)]; v >= 0; v = next_[std::size_t(v)]) visit(v);
  }

 private:
  std::size_t slot(const Vec3 &key) const {
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; k++) {
      const double positive_zero = key[k] + 0.0;
      std::uint64_t bits;
      std::memcpy(&bits, &positive_zero, sizeof bits);
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return std::size_t(hash) & (first_.size() - 1);
  }

  Array<std::int32_t> first_, next_;
};

std::int32_t find_equal(const PointTable &table, Span<const Vec3> points, std::int32_t v) {
  std::int32_t found = v;
  const Vec3 &p = points[std::size_t(v)];
  table.for_each(p, [&](std::int32_t other) {
    if (points[std::size_t(other)] == p) found = other;
  });
  return found;
}

double largest_coordinate(Span<const Vec3> points, Span<const std::uint8_t> used, Job &job) {
  double largest = 0;
  for (std::size_t v = 0; v < points.size(); v++) {
    job.poll_at(v, 0);
    for (int k = 0; k < 3 && used[v]; k++) largest = std::max(largest, std::abs(points[v][k]));
  }
  return largest;
}

/// looked_at: how many others were.
std::int32_t find_near(const PointTable &table, Span<const Vec3> points, std::int32_t v, double tolerance, double size,
                       std::size_t &looked_at) {
  std::int32_t found = v;
  const Vec3 &p = points[std::size_t(v)];
  const Vec3 low = glm::floor((p - tolerance) / size), high = glm::floor((p + tolerance) / size);
  for (double x = low.x; x <= high.x; x++)
    for (double y = low.y; y <= high.y; y++)
      for (double z = low.z; z <= high.z; z++)
        table.for_each(Vec3(x, y, z), [&](std::int32_t other) {
          looked_at++;
          if (other < found && length2(points[std::size_t(other)] - p) <= tolerance * tolerance) found = other;
        });
  return found;
}

/// find(v): the lowest point that v is merged into; key(v): in the table.
template <class Find, class Key>
std::int64_t merge(PointTable &table, Span<const std::uint8_t> used, Job &job, Array<std::int32_t> &representative,
                   const Find &find, const Key &key) {
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
    if (found == v) table.insert(key(v), v);
  }
  return merged;
}

}  // namespace

std::int64_t merge_points(Span<const Vec3> points, Span<const std::uint8_t> used, double tolerance, Job &job,
                          Array<std::int32_t> &representative) {
  constexpr double finest = 1e-12;  // of the largest coordinate: others have no cell
  PointTable table(points.size(), job);
  const auto point = [&](std::int32_t v) { return points[std::size_t(v)]; };
  if (!(tolerance > 0))
    return merge(
        table, used, job, representative, [&](std::int32_t v) { return find_equal(table, points, v); }, point);
  const double size = std::max(tolerance, finest * largest_coordinate(points, used, job));
  std::size_t looked_at = 0;
  const auto find = [&](std::int32_t v) { return find_near(table, points, v, tolerance, size, looked_at); };
  return merge(table, used, job, representative, find, [&](std::int32_t v) { return glm::floor(point(v) / size); });
}

std::int64_t merge_rounded(Span<const Vec3> points, Span<const std::uint8_t> used, double rounding, Job &job,
                           Array<std::int32_t> &representative) {
  constexpr double cell = 64;                // so that most points are farther than that from other cells
  constexpr std::size_t most_looked_at = 8;  // for each point
  PointTable table(points.size(), job);
  std::size_t looked_at = 0;
  bool are_crowded = false;
  const double size = cell * rounding;
  const auto find = [&](std::int32_t v) {
    if (looked_at > most_looked_at * (std::size_t(v) + 1024)) are_crowded = true;
    return are_crowded ? v : find_near(table, points, v, rounding, size, looked_at);
  };
  const auto cell_of = [&](std::int32_t v) { return glm::floor(points[std::size_t(v)] / size); };
  const std::int64_t merged = merge(table, used, job, representative, find, cell_of);
  return are_crowded ? -1 : merged;
}

}  // namespace tetlod
