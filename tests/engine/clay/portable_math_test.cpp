#include "engine/clay/portable_math.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clay {
namespace {

TEST(PortableMath, AgreesWithLibmInLongDouble) {
  for (double x = 1e-18; x < 50.0; x *= 1.37) {
    const auto expected = static_cast<double>(-std::expm1(-static_cast<long double>(x)));
    EXPECT_NEAR(one_minus_exp_neg(x) / expected, 1.0, 8e-16) << x;
  }
}

TEST(PortableMath, DefinesTheLimits) {
  EXPECT_EQ(one_minus_exp_neg(0.0), 0.0);
  EXPECT_EQ(one_minus_exp_neg(-0.0), 0.0);
  EXPECT_EQ(one_minus_exp_neg(std::numeric_limits<double>::denorm_min()),
            std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(one_minus_exp_neg(1e300), 1.0);
  EXPECT_EQ(one_minus_exp_neg(std::numeric_limits<double>::infinity()), 1.0);
}

TEST(PortableMath, ExpNegMatchesTheExponential) {
  for (double x = 0.0; x < 60.0; x += 0.0137) EXPECT_NEAR(exp_neg(x), std::exp(-x), 1e-11) << x;
  EXPECT_EQ(exp_neg(0.0), 1.0);
  EXPECT_EQ(exp_neg(1e12), 0.0);
}

}  // namespace
}  // namespace clay
