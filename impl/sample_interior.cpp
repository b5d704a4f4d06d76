#include "sample_interior.hpp"

#include <algorithm>
#include <cmath>

#include "part_in_order.hpp"

namespace tetlod {

namespace {

/// A run of the vertices, [begin, end).
struct Cell {
  std::size_t begin, end;
  int depth;
};

/// Cells of that depth are halved: cuts between extremes may separate one vertex at a time, as where oscillations grow.
constexpr int deepest = 64;

/// Of several fields, each counts as mesh.scales.weighted says.
template <std::size_t m>
class SamplingTree {
 public:
  SamplingTree(const MeshView &mesh, Span<std::int32_t> vertices, double variation, Job &job)
      : mesh_(mesh),
        values_(mesh.values<m>()),
        vertices_(vertices),
        variation_(variation),
        job_(job),
        others_(&job.memory) {}

  /// Depth first, so that the leaves come in the order of the vertices' runs.
  void sample(Array<std::int32_t> &samples) {
    Array<Cell> stack(&job_.memory);
    if (!vertices_.empty()) stack.push_back({0, vertices_.size(), 0});
    while (!stack.empty()) {
      const Cell cell = stack.back();
      stack.pop_back();
      job_.poll(double(cell.begin) / double(vertices_.size()));
      const Extremes extremes = extremes_of(cell);
      if (extremes.variation <= variation_) {
        samples.push_back(nearest_to_mean(cell));
        continue;
      }
      const std::size_t middle = split(cell, extremes);
      if (middle == cell.begin) {  // coincident points: nothing separates them
        samples.push_back(nearest_to_mean(cell));
        continue;
      }
      stack.push_back({middle, cell.end, cell.depth + 1});
      stack.push_back({cell.begin, middle, cell.depth + 1});
    }
  }

 private:
  struct Extremes {
    Vec3 at_least, at_most;  // the paper's x_min and x_max
    double variation;
  };

  const Vec3 &point(std::int32_t v) const { return mesh_.points[std::size_t(v)]; }
  const Values<m> &values(std::int32_t v) const { return values_[std::size_t(v)]; }
  double scaled(std::size_t k, double of_field) const { return mesh_.scales.weighted[k] * of_field; }

  /// Of the field that varies most.
  Extremes extremes_of(const Cell &cell) const {
    std::array<std::int32_t, m> least, most;
    least.fill(vertices_[cell.begin]);
    most = least;
    for (std::size_t i = cell.begin + 1; i < cell.end; i++)
      for (std::size_t k = 0; k < m; k++) {
        const std::int32_t v = vertices_[i];
        if (values(v)[k] < values(least[k])[k]) least[k] = v;
        if (values(v)[k] > values(most[k])[k]) most[k] = v;
      }
    Extremes extremes{point(least[0]), point(most[0]), values(most[0])[0] - values(least[0])[0]};
    for (std::size_t k = 1; k < m; k++) {
      const double variation = scaled(k, values(most[k])[k] - values(least[k])[k]);
      if (variation > extremes.variation) extremes = {point(least[k]), point(most[k]), variation};
    }
    return extremes;
  }

  /// Cuts at the middle of g = x_max - x_min on the axis where g is longest. Returns where the second half begins;
  /// cell.begin when the points cannot be separated.
  std::size_t split(const Cell &cell, const Extremes &extremes) {
    const Vec3 g = extremes.at_most - extremes.at_least;
    int axis = 0;
    for (int k = 1; k < 3; k++)
      if (std::abs(g[k]) > std::abs(g[axis])) axis = k;
    const double cut = extremes.at_least[axis] + 0.5 * g[axis];
    if (cell.depth < deepest) {
      const std::size_t middle = part(cell, [&](std::int32_t v) { return point(v)[axis] < cut; });
      if (middle != cell.begin && middle != cell.end) return middle;
    }
    return split_at_median(cell);
  }

  /// For cells that the cut does not separate (x_min and x_max rounded to one side, or at one place), or not evenly.
  std::size_t split_at_median(const Cell &cell) {
    Box box;
    for (std::size_t i = cell.begin; i < cell.end; i++) box.add(point(vertices_[i]));
    const int axis = box.longest_axis();
    if (!(box.high[axis] > box.low[axis])) return cell.begin;
    const auto less = [&](std::int32_t a, std::int32_t b) {
      return point(a)[axis] != point(b)[axis] ? point(a)[axis] < point(b)[axis] : a < b;
    };
    others_.assign(vertices_.begin() + cell.begin, vertices_.begin() + cell.end);
    const auto middle = others_.begin() + std::ptrdiff_t(others_.size() / 2);
    std::nth_element(others_.begin(), middle, others_.end(), less);
    return part(cell, [&, median = *middle](std::int32_t v) { return less(v, median); });
  }

  template <class Is>
  std::size_t part(const Cell &cell, const Is &is_first) {
    return cell.begin + part_in_order({vertices_.data() + cell.begin, cell.end - cell.begin}, others_, is_first);
  }

  std::int32_t nearest_to_mean(const Cell &cell) const {
    Values<m> mean{};
    for (std::size_t i = cell.begin; i < cell.end; i++)
      for (std::size_t k = 0; k < m; k++) mean[k] += values(vertices_[i])[k];
    for (double &of_field : mean) of_field /= double(cell.end - cell.begin);
    std::int32_t best = vertices_[cell.begin];
    for (std::size_t i = cell.begin + 1; i < cell.end; i++) {
      const std::int32_t v = vertices_[i];
      const double d = distance(values(v), mean), best_d = distance(values(best), mean);
      if (d < best_d || (d == best_d && v < best)) best = v;
    }
    return best;
  }

  double distance(const Values<m> &a, const Values<m> &b) const {
    double largest = std::abs(a[0] - b[0]);
    for (std::size_t k = 1; k < m; k++) largest = std::max(largest, scaled(k, std::abs(a[k] - b[k])));
    return largest;
  }

  const MeshView &mesh_;
  Span<const Values<m>> values_;
  Span<std::int32_t> vertices_;
  double variation_;
  Job &job_;
  Array<std::int32_t> others_;
};

}  // namespace

void sample_interior(const MeshView &mesh, Span<std::int32_t> vertices, double variation, Job &job,
                     Array<std::int32_t> &samples) {
  with_fields(mesh.fields, [&](auto m) { SamplingTree<m>(mesh, vertices, variation, job).sample(samples); });
}

void add_flagged(Span<const std::uint8_t> flags, Span<const std::int32_t> vertices, Array<std::int32_t> &samples) {
  Array<std::uint8_t> wanted(flags.begin(), flags.end(), samples.get_allocator());
  for (std::int32_t v : samples) wanted[std::size_t(v)] = 0;
  const std::size_t sampled = samples.size();
  for (std::int32_t v : vertices)
    if (wanted[std::size_t(v)]) samples.push_back(v);
  std::sort(samples.begin() + std::ptrdiff_t(sampled), samples.end());
}

}  // namespace tetlod
