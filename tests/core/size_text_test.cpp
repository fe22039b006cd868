#include "core/size_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace clay {
namespace {

TEST(SizeText, ASmallSizeKeepsTwoDigits) {
  EXPECT_EQ(size_text(12.345, 1), "12.3");
  EXPECT_EQ(size_text(1.0, 1), "1.0");
  EXPECT_EQ(size_text(0.0123, 1), "0.012");
  EXPECT_EQ(size_text(-0.00034, 3), "-0.00034");
  EXPECT_EQ(size_text(0.0, 1), "0.0");
  EXPECT_EQ(size_text(1e308, 0).size(), 309u);
}

TEST(BoundText, IsRoundedDown) {
  EXPECT_EQ(bound_text(4.5379, 3), "4.537");
  EXPECT_EQ(bound_text(0.000349, 3), "0.00034");
  EXPECT_EQ(bound_text(0.0, 3), "0.000");
  EXPECT_EQ(bound_text(std::numeric_limits<double>::infinity(), 3), "inf");
  for (int i = 1; i < 5000; ++i) {
    const double bound = std::pow(1.01, i % 700) * 1e-6 * i;
    EXPECT_LE(std::stod(bound_text(bound, 3)), bound * (1.0 + 1e-12)) << bound;
  }
}

/// As decimals are in general not doubles, 4.535 * 1000 is 4534.9999.
TEST(BoundText, KeepsABoundOfAsManyDecimals) {
  for (int i = 10; i < 9000; ++i) {
    const double bound = i / 1000.0;
    EXPECT_EQ(bound_text(bound, 3), size_text(bound, 3)) << i;
  }
}

TEST(DecimalsApart, AreAsManyAsTwoFiguresNeedToDiffer) {
  EXPECT_EQ(decimals_apart(3.302, 3.3, 3), 3);
  EXPECT_EQ(decimals_apart(3.30002, 3.3, 3), 5);
  EXPECT_EQ(decimals_apart(3.3, 3.30002, 3), 5);
  EXPECT_EQ(decimals_apart(3.3, 3.3, 3), 9);
}

}  // namespace
}  // namespace clay
