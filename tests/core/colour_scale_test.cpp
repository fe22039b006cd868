#include "core/colour_scale.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace clay {
namespace {

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
