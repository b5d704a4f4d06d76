#include "field_error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "box_tree.hpp"
#include "nearest_triangle.hpp"
#include "vectors.hpp"

namespace bench {
namespace {

constexpr double kRounding = 1e-6;  // a barycentric weight this far below zero still counts as inside

using Weights = std::array<double, 4>;

// Relative to the tet's own determinant, so that a tet that is inside out still holds its points; nothing for a flat
// one.
std::optional<Weights> barycentric(const Mesh &mesh, const Tet &tet, const Point &p) {
  const Point &origin = mesh.points[std::size_t(tet[0])];
  const Point u = minus(mesh.points[std::size_t(tet[1])], origin);
  const Point v = minus(mesh.points[std::size_t(tet[2])], origin);
  const Point w = minus(mesh.points[std::size_t(tet[3])], origin);
  const Point x = minus(p, origin);
  const double whole = triple(u, v, w);
  if (whole == 0) return std::nullopt;
  const double b = triple(x, v, w) / whole, c = triple(u, x, w) / whole, d = triple(u, v, x) / whole;
  return Weights{1 - b - c - d, b, c, d};
}

std::vector<Box> boxes_of_tets(const Mesh &mesh) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.tets.size());
  for (const Tet &tet : mesh.tets) boxes.push_back(box_of(mesh.points, tet));
  return boxes;
}

class Finder {
 public:
  explicit Finder(const Mesh &mesh)
      : mesh_(mesh), tree_(boxes_of_tets(mesh)), slack_(1e-9 * box_of(mesh.points).diagonal()) {}

  // The value in the tet that holds p best; nothing outside.
  std::optional<double> value_at(const Point &p) const {
    Best best;
    if (!tree_.nodes().empty()) search(0, p, best);
    if (best.least < -kRounding) return std::nullopt;
    return best.value;
  }

 private:
  struct Best {
    double least = -Box::kInfinity, value = 0;
  };

  void try_tet(const Tet &tet, const Point &p, Best &best) const {
    const auto weights = barycentric(mesh_, tet, p);
    if (!weights) return;
    const double least = *std::min_element(weights->begin(), weights->end());
    if (least <= best.least) return;
    best = {least, 0};
    for (std::size_t k = 0; k < 4; k++) best.value += (*weights)[k] * mesh_.values[std::size_t(tet[k])];
  }

  void search(std::size_t at, const Point &p, Best &best) const {
    const BoxTree::Node &node = tree_.nodes()[at];
    if (best.least >= 0 || !node.box.holds(p, slack_)) return;
    if (node.right != 0) {
      search(at + 1, p, best);
      search(node.right, p, best);
      return;
    }
    for (std::size_t i = node.begin; i < node.end; i++) try_tet(mesh_.tets[tree_.order()[i]], p, best);
  }

  const Mesh &mesh_;
  BoxTree tree_;
  double slack_;
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

// The n-th number of a sequence, in (0, 1]: the mixing function of Steele, Lea and Flood's splittable generator.
double random_unit(std::uint64_t n) {
  std::uint64_t z = (n + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return double((z >> 11) + 1) / 9007199254740992.0;
}

// Of a point that is spread evenly in a tet: exponential variates over their sum.
Weights random_weights(std::size_t tet) {
  Weights weights{};
  double sum = 0;
  for (std::size_t k = 0; k < 4; k++) sum += weights[k] = -std::log(random_unit(4 * tet + k));
  for (double &weight : weights) weight = sum > 0 ? weight / sum : 0.25;
  return weights;
}

double error_outside(const Mesh &original, std::size_t vertex, const Mesh &result, const NearestTriangle &surface) {
  const NearestPoint at = surface.nearest(original.points[vertex]);
  double value = 0;
  for (std::size_t k = 0; k < 3; k++) value += at.weights[k] * result.values[std::size_t(at.triangle[k])];
  return std::fabs(value - original.values[vertex]);
}

// A point of no tet is no vertex.
std::vector<bool> used_points(const Mesh &mesh) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const Tet &tet : mesh.tets) {
    for (const std::int32_t corner : tet) used[std::size_t(corner)] = true;
  }
  return used;
}

}  // namespace

FieldError measure_field_error(const Mesh &original, const Mesh &result, const std::vector<Triangle> &boundary) {
  const Finder finder(result);
  const NearestTriangle surface(result.points, boundary);
  const double range = range_of(original.values);
  Sum vertices, inner;
  double most_outside = 0;
  const std::vector<bool> used = used_points(original);
  for (std::size_t i = 0; i < original.points.size(); i++) {
    if (!used[i]) continue;
    const std::optional<double> found = finder.value_at(original.points[i]);
    vertices.add(original.values[i], found);
    if (!found) most_outside = std::max(most_outside, error_outside(original, i, result, surface));
  }
  for (std::size_t t = 0; t < original.tets.size(); t++) {
    const Weights weights = random_weights(t);
    Point p{};
    double value = 0;
    for (std::size_t k = 0; k < 4; k++) {
      const auto corner = std::size_t(original.tets[t][k]);
      value += weights[k] * original.values[corner];
      for (std::size_t a = 0; a < 3; a++) p[a] += weights[k] * original.points[corner][a];
    }
    inner.add(value, finder.value_at(p));
  }
  return {vertices.rms() / range,   vertices.most / range,
          vertices.share_outside(), std::max(vertices.most, most_outside) / range,
          inner.rms() / range,      inner.most / range,
          inner.share_outside()};
}

}  // namespace bench
