// How numbers are told: the same whatever the host's locale is.
#include <gtest/gtest.h>

#include <limits>

#include "status.hpp"

namespace tetlod {
namespace {

TEST(Numbers, ReadBackAsTheSame) {
  EXPECT_EQ(number(0.1), "0.1");
  EXPECT_EQ(number(-1e300), "-1e+300");
  EXPECT_EQ(number(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(number(-std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(Numbers, AboutHasTwoDigits) {
  EXPECT_EQ(about(0.01712), "0.017");
  EXPECT_EQ(about(0.02), "0.02");
  EXPECT_EQ(about(3), "3");
  EXPECT_EQ(about(1234.5), "1.2e+03");
  EXPECT_EQ(about(1e-9), "1e-09");
}

}  // namespace
}  // namespace tetlod
