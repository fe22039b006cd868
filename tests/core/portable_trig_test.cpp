#include "core/portable_trig.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace clay {
namespace {

/// Distance of a double from the true value, in ulp.
long double ulps(double found, long double expected) {
  const double size = std::abs(found);
  const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return std::abs(expected - static_cast<long double>(found)) / static_cast<long double>(ulp);
}

// A long double has 11 more bits, so the nearest double is within 0.5 + 2^-11 ulp of it.
constexpr long double kNearest = 0.5L + 0x1p-11L;

TEST(PortableTrig, ReturnsTheNearestDouble) {
  std::mt19937_64 random(7);
  for (const double limit : {1e-7, 1e-3, 3.5, 50.0, kMostRad}) {
    std::uniform_real_distribution<double> angles(-limit, limit);
    for (int k = 0; k < 20'000; ++k) {
      const double angle = angles(random), other = angles(random);
      const auto [cosine, sine] = cos_sin(angle);
      ASSERT_LE(ulps(cosine, std::cos(static_cast<long double>(angle))), kNearest) << angle;
      ASSERT_LE(ulps(sine, std::sin(static_cast<long double>(angle))), kNearest) << angle;
      const auto x = static_cast<long double>(angle), y = static_cast<long double>(other);
      ASSERT_LE(ulps(length_of(angle, other), std::sqrt(x * x + y * y)), kNearest) << angle;
    }
  }
}

TEST(PortableTrig, IsAccurateNearMultiplesOfAQuarterTurn) {
  for (int k = -1000; k <= 1000; ++k) {
    const double angle = k * (0.5 * std::numbers::pi);
    const auto [cosine, sine] = cos_sin(angle);
    EXPECT_LE(ulps(cosine, std::cos(static_cast<long double>(angle))), kNearest) << k;
    EXPECT_LE(ulps(sine, std::sin(static_cast<long double>(angle))), kNearest) << k;
  }
}

TEST(PortableTrig, DefinesTheLimits) {
  EXPECT_EQ(cos_sin(0.0).cosine, 1.0);
  EXPECT_EQ(cos_sin(0.0).sine, 0.0);
  EXPECT_TRUE(std::signbit(cos_sin(-0.0).sine));
  EXPECT_EQ(cos_sin(5e-324).sine, 5e-324);
  EXPECT_TRUE(std::isnan(cos_sin(std::nan("")).cosine));
  EXPECT_TRUE(std::isnan(cos_sin(1.01 * kMostRad).sine));
  EXPECT_EQ(length_of(0.0, -0.0), 0.0);
  EXPECT_EQ(length_of(-3.0 * 0x1p-1000, 4.0 * 0x1p-1000), 5.0 * 0x1p-1000);
  EXPECT_EQ(length_of(3.0 * 0x1p1000, 4.0 * 0x1p1000), 5.0 * 0x1p1000);
  EXPECT_EQ(length_of(5e-324, 0.0), 5e-324);
}

}  // namespace
}  // namespace clay
