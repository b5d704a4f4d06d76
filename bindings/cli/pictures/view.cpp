#include "view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "raster.hpp"

namespace cli {
namespace {

constexpr int kCorners = 8;
constexpr double kTurn = 0.55, kTilt = 0.45;  // radians
constexpr double kMargin = 0.04;              // of the rectangle, at each side

Vector axis_vector(std::size_t axis, double length) {
  Vector v{};
  v[axis] = length;
  return v;
}

// The axes by their extents, longest first.
std::array<std::size_t, 3> by_length(const Vector &extent) {
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return extent[a] > extent[b]; });
  return order;
}

Vector extent_of(const std::vector<Vector> &points) {
  Vector low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Vector &p : points) {
    for (std::size_t k = 0; k < 3; k++) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
  return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

// How much the values differ over the pixels that show them, times the share of pixels that do.
double sight_worth(const Shape &surface, View view, int width, int height) {
  fit(view, surface.points, width, height);
  Raster raster(width, height, 1);
  raster.draw_triangles(surface, view);
  double count = 0, sum = 0, squares = 0;
  for (const Raster::Sample &sample : raster.samples()) {
    if (!sample.covered() || !std::isfinite(sample.value)) continue;
    count++, sum += sample.value, squares += sample.value * sample.value;
  }
  if (count == 0) return 0;
  return std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count))) * std::sqrt(count);
}

}  // namespace

View view_along(int axis, const Vector &extent) {
  std::size_t a = (std::size_t(axis) + 1) % 3, b = (std::size_t(axis) + 2) % 3;
  if (extent[b] > extent[a]) std::swap(a, b);
  View view;
  view.right = axis_vector(a, 1);
  view.up = axis_vector(b, 1);
  view.toward = cross(view.right, view.up);
  return view;
}

View view_from_corner(int corner, const Vector &extent) {
  const auto order = by_length(extent);
  const double turn = corner & 1 ? kTurn : -kTurn, tilt = corner & 2 ? kTilt : -kTilt;
  const Vector x = axis_vector(order[0], corner & 4 ? -1 : 1), y = axis_vector(order[1], 1), z = cross(x, y);
  View view;
  for (std::size_t k = 0; k < 3; k++) {
    view.right[k] = std::cos(turn) * x[k] - std::sin(turn) * z[k];
    const double deep = std::sin(turn) * x[k] + std::cos(turn) * z[k];
    view.up[k] = std::cos(tilt) * y[k] - std::sin(tilt) * deep;
    view.toward[k] = std::sin(tilt) * y[k] + std::cos(tilt) * deep;
  }
  return view;
}

void fit(View &view, const std::vector<Vector> &points, int width, int height) {
  double left = std::numeric_limits<double>::infinity(), low = left, right = -left, high = -left;
  for (const Vector &p : points) {
    const double x = dot(p, view.right), y = dot(p, view.up);
    left = std::min(left, x), right = std::max(right, x), low = std::min(low, y), high = std::max(high, y);
  }
  view.width = width;
  view.height = height;
  if (points.empty()) return;
  view.centre_x = 0.5 * (left + right);
  view.centre_y = 0.5 * (low + high);
  const double least = std::numeric_limits<double>::min();
  view.pixels =
      (1 - 2 * kMargin) * std::min(width / std::max(right - left, least), height / std::max(high - low, least));
}

View best_view(const Shape &surface, int width, int height) {
  const Vector extent = extent_of(surface.points);
  View best = view_from_corner(0, extent);
  double most = -1;
  for (int corner = 0; corner < kCorners; corner++) {
    const View view = view_from_corner(corner, extent);
    const double worth = sight_worth(surface, view, width / 4, height / 4);
    if (worth > most) most = worth, best = view;
  }
  fit(best, surface.points, width, height);
  return best;
}

}  // namespace cli
