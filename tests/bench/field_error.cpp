#include "field_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace bench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-6;  // a barycentric weight this far below zero still counts as inside
constexpr std::size_t kLeafTets = 8;

struct Box {
  Point low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};

  void add(const Point &p) {
    for (std::size_t a = 0; a < 3; a++) {
      low[a] = std::min(low[a], p[a]);
      high[a] = std::max(high[a], p[a]);
    }
  }
  bool holds(const Point &p, double slack) const {
    for (std::size_t a = 0; a < 3; a++) {
      if (p[a] < low[a] - slack || p[a] > high[a] + slack) return false;
    }
    return true;
  }
  std::size_t longest_axis() const {
    std::size_t longest = 0;
    for (std::size_t a = 1; a < 3; a++) {
      if (high[a] - low[a] > high[longest] - low[longest]) longest = a;
    }
    return longest;
  }
};

Point minus(const Point &a, const Point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double triple(const Point &a, const Point &b, const Point &c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Point centroid(const Mesh &mesh, const Tet &tet) {
  Point sum{};
  for (const std::int32_t corner : tet) {
    for (std::size_t a = 0; a < 3; a++) sum[a] += 0.25 * mesh.points[std::size_t(corner)][a];
  }
  return sum;
}

// Relative to the tet's own determinant, so that a tet that is inside out still holds its points; nothing for a flat
// one.
std::optional<std::array<double, 4>> barycentric(const Mesh &mesh, const Tet &tet, const Point &p) {
  const Point &origin = mesh.points[std::size_t(tet[0])];
  const Point u = minus(mesh.points[std::size_t(tet[1])], origin);
  const Point v = minus(mesh.points[std::size_t(tet[2])], origin);
  const Point w = minus(mesh.points[std::size_t(tet[3])], origin);
  const Point x = minus(p, origin);
  const double whole = triple(u, v, w);
  if (whole == 0) return std::nullopt;
  const double b = triple(x, v, w) / whole, c = triple(u, x, w) / whole, d = triple(u, v, x) / whole;
  return std::array<double, 4>{1 - b - c - d, b, c, d};
}

// Tets in the order of a balanced tree over the boxes of its halves.
class Finder {
 public:
  explicit Finder(const Mesh &mesh) : mesh_(mesh), order_(mesh.tets.size()), centroids_(mesh.tets.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    for (std::size_t t = 0; t < order_.size(); t++) centroids_[t] = centroid(mesh, mesh.tets[t]);
    if (!order_.empty()) divide(0, order_.size());
    if (nodes_.empty()) return;
    const Box &all = nodes_.front().box;
    slack_ = 1e-9 * std::hypot(all.high[0] - all.low[0], all.high[1] - all.low[1], all.high[2] - all.low[2]);
  }

  // The value in the tet that holds p best; nothing outside.
  std::optional<double> value_at(const Point &p) const {
    Best best;
    if (!nodes_.empty()) search(0, p, best);
    if (best.least < -kRounding) return std::nullopt;
    return best.value;
  }

 private:
  struct Node {
    Box box;
    std::size_t begin, end;
    std::size_t right;  // 0: a leaf; the left half is the next node
  };
  struct Best {
    double least = -kInfinity, value = 0;
  };

  Box box_of(std::size_t begin, std::size_t end) const {
    Box box;
    for (std::size_t i = begin; i < end; i++) {
      for (const std::int32_t corner : mesh_.tets[order_[i]]) box.add(mesh_.points[std::size_t(corner)]);
    }
    return box;
  }

  std::size_t halve(std::size_t begin, std::size_t end, std::size_t axis) {
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [this, axis](std::size_t s, std::size_t t) { return centroids_[s][axis] < centroids_[t][axis]; });
    return middle;
  }

  void divide(std::size_t begin, std::size_t end) {
    const std::size_t self = nodes_.size();
    const Box box = box_of(begin, end);
    nodes_.push_back({box, begin, end, 0});
    if (end - begin <= kLeafTets) return;
    const std::size_t middle = halve(begin, end, box.longest_axis());
    divide(begin, middle);
    nodes_[self].right = nodes_.size();
    divide(middle, end);
  }

  void try_tet(const Tet &tet, const Point &p, Best &best) const {
    const auto weights = barycentric(mesh_, tet, p);
    if (!weights) return;
    const double least = *std::min_element(weights->begin(), weights->end());
    if (least <= best.least) return;
    best = {least, 0};
    for (std::size_t k = 0; k < 4; k++) best.value += (*weights)[k] * mesh_.values[std::size_t(tet[k])];
  }

  void search(std::size_t at, const Point &p, Best &best) const {
    const Node &node = nodes_[at];
    if (best.least >= 0 || !node.box.holds(p, slack_)) return;
    if (node.right != 0) {
      search(at + 1, p, best);
      search(node.right, p, best);
      return;
    }
    for (std::size_t i = node.begin; i < node.end; i++) try_tet(mesh_.tets[order_[i]], p, best);
  }

  const Mesh &mesh_;
  std::vector<std::size_t> order_;
  std::vector<Point> centroids_;
  std::vector<Node> nodes_;
  double slack_ = 0;
};

struct Sum {
  double squares = 0, most = 0;
  std::size_t taken = 0, outside = 0;

  void add(double is, std::optional<double> found) {
    if (!found) {
      outside++;
      return;
    }
    const double error = std::fabs(*found - is);
    squares += error * error;
    most = std::max(most, error);
    taken++;
  }
  double rms() const { return taken > 0 ? std::sqrt(squares / double(taken)) : 0; }
  double share_outside() const { return outside > 0 ? double(outside) / double(taken + outside) : 0; }
};

double mean_value(const Mesh &mesh, const Tet &tet) {
  double sum = 0;
  for (const std::int32_t corner : tet) sum += 0.25 * mesh.values[std::size_t(corner)];
  return sum;
}

}  // namespace

FieldError measure_field_error(const Mesh &original, const Mesh &result) {
  const Finder finder(result);
  const double range = range_of(original.values);
  Sum vertices, inner;
  for (std::size_t i = 0; i < original.points.size(); i++) {
    vertices.add(original.values[i], finder.value_at(original.points[i]));
  }
  for (const Tet &tet : original.tets) {
    inner.add(mean_value(original, tet), finder.value_at(centroid(original, tet)));
  }
  return {vertices.rms() / range, vertices.most / range, vertices.share_outside(),
          inner.rms() / range,    inner.most / range,    inner.share_outside()};
}

}  // namespace bench
