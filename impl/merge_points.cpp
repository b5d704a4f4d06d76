#include "merge_points.hpp"

#include <cstring>

#include "geometry.hpp"

namespace tetlod {

namespace {

/// A hash table of points by the cell of a grid that they lie in.
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

/// Of the cells that points are looked up by: so large that most are farther than the tolerance from other cells, but
/// not so small that coordinates have none.
double size_of_cells(Span<const Vec3> points, Span<const std::uint8_t> used, double tolerance) {
  constexpr double tolerances = 8, finest = 1e-10;
  double largest = 0;
  for (std::size_t v = 0; v < points.size(); v++)
    for (int k = 0; k < 3 && used[v]; k++) largest = std::max(largest, std::abs(points[v][k]));
  const double size = std::max(tolerances * tolerance, finest * largest);
  return size > 0 ? size : 1;
}

std::int32_t find_near(const PointTable &table, Span<const Vec3> points, std::int32_t v, double tolerance,
                       double size) {
  std::int32_t found = v;
  const Vec3 &p = points[std::size_t(v)];
  const Vec3 low = glm::floor((p - tolerance) / size), high = glm::floor((p + tolerance) / size);
  for (double x = low.x; x <= high.x; x++)
    for (double y = low.y; y <= high.y; y++)
      for (double z = low.z; z <= high.z; z++)
        table.for_each(Vec3(x, y, z), [&](std::int32_t other) {
          if (other < found && length2(points[std::size_t(other)] - p) <= tolerance * tolerance) found = other;
        });
  return found;
}

}  // namespace

std::int64_t merge_points(Span<const Vec3> points, Span<const std::uint8_t> used, double tolerance, Job &job,
                          Array<std::int32_t> &representative) {
  PointTable table(points.size(), job);
  const double size = size_of_cells(points, used, tolerance);
  representative.resize(points.size());
  std::int64_t merged = 0;
  for (std::size_t i = 0; i < points.size(); i++) {
    const auto v = std::int32_t(i);
    if (i % 4096 == 0) job.poll(double(i) / double(points.size()));
    representative[i] = v;
    if (!used[i]) continue;
    const std::int32_t found = find_near(table, points, v, tolerance, size);
    representative[i] = found;
    merged += found != v;
    if (found == v) table.insert(glm::floor(points[i] / size), v);
  }
  return merged;
}

}  // namespace tetlod
