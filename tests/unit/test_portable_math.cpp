// Powers and angles by basic operations against the system's.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "portable_math.hpp"

namespace tetlod {
namespace {

constexpr double few_units = 8 * std::numeric_limits<double>::epsilon();

TEST(PortableMath, Powers) {
  EXPECT_EQ(power(3, 0), 1);
  EXPECT_EQ(power(-2, 5), -32);
}

TEST(PortableMath, RootsOfPowersOfWholeNumbers) {
  for (int n : {2, 3, 5})
    for (double x : {1.0, 2.0, 3.0, 7.0, 10.0}) EXPECT_NEAR(root(power(x, n), n), x, few_units * x) << n;
  EXPECT_EQ(root(0, 3), 0);
  EXPECT_EQ(root(std::ldexp(1.0, -1000), 5), std::ldexp(1.0, -200));
}

TEST(PortableMath, RootsOfAnyMagnitude) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-1070, 1023);
  for (int i = 0; i < 10000; i++) {
    const double x = std::exp2(exponent(random));
    for (int n : {3, 5}) {
      const double expected = std::pow(x, 1.0 / n);
      ASSERT_NEAR(root(x, n), expected, 100 * few_units * expected)
          << x;  // pow has the error of 1/n, times the exponent
    }
  }
}

TEST(PortableMath, Angles) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 10000; i++) {
    const double y = any(random), x = any(random) * (i % 2 ? 1 : 1e-6);
    ASSERT_NEAR(angle_of(y, x), std::atan2(y, x), 2 * few_units) << y << " " << x;
  }
  for (double y : {0.0, 1.0, -1.0})
    for (double x : {0.0, 1.0, -1.0}) EXPECT_NEAR(angle_of(y, x), std::atan2(y, x), few_units) << y << " " << x;
}

}  // namespace
}  // namespace tetlod
