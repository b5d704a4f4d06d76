#include "remesh_frame.hpp"

#include <algorithm>
#include <cmath>

#include "geometry.hpp"

namespace tetlod {

namespace {

int magnitude_of(const Box &box) { return std::ilogb(box.largest_coordinate()) + 1; }

/// What [low, high] can be shifted by without rounding.
double exact_shift(double low, double high) {
  if (low > 0 && high <= 2 * low) return low;
  if (high < 0 && low >= 2 * high) return high;
  return 0;
}

/// Less underflows in TetGen's exact arithmetic, of the fifth power, and it loops; beside the box it is nothing.
double without_underflow(double x) { return std::abs(x) < 1e-40 ? 0 : x; }

}  // namespace

Vec3 Frame::unit(const Vec3 &p) const { return times_power_of_two(p, -magnitude); }

Vec3 Frame::into(const Vec3 &p) const {
  const Vec3 q = unit(p) - shift;
  const Vec3 zoomed{std::ldexp(q.x, -zoom[0]), std::ldexp(q.y, -zoom[1]), std::ldexp(q.z, -zoom[2])};
  return {without_underflow(zoomed.x), without_underflow(zoomed.y), without_underflow(zoomed.z)};
}

Vec3 Frame::back(const Vec3 &q) const {
  const Vec3 p = Vec3{std::ldexp(q.x, zoom[0]), std::ldexp(q.y, zoom[1]), std::ldexp(q.z, zoom[2])} + shift;
  return times_power_of_two(p, magnitude);
}

Frame stretched_frame(const Box &box) {
  Frame frame;
  frame.magnitude = magnitude_of(box);
  const Vec3 low = frame.unit(box.low), high = frame.unit(box.high);
  for (int k = 0; k < 3; k++) {
    frame.shift[k] = exact_shift(low[k], high[k]);
    frame.zoom[std::size_t(k)] = std::ilogb(high[k] - low[k]);
  }
  return frame;
}

Frame uniform_frame(const Box &box) {
  Frame frame = stretched_frame(box);
  frame.zoom.fill(*std::max_element(frame.zoom.begin(), frame.zoom.end()));
  return frame;
}

}  // namespace tetlod
