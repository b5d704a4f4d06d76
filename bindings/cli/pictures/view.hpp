// From where a mesh is looked at: an orthographic projection into a rectangle of pixels.
#pragma once

#include <vector>

#include "shape.hpp"

namespace cli {

struct View {
  Vector right{1, 0, 0}, up{0, 1, 0}, toward{0, 0, 1};  // unit vectors of the screen
  double centre_x = 0, centre_y = 0;                    // of what is seen, along right and up
  double pixels = 1;                                    // a unit of length
  int width = 0, height = 0;

  // Pixels from the top left corner; the third is nearer the larger it is, in units of length.
  Vector project(const Vector &p) const {
    return {0.5 * width + pixels * (dot(p, right) - centre_x), 0.5 * height - pixels * (dot(p, up) - centre_y),
            dot(p, toward)};
  }
};

// Along an axis, with the longer of the other two to the right.
View view_along(int axis, const Vector &extent);
// From above a corner: the longest extent mostly to the right. `corner` is one of 8.
View view_from_corner(int corner, const Vector &extent);
// Fits the points into the rectangle, with a margin.
void fit(View &view, const std::vector<Vector> &points, int width, int height);
// The corner from which the most of the field's variation is seen on the surface.
View best_view(const Shape &surface, int width, int height);

}  // namespace cli
