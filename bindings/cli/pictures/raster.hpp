// Draws shapes into a rectangle of pixels, without a screen or a graphics driver: what is nearest is seen.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "image.hpp"
#include "shape.hpp"
#include "view.hpp"

namespace cli {

class Raster {
 public:
  struct Sample {
    double value = 0;
    float light = 1, ink = 0;
    float depth = -std::numeric_limits<float>::infinity();  // larger is nearer
    bool covered() const { return depth > -std::numeric_limits<float>::infinity(); }
  };

  // So many samples a pixel in each direction.
  Raster(int width, int height, int samples);

  // Values vary linearly in a triangle. Where it is lit, what faces the viewer is lightest.
  void draw_triangles(const Shape &shape, const View &view, bool lit = true);
  // The shape's edges, where nothing is nearer. They fade where they would hide what is between them.
  void draw_edges(const Shape &shape, const View &view);

  const std::vector<Sample> &samples() const { return samples_; }
  std::vector<Sample> &samples() { return samples_; }

  // The colour of a sample's value, its light and ink over it.
  using Paint = std::function<Colour(const Sample &)>;
  Image image(const Paint &paint) const;

 private:
  Sample &at(int x, int y) { return samples_[std::size_t(y) * std::size_t(columns_) + std::size_t(x)]; }
  void draw_triangle(const Vector corner[3], const double value[3], float light);
  void draw_line(const Vector &from, const Vector &to, float ink, float tolerance);
  Vector to_samples(const Vector &pixel) const { return {per_pixel_ * pixel[0], per_pixel_ * pixel[1], pixel[2]}; }

  int width_, height_, per_pixel_, columns_, rows_;
  std::vector<Sample> samples_;
};

}  // namespace cli
