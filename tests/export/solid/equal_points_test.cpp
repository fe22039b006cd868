#include "export/solid/equal_points.hpp"

#include <gtest/gtest.h>
#include <cstdint>
#include <vector>

namespace clay::solid {
namespace {

TEST(EqualPoints, GivesTheFirstPointOfEachPlace) {
  const EqualPoints equal =
      equal_points({{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {3, 2, 1}, {0, 0, -0.0}, {1, 2, 3}});
  EXPECT_EQ(equal.first, (std::vector<std::uint32_t>{0, 1, 0, 3, 1, 0}));
  EXPECT_EQ(equal.repeated, 3u);
}

TEST(EqualPoints, ComparesByFloat32) {
  const double next = 1.0 + 0x1p-23, between = 1.0 + 0x1p-30;
  const EqualPoints equal = equal_points({{1, 0, 0}, {next, 0, 0}, {between, 0, 0}});
  EXPECT_EQ(equal.first, (std::vector<std::uint32_t>{0, 1, 0}));
  EXPECT_EQ(equal_points({}).repeated, 0u);
}

}  // namespace
}  // namespace clay::solid
