// A rim that is narrower than the wall that a tool presses (`ClaySpec::narrow_rim_closes`).

#include "claystack/engine/wheel.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace clay {
namespace {

constexpr double kPotRadiusMm = 40.0, kPotMm = 100.0, kThinMm = 3.0, kFingertipMm = 10.0;

SceneSpec closing_scene(bool closes) {
  SceneSpec scene =
      cylinder_scene({.thin_wall_yields = true, .rim_sinks = true, .narrow_rim_closes = closes});
  scene.removal = {20.0, 2.0, kThinMm, {}};
  scene.lump.max_rings = 5000;
  return scene;
}

/// A ball that moves from outside to the axis, with its middle so far above the rim.
Wheel swept_over(const SceneSpec& scene, double above_mm, double mm_s, double ring_height_mm = kH) {
  Wheel wheel = wheel_with(
      scene, kPotMm, [](double) { return kPotRadiusMm; },
      [](double) { return kPotRadiusMm - kThinMm; }, ring_height_mm);
  Hand hand(wheel);
  hand.place_at(kPotRadiusMm + kFingertipMm + 1.0, kPotMm + above_mm);
  hand.move_to(0.0, kPotMm + above_mm, mm_s);
  hand.move_to(0.0, kPotMm + 200.0, 200.0);
  return wheel;
}

/// The pot does not become a pipe.
TEST(NarrowRim, ClosesUnderAToolThatSweepsOverIt) {
  double highest_without = 0.0;
  for (const double mm_s : {15.0, 60.0})
    for (const double above_mm : {3.0, 4.0, 5.0, 6.0, 7.0}) {
      const Wheel wheel = swept_over(closing_scene(true), above_mm, mm_s);
      EXPECT_LT(wheel.stack().height_mm(), kPotMm + 50.0) << above_mm << ' ' << mm_s;
      expect_balanced(wheel);
      for (const Ring& ring : wheel.stack().rings()) EXPECT_GT(wall_of(ring), kThinMm - 1e-5);
      highest_without = std::max(
          highest_without, swept_over(closing_scene(false), above_mm, mm_s).stack().height_mm());
    }
  EXPECT_GT(highest_without, kPotMm + 100.0);
}

/// Neighbours of the new rings touch: half of the thickness of a rim stays on the rim below.
TEST(NarrowRim, LeansAwayFromATool) {
  Wheel wheel = wheel_with(
      closing_scene(true), kPotMm, [](double) { return kPotRadiusMm; },
      [](double) { return kPotRadiusMm - kThinMm; });
  const std::size_t before = wheel.stack().size();
  Hand hand(wheel);
  hand.place_at(kPotRadiusMm + kFingertipMm + 1.0, kPotMm + 4.0);
  hand.move_to(kPotRadiusMm - 10.0, kPotMm + 4.0, 15.0);
  const auto rings = wheel.stack().rings();
  ASSERT_GT(rings.size(), before + 5);
  // No new ring is in the ball.
  for (std::size_t i = before; i < rings.size(); ++i) {
    const double t = (static_cast<double>(i) + 0.5) * kH - kPotMm - 4.0;
    const double clear =
        kPotRadiusMm - 10.0 - std::sqrt(std::max(kFingertipMm * kFingertipMm - t * t, 0.0));
    EXPECT_LT(rings[i].outer_mm(), clear + 0.05) << i;
    EXPECT_TRUE(rings[i].touches(rings[i - 1]));
    EXPECT_GT(wall_of(rings[i]), kThinMm - 1e-5);
  }
}

/// What a ring gains in height by half of its hoop strain. R^2 + r^2 is twice the square of a
/// radius between r and R.
double gain_of(const Ring& before, const Ring& after) {
  const auto radius = [](const Ring& ring) {
    return std::sqrt(0.5 * kMm2PerQuantum * static_cast<double>(ring.outer2 + ring.inner2));
  };
  return kH * 0.5 * std::log(radius(before) / radius(after));
}

/// A wide wall below a narrow neck, pressed in. The wall is at its minimum, so all of it bends. The
/// rim rises by what the rings gain; without the option by more, since a ring of the neck holds
/// less than half of the clay of a ring of the wall.
TEST(NarrowRim, RisesByWhatTheWallGains) {
  const auto outer = [](double up) {
    return up < 60.0 ? 50.0 : std::max(20.0, 50.0 - (up - 60.0));
  };
  const auto raised = [&](bool closes) {
    Wheel wheel = wheel_with(closing_scene(closes), kPotMm, outer,
                             [&](double up) { return outer(up) - kThinMm; });
    const std::vector<Ring> before(wheel.stack().rings().begin(), wheel.stack().rings().end());
    Hand hand(wheel);
    hand.place_at(50.0 + kFingertipMm + 1.0, 30.0);
    hand.move_to(50.0 + kFingertipMm - 4.0, 30.0, 10.0);
    double gain = 0.0;
    for (std::size_t i = 0; i < 300; ++i) gain += gain_of(before[i], wheel.stack().rings()[i]);
    expect_balanced(wheel);
    return (wheel.stack().height_mm() - kPotMm) / gain;
  };
  EXPECT_NEAR(raised(true), 1.0, 0.02);
  EXPECT_GT(raised(false), 2.0);
}

/// Where every ring holds as much clay as the rim, the option changes only rounding.
TEST(NarrowRim, LeavesAWallAsWideAsItsRimAlone) {
  const auto pressed = [](bool closes) {
    Wheel wheel = wheel_with(
        closing_scene(closes), kPotMm, [](double) { return kPotRadiusMm; },
        [](double) { return kPotRadiusMm - kThinMm; });
    Hand hand(wheel);
    hand.place_at(kPotRadiusMm + kFingertipMm + 1.0, 50.0);
    hand.move_to(kPotRadiusMm + kFingertipMm - 3.0, 50.0, 10.0);
    const auto rings = wheel.stack().rings();
    return std::vector<Ring>(rings.begin(), rings.end());
  };
  const auto with = pressed(true), without = pressed(false);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_NEAR(with[i].outer_mm(), without[i].outer_mm(), 1e-4);
    EXPECT_NEAR(with[i].inner_mm(), without[i].inner_mm(), 1e-4);
  }
}

/// Mean difference of the height from that with rings of half the height.
TEST(NarrowRim, DependsLittleOnTheRingHeight) {
  const double coarse = swept_over(closing_scene(true), 5.0, 30.0, 0.4).stack().height_mm();
  const double fine = swept_over(closing_scene(true), 5.0, 30.0, 0.2).stack().height_mm();
  EXPECT_NEAR(coarse, fine, 2.0);
}

}  // namespace
}  // namespace clay
