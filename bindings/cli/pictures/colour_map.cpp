#include "colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cli {
namespace {

// Lightness grows evenly from one anchor to the next.
constexpr Colour kField[] = {{0.27, 0.00, 0.33}, {0.28, 0.17, 0.48}, {0.23, 0.32, 0.55},
                             {0.17, 0.45, 0.56}, {0.13, 0.57, 0.55}, {0.16, 0.69, 0.50},
                             {0.37, 0.79, 0.38}, {0.67, 0.86, 0.19}, {0.99, 0.91, 0.14}};
constexpr Colour kError[] = {{0.97, 0.97, 0.95}, {0.99, 0.87, 0.62}, {0.98, 0.68, 0.36}, {0.90, 0.44, 0.25},
                             {0.70, 0.22, 0.28}, {0.42, 0.09, 0.31}, {0.13, 0.04, 0.18}};

template <std::size_t n>
Colour between(const Colour (&anchors)[n], double share) {
  if (std::isnan(share)) return no_colour();
  const double at = std::clamp(share, 0.0, 1.0) * double(n - 1);
  const auto below = std::min(static_cast<std::size_t>(at), n - 2);
  return mixed(anchors[below], anchors[below + 1], at - double(below));
}

}  // namespace

Colour field_colour(double share) { return between(kField, share); }
Colour error_colour(double share) { return between(kError, share); }
Colour no_colour() { return {0.45, 0.66, 0.92}; }

}  // namespace cli
