// Solid clay that one tool presses from the side (`ClaySpec::pressed_lump_stretches`).

#include "claystack/engine/wheel.hpp"
#include "engine/tick/lump.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace clay::pressed_lump {
namespace {

constexpr double kLumpRadiusMm = 48.0, kLumpMm = 40.0, kBallMm = 10.0;

SceneSpec lump_scene(bool stretches) {
  SceneSpec scene = cylinder_scene({.finger_mm = 90.0,
                                    .finger_behind = 0.5,
                                    .heave_slope = 0.2,
                                    .thin_wall_yields = true,
                                    .rim_sinks = true,
                                    .narrow_rim_closes = true,
                                    .pushed_wall_bends = true,
                                    .pressed_lump_stretches = stretches});
  scene.removal = {20.0, 2.0, 2.0, {}};
  scene.lump.max_rings = 5000;
  return scene;
}

Wheel lump(const SceneSpec& scene, double ring_mm = kH) {
  return wheel_with(
      scene, kLumpMm, [](double) { return kLumpRadiusMm; }, [](double) { return 0.0; }, ring_mm);
}

/// A ball goes `deep_mm` into the lump at its middle height.
Wheel pressed(bool stretches, double deep_mm, double ring_mm = kH) {
  Wheel wheel = lump(lump_scene(stretches), ring_mm);
  Hand hand(wheel);
  const double out = kLumpRadiusMm + kBallMm + 2.0;
  hand.place_at(out, 0.5 * kLumpMm);
  hand.move_to(out - 2.0 - deep_mm, 0.5 * kLumpMm, 15.0);
  hand.move_to(out + 20.0, 0.5 * kLumpMm, 60.0);
  expect_balanced(wheel);
  return wheel;
}

/// Where the column gives way as easily as clay yields beside the tool, c + R/3 = 2.57 c, one half
/// of the clay stretches it. A narrow column takes nearly all: 1 / (1 + 2.57^-4).
TEST(PressedLump, SharesTheClayByTheLimitLoads) {
  const auto part = [](double radius_mm, double c) {
    const auto stack =
        ClayStack::from_rings(1.0, std::vector<Ring>(10, {quanta_from_radius(radius_mm), 0}), 0, 20)
            .value();
    Band band;
    band.ring = 5;
    return stretched_part(stack, band, c);
  };
  EXPECT_NEAR(part(3.0 * 1.57 * 10.0, 10.0), 0.5, 1e-6);
  EXPECT_NEAR(part(1e-3, 10.0), 0.97757, 1e-4);
  EXPECT_LT(part(48.0, 1.0), 0.01);
}

/// The lump becomes higher and hardly wider. The clay is the same, so each mm of height is a mm of
/// the whole column.
TEST(PressedLump, BecomesAHigherColumn) {
  for (const double deep_mm : {8.0, 14.0, 18.0}) {
    const Wheel stretches = pressed(true, deep_mm), flares = pressed(false, deep_mm);
    EXPECT_GT(stretches.stack().height_mm(), flares.stack().height_mm() + 0.08 * deep_mm);
    const auto rim_mm = [](const Wheel& w) { return w.stack().rings().back().outer_mm(); };
    EXPECT_LT(rim_mm(stretches) - kLumpRadiusMm, 0.7 * (rim_mm(flares) - kLumpRadiusMm)) << deep_mm;
  }
}

TEST(PressedLump, DependsLittleOnTheRingHeight) {
  const Wheel coarse = pressed(true, 14.0, 0.2), fine = pressed(true, 14.0, 0.1);
  EXPECT_NEAR(coarse.stack().height_mm(), fine.stack().height_mm(), 0.5);
  EXPECT_NEAR(coarse.stack().rings().back().outer_mm(), fine.stack().rings().back().outer_mm(),
              0.5);
}

/// A tool that opens a lump, and one that presses a wall, do the same as without the option.
TEST(PressedLump, ConcernsOnlySolidClayPressedFromOutside) {
  const auto opened = [](bool stretches) {
    Wheel wheel = lump(lump_scene(stretches));
    Hand hand(wheel);
    hand.place_at(0.0, 52.0);
    hand.move_to(0.0, 18.0, 20.0);
    hand.move_to(15.0, 20.0, 20.0);
    hand.move_to(15.0, 60.0, 20.0);
    return wheel.pot();
  };
  EXPECT_TRUE(opened(true).stack == opened(false).stack);
  const auto collared = [](bool stretches) {
    Wheel wheel = Wheel::build(lump_scene(stretches)).value();
    Hand hand(wheel);
    hand.place_at(57.0, 60.0);
    hand.move_to(48.0, 60.0, 20.0);
    hand.move_to(48.0, 90.0, 20.0);
    return wheel.pot();
  };
  EXPECT_TRUE(collared(true).stack == collared(false).stack);
}

/// A tool that goes down pushes the clay down: the neck that it leaves does not become a stem.
TEST(PressedLump, MakesNoStemOnTheWayDown) {
  const auto rise_mm = [](bool stretches, double mm) {
    Wheel wheel = lump(lump_scene(stretches));
    Hand hand(wheel);
    const double out = kLumpRadiusMm + kBallMm + 2.0;
    hand.place_at(out, 30.0);
    hand.move_to(out - 22.0, 30.0, 15.0);
    const double before_mm = wheel.stack().height_mm();
    hand.move_to(out - 22.0, 30.0 + mm, 20.0);
    expect_balanced(wheel);
    return wheel.stack().height_mm() - before_mm;
  };
  EXPECT_LT(rise_mm(true, -20.0), rise_mm(false, -20.0) + 2.0);
}

}  // namespace
}  // namespace clay::pressed_lump
