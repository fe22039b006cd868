#include "core/colour_scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clay {
namespace {

/// CIE L* of the D65 white, from the luminance of linear sRGB.
double lightness(std::uint32_t rgb) {
  const auto [red, green, blue] = linear_colour(rgb);
  const double luminance = 0.2126 * double{red} + 0.7152 * double{green} + 0.0722 * double{blue};
  return luminance > 0.008856 ? 116.0 * std::cbrt(luminance) - 16.0 : 903.3 * luminance;
}

/// So that it is readable without hues.
TEST(ColourScale, LightnessRisesEvenly) {
  const double first = lightness(kScaleColours.front()), last = lightness(kScaleColours.back());
  EXPECT_GT(last - first, 70.0);
  const double step = (last - first) / (kScaleColours.size() - 1);
  for (std::size_t i = 1; i < kScaleColours.size(); ++i)
    EXPECT_NEAR(lightness(kScaleColours[i]) - lightness(kScaleColours[i - 1]), step, 0.4 * step)
        << i;
}

TEST(ColourScale, HasNoGrey) {
  for (const std::uint32_t rgb : kScaleColours) {
    const auto [low, high] = std::minmax({rgb >> 16U & 255U, rgb >> 8U & 255U, rgb & 255U});
    EXPECT_GT(high - low, 60U) << std::hex << rgb;
  }
}

TEST(ColourScale, TopCoversFourFifthsOfTheWalls) {
  EXPECT_EQ(scale_top_mm({1, 2, 3, 4, 30}), 5.0);
  EXPECT_EQ(scale_top_mm({1, 2, 3, 30, 30}), 50.0);
  EXPECT_EQ(scale_top_mm({3, std::numeric_limits<float>::infinity()}), 5.0);
}

TEST(ColourScale, ThickerWallsGetTheLastTop) { EXPECT_EQ(scale_top_mm({120, 130}), 100.0); }

TEST(ColourScale, TopWithoutWallsIsTenMillimetres) {
  EXPECT_EQ(scale_top_mm({}), 10.0);
  EXPECT_EQ(scale_top_mm({std::numeric_limits<float>::infinity()}), 10.0);
}

}  // namespace
}  // namespace clay
