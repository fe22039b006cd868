// Tools and rings that are far larger than those of a usual scene.

#include "claystack/engine/wheel.hpp"
#include "engine/tick/heave.hpp"
#include "engine/tick/shell.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace clay {
namespace {

/// A wall 15 mm thick and 600 mm high, and a rib of this height in its middle.
SceneSpec tall_wall(double rib_mm) {
  SceneSpec scene;
  scene.lump = {.rings = 800,
                .ring_height_mm = 0.75,
                .outer_radius_mm = 60.0,
                .inner_radius_mm = 45.0,
                .max_rings = 1600};
  scene.tool.shape = RibSpec{rib_mm, 6.0};
  scene.clay = ClaySpec{};
  return scene;
}

/// A rib that rises gives most at its upper end: the wall bends over half of the rib's height more.
TEST(LargeParts, ATallRibMovesTheWallAroundItAlone) {
  for (const double rib_mm : {80.0, 100.0, 150.0, 300.0}) {
    SCOPED_TRACE(rib_mm);
    Wheel wheel = Wheel::build(tall_wall(rib_mm)).value();
    const Ring untouched = wheel.stack().rings()[0];
    const double from_mm = 370.0, to_mm = 440.0;
    Hand hand(wheel);
    hand.place_at(66.5, from_mm);
    hand.move_to(59.5, to_mm, 50.0);
    expect_balanced(wheel);
    EXPECT_LT(ring_at(wheel, to_mm).outer_mm(), 58.0);
    // Heaved clay goes farthest: twice `kLongestShellMm` from the contact.
    const double beyond_mm = from_mm - 0.5 * rib_mm - 2.0 * kLongestShellMm - 1.0;
    for (double up = 0.5; up < beyond_mm; up += 0.75) {
      ASSERT_EQ(ring_at(wheel, up), untouched) << up << " mm";
    }
  }
}

/// No wall below shows the thickness to which a rim tapers.
TEST(LargeParts, ASingleRingGrowsByACopyOfItself) {
  SceneSpec scene;
  scene.lump = {.rings = 1,
                .ring_height_mm = 50.0,
                .outer_radius_mm = 45.0,
                .inner_radius_mm = 30.0,
                .max_rings = 8};
  scene.tool = {RibSpec{60.0, 5.0}, ToolMode::pinch, 5.0};
  scene.clay = ClaySpec{};
  Wheel wheel = Wheel::build(scene).value();
  for (int k = 1; k < 4000 && wheel.stack().size() == 1; ++k)
    wheel.step({k * 1000, {37.5, 25.0, 0.0}});
  ASSERT_EQ(wheel.stack().size(), 2u);
  EXPECT_EQ(wheel.stack().rings()[1], wheel.stack().rings()[0]);
  expect_balanced(wheel);
}

/// The rules reach no farther than `kLongestShellMm`, even if that is less than a ring.
TEST(LargeParts, ClayHeavesUpByLessThanATallRing) {
  SceneSpec scene;
  scene.lump = {
      .rings = 4, .ring_height_mm = 50.0, .outer_radius_mm = 45.0, .inner_radius_mm = 0.0};
  scene.clay = ClaySpec{};
  Wheel wheel = Wheel::build(scene).value();
  Hand hand(wheel);
  hand.place_at(55.0, 75.0);
  hand.move_to(51.0, 75.0, 20.0);
  expect_balanced(wheel);
  const Tool tool = Tool::build(SphereSpec{10.0}).value();
  const Band band{.low_mm = 65.0, .high_mm = 85.0, .peak_mm = 75.0, .ring = 1};
  EXPECT_EQ(heave_reach(tool, wheel.stack(), band), kLongestShellMm);
}

}  // namespace
}  // namespace clay
