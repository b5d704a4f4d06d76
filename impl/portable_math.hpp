// Functions that have the same bits on every processor: by basic operations and square roots, which are rounded
// exactly. A system's pow() and atan2() may go another way where the processor has other instructions.
#pragma once
#include <algorithm>
#include <cmath>

namespace tetlod {

inline double power(double x, int n) {
  double product = 1;
  for (int i = 0; i < n; i++) product *= x;
  return product;
}

/// x^(1/n) of x > 0, else 0.
inline double root(double x, int n) {
  if (!(x > 0)) return 0;
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const int whole = exponent >= 0 ? exponent / n : -((n - 1 - exponent) / n);
  const double rest = std::ldexp(fraction, exponent - n * whole);  // of x, over 2^(n whole)
  double y = 1 + (rest - 1) / n;                                   // Newton's steps go down from there
  for (double next = y;; y = next) {
    next = y - (y - rest / power(y, n - 1)) / n;
    if (!(next < y)) return std::ldexp(y, whole);
  }
}

/// atan2(y, x), of finite numbers.
inline double angle_of(double y, double x) {
  constexpr double pi = 3.141592653589793;
  const double low = std::min(std::abs(x), std::abs(y)), high = std::max(std::abs(x), std::abs(y));
  double tangent = high > 0 ? low / high : 0;
  for (int half = 0; half < 2; half++) tangent /= 1 + std::sqrt(1 + tangent * tangent);
  double series = 0;  // of a quarter of the angle
  for (int k = 23; k > 0; k -= 2) series = 1.0 / k - tangent * tangent * series;
  double angle = 4 * tangent * series;
  if (std::abs(y) > std::abs(x)) angle = pi / 2 - angle;
  if (x < 0) angle = pi - angle;
  return std::copysign(angle, y);
}

}  // namespace tetlod
