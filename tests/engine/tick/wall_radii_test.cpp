#include "engine/tick/wall_radii.hpp"

#include "engine/clay/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace clay {
namespace {

/// A wall whose radii differ from ring to ring, from `outer_mm` upward.
ClayStack leaning_wall(double outer_mm, std::size_t count) {
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < count; ++i) {
    const double lean = 1e-3 * static_cast<double>(i);
    rings.push_back({quanta_from_radius(outer_mm + lean), quanta_from_radius(0.9 * outer_mm)});
  }
  return ClayStack::from_rings(0.75, rings, 0, count).value();
}

/// All rings of a wall, with packs of four if the machine has them, or of two.
void expect_radii(double outer_mm, std::size_t count, bool four) {
  const TwoLanesScope lanes(!four);
  const ClayStack stack = leaning_wall(outer_mm, count);
  const auto rings = stack.rings();
  WallRadii walls;
  walls.reserve(Tool::build(SphereSpec{10.0}).value(), stack);
  walls.begin(0);
  walls.cover(stack, 0, count);
  for (std::size_t i = 0; i < count; ++i) {
    const double outer = rings[i].outer_mm(), inner = rings[i].inner_mm();
    EXPECT_NEAR(walls.outer(0)[i], outer, 1e-7 * outer) << "ring " << i;
    EXPECT_NEAR(walls.inner(0)[i], inner, 1e-7 * outer) << "ring " << i;
    EXPECT_EQ(walls.thickness(0)[i], walls.outer(0)[i] - walls.inner(0)[i]) << "ring " << i;
  }
  for (const float* row : {walls.outer(0), walls.inner(0), walls.thickness(0)}) {
    EXPECT_EQ(row[-1], row[0]);
    EXPECT_EQ(row[count], row[count - 1]);
  }
}

TEST(WallRadii, AreThoseOfTheRings) {
  // Squares of 2^52 quanta and more are converted in another way: from 256 mm.
  for (const double outer_mm : {0.01, 50.0, 255.99, 256.0, 300.0, 4999.0})
    for (const std::size_t count : {1u, 2u, 7u, 8u, 9u, 40u})
      for (const bool four : {false, true}) {
        SCOPED_TRACE(testing::Message() << outer_mm << " mm, " << count << " rings");
        expect_radii(outer_mm, count, four);
      }
}

TEST(WallRadii, LaidClayThickensTheWallAndLeavesItsBore) {
  const ClayStack stack = leaning_wall(50.0, 9);
  WallRadii walls;
  walls.reserve(Tool::build(SphereSpec{10.0}).value(), stack);
  walls.begin(0);
  walls.cover(stack, 0, 9);
  const float outer = *walls.outer(4), inner = *walls.inner(4), wall = *walls.thickness(4);
  walls.thicken(4, 0.5, 0.25);
  EXPECT_EQ(*walls.outer(4), outer + 0.5f);
  EXPECT_EQ(*walls.inner(4), inner);
  EXPECT_EQ(*walls.thickness(4), wall + 0.75f);
}

}  // namespace
}  // namespace clay
