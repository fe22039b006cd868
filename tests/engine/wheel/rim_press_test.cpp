// A tool that comes down on the rim (`ClaySpec::rim_sinks`).

#include "app/bench/hands/dice.hpp"
#include "claystack/engine/wheel.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace clay {
namespace {

constexpr double kOuterMm = 50.0, kHeightMm = 60.0, kToolMm = 10.0;

SceneSpec rim_scene(bool sinks) {
  SceneSpec scene = cylinder_scene({.thin_wall_yields = true, .rim_sinks = sinks});
  scene.removal = {20.0, 2.0, 3.0, {}};
  return scene;
}

/// A ball that comes down at this distance from the axis, as far as 10 mm below the rim, and goes.
Wheel pressed(const SceneSpec& scene, double wall_mm, double distance_mm,
              double ring_height_mm = kH) {
  Wheel wheel = wheel_with(
      scene, kHeightMm, [](double) { return kOuterMm; }, [&](double) { return kOuterMm - wall_mm; },
      ring_height_mm);
  Hand hand(wheel);
  hand.place_at(distance_mm, kHeightMm + kToolMm + 5.0);
  hand.move_to(distance_mm, kHeightMm + kToolMm - 10.0, 10.0);
  hand.move_to(distance_mm, kHeightMm + kToolMm + 5.0, 30.0);
  return wheel;
}

double thickest_mm(const Wheel& wheel) {
  double most = 0.0;
  for (const Ring& ring : wheel.stack().rings()) most = std::max(most, wall_of(ring));
  return most;
}

/// The rim sinks to the pole of the ball, to within the yield depth, and keeps its place. Its clay
/// is in the wall below, and thickens it.
TEST(RimPress, SinksTheRimAndThickensTheWallBelow) {
  for (const double wall_mm : {4.0, 8.0, 12.0}) {
    const double middle = kOuterMm - 0.5 * wall_mm;
    const Wheel wheel = pressed(rim_scene(true), wall_mm, middle);
    EXPECT_GT(wheel.stack().height_mm(), kHeightMm - 10.0) << wall_mm;
    EXPECT_LT(wheel.stack().height_mm(), kHeightMm - 8.0) << wall_mm;
    EXPECT_NEAR(middle_of(wheel.stack().rings().back()), middle, 2.0) << wall_mm;
    EXPECT_GT(wall_of(wheel.stack().rings().back()), wall_mm);
    EXPECT_GT(thickest_mm(wheel), wall_mm + 3.0);
    expect_balanced(wheel);
  }
}

/// Without the option the ball pushes the wall aside: the rim leaves its place, and one side of it
/// stays as a thin collar.
TEST(RimPress, WithoutTheOptionTheRimGoesAside) {
  const Wheel aside = pressed(rim_scene(false), 12.0, 44.0);
  EXPECT_GT(aside.stack().height_mm(), kHeightMm - 2.0);
  EXPECT_GT(std::abs(middle_of(aside.stack().rings().back()) - 44.0), 8.0);
}

/// For any place of the ball, over the wall and beside it, the rim rises by less than 0.6 mm; far
/// beside it the rim keeps its height. Without the option it rises by up to 12 mm.
TEST(RimPress, NoRimRises) {
  double highest = 0.0;
  for (double d = 30.0; d <= 61.0; d += 0.5) {
    highest = std::max(highest, pressed(rim_scene(true), 12.0, d).stack().height_mm());
    if (d <= 31.0 || d >= 60.0) {
      EXPECT_NEAR(pressed(rim_scene(true), 12.0, d).stack().height_mm(), kHeightMm, 0.5) << d;
    }
  }
  EXPECT_LT(highest, kHeightMm + 0.6);
  EXPECT_GT(pressed(rim_scene(false), 12.0, 46.0).stack().height_mm(), kHeightMm + 10.0);
}

/// A solid lump: a ball near the axis opens it. Beyond the middle radius a ball makes it lower and
/// wider; without the option it pushed the clay outside aside, which became a pillar.
TEST(RimPress, OpensALumpOrFlattensIt) {
  EXPECT_NEAR(pressed(rim_scene(true), kOuterMm, 0.0).stack().height_mm(), kHeightMm, 0.3);
  for (const double d : {26.0, 30.0, 35.0, 40.0, 45.0, 49.0}) {
    const Wheel wheel = pressed(rim_scene(true), kOuterMm, d);
    EXPECT_GT(wheel.stack().height_mm(), kHeightMm - 10.0) << d;
    EXPECT_LT(wheel.stack().height_mm(), kHeightMm - 8.0) << d;
    EXPECT_GT(wheel.stack().rings().back().outer_mm(), kOuterMm + 2.0) << d;
    expect_balanced(wheel);
  }
  EXPECT_GT(pressed(rim_scene(false), kOuterMm, 26.0).stack().height_mm(), kHeightMm + 30.0);
}

/// A hand that no force stops goes 50 mm down into a lump at 60 mm/s.
TEST(RimPress, AFastPlungeMakesNoPillar) {
  const auto plunged = [](bool sinks) {
    Wheel wheel = wheel_with(
        rim_scene(sinks), kHeightMm, [](double) { return kOuterMm; }, [](double) { return 0.0; });
    Hand hand(wheel);
    hand.place_at(30.0, 71.0);
    hand.move_to(26.0, 22.0, 60.0);
    expect_balanced(wheel);
    return wheel.stack().height_mm();
  };
  EXPECT_LT(plunged(true), kHeightMm + 1.0);
  EXPECT_GT(plunged(false), kHeightMm + 30.0);
}

/// The rings that are left keep their radii, so the trimmed clay is that of the rings above.
TEST(RimPress, ACutterFromAboveLowersTheRim) {
  SceneSpec scene = rim_scene(true);
  scene.tool.mode = ToolMode::trim;
  const Wheel wheel = pressed(scene, 12.0, 44.0);
  const double height = wheel.stack().height_mm();
  EXPECT_GT(height, kHeightMm - 10.0);
  EXPECT_LT(height, kHeightMm - 8.0);
  for (const Ring& ring : wheel.stack().rings()) EXPECT_NEAR(wall_of(ring), 12.0, 1e-9);
  const Quanta area = wheel.stack().rings().front().volume();
  EXPECT_NEAR(static_cast<double>(wheel.ledger().trimmed) / static_cast<double>(area),
              (kHeightMm - height) / kH, 1e-6);
  expect_balanced(wheel);
  for (double d = 30.0; d <= 60.0; d += 1.0)
    EXPECT_LT(pressed(scene, 12.0, d).stack().height_mm(), kHeightMm + 1e-9) << d;
  scene.clay->rim_sinks = false;
  EXPECT_NEAR(wall_of(pressed(scene, 12.0, 44.0).stack().rings().back()), 3.0, 0.1);
}

/// A press on the wall from outside and a pinch: as without the option, to the byte.
TEST(RimPress, LeavesOtherStrokesAlone) {
  const auto rings_of = [](bool sinks, auto&& stroke) {
    Wheel wheel = wheel_with(
        rim_scene(sinks), kHeightMm, [](double) { return kOuterMm; }, [](double) { return 42.0; });
    Hand hand(wheel);
    stroke(hand);
    const auto rings = wheel.stack().rings();
    return std::vector<Ring>(rings.begin(), rings.end());
  };
  const auto from_outside = [](Hand& hand) {
    hand.place_at(62.0, 30.0);
    hand.move_to(57.0, 30.0, 5.0);
    hand.move_to(57.0, 45.0, 10.0);
  };
  EXPECT_EQ(rings_of(true, from_outside), rings_of(false, from_outside));
  const auto pull = [](Hand& hand) {
    hand.place_at(46.0, 10.0, 6.0);
    hand.move_to(46.0, 70.0, 20.0, 6.0);
  };
  EXPECT_EQ(rings_of(true, pull), rings_of(false, pull));
}

/// To first order the height of the rings does not matter.
TEST(RimPress, IsTheSameInRingsOfAnyHeight) {
  const auto high = [](double ring_height_mm) {
    return pressed(rim_scene(true), 8.0, 46.0, ring_height_mm).stack().height_mm();
  };
  const double fine = high(0.1);
  EXPECT_NEAR(high(0.4), fine, 0.6);
  EXPECT_NEAR(high(0.2), fine, 0.3);
}

/// Tools and cutters that leap about on pots of one to four rings: the lowest ring stays, no clay
/// is owed, and every quantum is counted.
TEST(RimPress, KeepsTheLowestRing) {
  bench::Dice dice(3);
  for (int pot = 0; pot < 1000; ++pot) {
    SceneSpec scene = rim_scene(true);
    scene.tool.mode = pot % 4 == 0 ? ToolMode::press : ToolMode::trim;
    scene.removal = {pot % 3 == 0 ? 2000.0 : 20.0, 0.5, pot % 5 == 0 ? 3.0 : 1.0, {}};
    const double ring_mm = pot % 7 == 0 ? 5.0 : 1.0, high_mm = ring_mm * (1 + pot % 4);
    Wheel wheel = wheel_with(
        scene, high_mm, [](double) { return kOuterMm; },
        [&](double) { return pot % 3 == 0 ? 0.0 : 42.0; }, ring_mm);
    double x = dice.between(30.0, 62.0), y = high_mm + dice.between(2.0, 12.0);
    const int tick_us = pot % 2 == 0 ? 20'000 : 1000;
    for (int k = 1; k < 200; ++k) {
      x += dice.between(-1.0, 1.0);
      y += dice.between(-2.0, 1.5);
      wheel.step({tick_us * k, {x, y, 0.0}, false, 0.0});
      ASSERT_GE(wheel.stack().crown(), 0) << pot << ' ' << k;
      ASSERT_GE(wheel.stack().size(), 1u);
      expect_balanced(wheel);
    }
  }
}

}  // namespace
}  // namespace clay
