// A wall that one tool pushes (`ClaySpec::pushed_wall_bends`), and the slope of heaved clay
// (`ClaySpec::heave_slope`).

#include "claystack/engine/wheel.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr double kTubeRadiusMm = 42.0, kTubeWallMm = 5.0, kTubeMm = 150.0, kBallMm = 10.0;

SceneSpec collar_scene(bool bends) {
  SceneSpec scene = cylinder_scene({.thin_wall_yields = true,
                                    .rim_sinks = true,
                                    .narrow_rim_closes = true,
                                    .pushed_wall_bends = bends});
  scene.removal = {20.0, 2.0, 2.0, {}};
  scene.lump.max_rings = 5000;
  return scene;
}

struct Collared {
  double thinnest_mm = 1e9;  ///< between heights of 40 and 120 mm
  double rim_mm = 0.0;       ///< outer radius of the widest ring above the collar
  double height_mm = 0.0;
};

/// A ball in the middle of a cylinder goes `deep_mm` in from outside, and up to `to_mm`.
Collared collared(const SceneSpec& scene, double deep_mm, double mm_s, double ring_mm = kH,
                  double to_mm = 110.0) {
  Wheel wheel = wheel_with(
      scene, kTubeMm, [](double) { return kTubeRadiusMm; },
      [](double) { return kTubeRadiusMm - kTubeWallMm; }, ring_mm);
  Hand hand(wheel);
  const double out = kTubeRadiusMm + kBallMm + 2.0, in = kTubeRadiusMm + kBallMm - deep_mm;
  hand.place_at(out, 60.0);
  hand.move_to(in, 60.0, 20.0);
  hand.move_to(in, to_mm, mm_s);
  hand.move_to(out + 60.0, to_mm, 60.0);
  expect_balanced(wheel);
  Collared result;
  result.height_mm = wheel.stack().height_mm();
  const double least = scene.removal.min_wall_mm - 1e-5;
  const auto rings = wheel.stack().rings();
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double up = (static_cast<double>(i) + 0.5) * ring_mm;
    EXPECT_GT(wall_of(rings[i]), least) << up;
    if (up > 40.0 && up < 120.0)
      result.thinnest_mm = std::min(result.thinnest_mm, wall_of(rings[i]));
    if (up > 130.0) result.rim_mm = std::max(result.rim_mm, rings[i].outer_mm());
  }
  return result;
}

/// Pushed in, a wall of constant volume is at least as thick as before.
TEST(PushedWall, KeepsItsThickness) {
  for (const double mm_s : {10.0, 30.0, 60.0}) {
    const Collared bends = collared(collar_scene(true), 12.0, mm_s);
    const Collared thins = collared(collar_scene(false), 12.0, mm_s);
    EXPECT_GT(bends.thinnest_mm, 0.9 * kTubeWallMm) << mm_s;
    EXPECT_LT(thins.thinnest_mm, bends.thinnest_mm - 0.5) << mm_s;
    EXPECT_LT(bends.rim_mm, kTubeRadiusMm + 1.0) << mm_s;
  }
}

/// Rings of 0.1 and 0.2 mm.
TEST(PushedWall, DependsLittleOnTheRingHeight) {
  const Collared coarse = collared(collar_scene(true), 12.0, 30.0, 0.2);
  const Collared fine = collared(collar_scene(true), 12.0, 30.0, 0.1);
  EXPECT_NEAR(coarse.thinnest_mm, fine.thinnest_mm, 0.15);
  EXPECT_NEAR(coarse.height_mm, fine.height_mm, 1.0);
}

/// A solid lump does not bend.
TEST(PushedWall, DoesNotConcernALump) {
  const auto pressed = [](bool bends) {
    SceneSpec scene = collar_scene(bends);
    Wheel wheel = wheel_with(
        scene, 60.0, [](double) { return 48.0; }, [](double) { return 0.0; });
    Hand hand(wheel);
    hand.place_at(60.0, 30.0);
    hand.move_to(46.0, 30.0, 20.0);
    hand.move_to(46.0, 50.0, 20.0);
    return wheel.pot();
  };
  EXPECT_TRUE(pressed(true).stack == pressed(false).stack);
}

/// A lump that is opened by one stroke: with a low slope it hardly becomes wider at the rim, and
/// higher instead.
TEST(HeaveSlope, LimitsTheFlareOfAnOpenedLump) {
  const auto opened = [](std::optional<double> slope) {
    SceneSpec scene = cylinder_scene(
        {.floor_mm = 5.0, .finger_mm = 90.0, .finger_behind = 0.5, .heave_slope = slope});
    scene.removal = {20.0, 2.0, 2.0, {}};
    Wheel wheel = wheel_with(
        scene, 50.0, [](double) { return 42.0; }, [](double) { return 0.0; });
    Hand hand(wheel);
    hand.place_at(0.0, 62.0);
    hand.move_to(0.0, 15.0, 20.0);
    hand.move_to(17.0, 15.0, 15.0);
    hand.move_to(17.0, 70.0, 20.0);
    expect_balanced(wheel);
    return wheel.pot();
  };
  const Pot steep = opened({}), gentle = opened(0.2), same = opened(0.5);
  const auto rim_mm = [](const Pot& pot) { return pot.stack.rings().back().outer_mm(); };
  EXPECT_TRUE(steep.stack == same.stack) << "0.5 is the default";
  EXPECT_LT(rim_mm(gentle), rim_mm(steep) - 2.0);
  EXPECT_GT(gentle.stack.height_mm(), steep.stack.height_mm() + 2.0);
}

}  // namespace
}  // namespace clay
