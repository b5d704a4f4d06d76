#include "raster.hpp"

#include <algorithm>
#include <cmath>

#include "interrupt.hpp"

namespace cli {
namespace {

constexpr double kShade = 0.42;                  // how much darker what is seen edge-on
constexpr double kMostInk = 0.55;                // of an edge
constexpr double kInkFrom = 2.5, kInkFull = 14;  // mean length of the edges in pixels: none below, all above
const Colour kInk{0.05, 0.05, 0.08}, kPaleInk{0.75, 0.75, 0.8};
constexpr double kDark = 0.2;  // what is darker gets pale ink, and less of it

double lightness(const Colour &c) { return 0.3 * c.red + 0.59 * c.green + 0.11 * c.blue; }

Colour with_ink(const Colour &c, double ink) {
  return lightness(c) < kDark ? mixed(c, kPaleInk, 0.6 * ink) : mixed(c, kInk, ink);
}

float light_of(const Vector &a, const Vector &b, const Vector &c, const Vector &toward) {
  const Vector u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const Vector normal = cross(u, v);
  const double length = std::sqrt(dot(normal, normal));
  const double facing = length > 0 ? std::abs(dot(normal, toward)) / length : 1;
  return static_cast<float>(1 - kShade * (1 - facing));
}

double mean_length(const Shape &shape, const View &view) {
  double sum = 0;
  for (const auto &edge : shape.edges) {
    const Vector p = view.project(shape.points[std::size_t(edge[0])]),
                 q = view.project(shape.points[std::size_t(edge[1])]);
    sum += std::hypot(p[0] - q[0], p[1] - q[1]);
  }
  return shape.edges.empty() ? 0 : sum / double(shape.edges.size());
}

}  // namespace

Raster::Raster(int width, int height, int samples)
    : width_(width),
      height_(height),
      per_pixel_(samples),
      columns_(width * samples),
      rows_(height * samples),
      samples_(std::size_t(columns_) * std::size_t(rows_)) {}

void Raster::draw_triangle(const Vector corner[3], const double value[3], float light) {
  const Vector &a = corner[0], &b = corner[1], &c = corner[2];
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (area == 0 || !std::isfinite(area)) return;
  const auto [left, right] = std::minmax({a[0], b[0], c[0]});
  const auto [top, bottom] = std::minmax({a[1], b[1], c[1]});
  const int x_from = std::max(0, int(std::ceil(left - 0.5))),
            x_to = std::min(columns_ - 1, int(std::floor(right - 0.5)));
  const int y_from = std::max(0, int(std::ceil(top - 0.5))), y_to = std::min(rows_ - 1, int(std::floor(bottom - 0.5)));
  for (int y = y_from; y <= y_to; y++) {
    for (int x = x_from; x <= x_to; x++) {
      const double px = x + 0.5, py = y + 0.5;
      const double wa = ((b[0] - px) * (c[1] - py) - (b[1] - py) * (c[0] - px)) / area;
      const double wb = ((c[0] - px) * (a[1] - py) - (c[1] - py) * (a[0] - px)) / area, wc = 1 - wa - wb;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const float depth = static_cast<float>(wa * a[2] + wb * b[2] + wc * c[2]);
      Sample &sample = at(x, y);
      if (depth <= sample.depth) continue;
      sample = {wa * value[0] + wb * value[1] + wc * value[2], light, 0, depth};
    }
  }
}

void Raster::draw_triangles(const Shape &shape, const View &view, bool lit) {
  for (const auto &triangle : shape.triangles) {
    stop_if_interrupted();
    Vector corner[3], projected[3];
    double value[3];
    for (std::size_t k = 0; k < 3; k++) {
      corner[k] = shape.points[std::size_t(triangle[k])];
      projected[k] = to_samples(view.project(corner[k]));
      value[k] = shape.values[std::size_t(triangle[k])];
    }
    draw_triangle(projected, value, lit ? light_of(corner[0], corner[1], corner[2], view.toward) : 1.0F);
  }
}

// A sample wide at least, across the direction that it runs along.
void Raster::draw_line(const Vector &from, const Vector &to, float ink, float tolerance) {
  const double dx = to[0] - from[0], dy = to[1] - from[1];
  const bool flat = std::abs(dx) >= std::abs(dy);
  const int steps = std::max(1, int(std::ceil(std::max(std::abs(dx), std::abs(dy)))));
  const int wide = std::max(1, per_pixel_ / 2);
  for (int i = 0; i <= steps; i++) {
    const double t = double(i) / steps;
    const float depth = static_cast<float>(from[2] + t * (to[2] - from[2])) + tolerance;
    for (int k = 0; k < wide; k++) {
      const int x = int(std::floor(from[0] + t * dx)) + (flat ? 0 : k),
                y = int(std::floor(from[1] + t * dy)) + (flat ? k : 0);
      if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
      Sample &sample = at(x, y);
      if (sample.covered() && depth >= sample.depth) sample.ink = std::max(sample.ink, ink);
    }
  }
}

void Raster::draw_edges(const Shape &shape, const View &view) {
  const double share = (mean_length(shape, view) - kInkFrom) / (kInkFull - kInkFrom);
  const auto ink = static_cast<float>(kMostInk * std::clamp(share, 0.0, 1.0));
  if (ink <= 0) return;
  const auto tolerance = static_cast<float>(2.0 / view.pixels);  // two pixels deep
  for (const auto &edge : shape.edges)
    draw_line(to_samples(view.project(shape.points[std::size_t(edge[0])])),
              to_samples(view.project(shape.points[std::size_t(edge[1])])), ink, tolerance);
}

Image Raster::image(const Paint &paint) const {
  Image image(width_, height_);
  for (int y = 0; y < height_; y++) {
    for (int x = 0; x < width_; x++) {
      double sum[3] = {0, 0, 0};
      int count = 0;
      for (int k = 0; k < per_pixel_ * per_pixel_; k++) {
        const std::size_t row = std::size_t(y * per_pixel_ + k / per_pixel_),
                          column = std::size_t(x * per_pixel_ + k % per_pixel_);
        const Sample &sample = samples_[row * std::size_t(columns_) + column];
        if (!sample.covered()) continue;
        Colour colour = paint(sample);
        const double light = double(sample.light);
        colour = with_ink({light * colour.red, light * colour.green, light * colour.blue}, double(sample.ink));
        sum[0] += colour.red, sum[1] += colour.green, sum[2] += colour.blue, count++;
      }
      if (count > 0)
        blend(image.pixel(x, y), {sum[0] / count, sum[1] / count, sum[2] / count},
              double(count) / (per_pixel_ * per_pixel_));
    }
  }
  return image;
}

}  // namespace cli
