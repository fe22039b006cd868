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

/// Walls of a pot that narrows, a bottle, a cylinder and a bowl.
constexpr int kCylinder = 2, kBowl = 3;
double outer_of(int pot, double up) {
  return pot == 0           ? std::max(14.0, 45.0 - 0.4 * std::max(up - 20.0, 0.0))
         : pot == 1         ? (up < 60.0 ? 50.0 : std::max(20.0, 50.0 - (up - 60.0)))
         : pot == kCylinder ? kPotRadiusMm
                            : 50.0 + 0.4 * up;
}

/// Height of the pot after a ball has moved inward with its middle so far above the rim, to the
/// axis or to a distance.
double height_swept(const SceneSpec& scene, int pot, double wall_mm, double above_mm, double mm_s,
                    double to_mm = 0.0, double ring_height_mm = kH) {
  Wheel wheel = wheel_with(
      scene, kPotMm, [=](double up) { return outer_of(pot, up); },
      [=](double up) { return outer_of(pot, up) - wall_mm; }, ring_height_mm);
  Hand hand(wheel);
  hand.place_at(outer_of(pot, kPotMm) + kFingertipMm + 1.0, kPotMm + above_mm);
  hand.move_to(to_mm, kPotMm + above_mm, mm_s);
  hand.move_to(to_mm, kPotMm + 200.0, 200.0);
  expect_balanced(wheel);
  const double least = scene.removal.min_wall_mm - 1e-5;
  for (const Ring& ring : wheel.stack().rings()) EXPECT_GT(wall_of(ring), least);
  return wheel.stack().height_mm();
}

/// No pot becomes a pipe.
TEST(NarrowRim, ClosesUnderAToolThatSweepsOverIt) {
  constexpr double kMostMm[] = {165.0, 190.0, 265.0, 175.0};
  const auto scene = [](bool closes) {
    SceneSpec thin = closing_scene(closes);
    thin.removal.min_wall_mm = 2.0;
    return thin;
  };
  for (int pot = 0; pot < 4; ++pot)
    for (const double wall_mm : {2.0, 3.0, 5.0})
      for (const double above_mm : {3.0, 4.0, 5.0, 6.0, 7.0})
        for (const double mm_s : {15.0, 30.0, 60.0, 150.0})
          EXPECT_LT(height_swept(scene(true), pot, wall_mm, above_mm, mm_s), kMostMm[pot])
              << pot << ' ' << wall_mm << ' ' << above_mm << ' ' << mm_s;
  EXPECT_GT(height_swept(scene(false), kBowl, 3.0, 6.0, 15.0), kPotMm + 800.0);
}

/// A wall at its minimum cannot lose a part beside the ball. In the tick in which a ring appears,
/// it is not in the ball, keeps its thickness, and touches the ring below.
TEST(NarrowRim, GrowsNoRingIntoATool) {
  Wheel wheel = wheel_with(
      closing_scene(true), kPotMm, [](double up) { return outer_of(kBowl, up); },
      [](double up) { return outer_of(kBowl, up) - kThinMm; });
  const double y = kPotMm + 6.0;
  std::size_t grown = 0;
  for (int tick = 1; tick <= 4000; ++tick) {
    const double d = outer_of(kBowl, kPotMm) + kFingertipMm + 1.0 - 0.015 * tick;
    const std::size_t before = wheel.stack().size();
    wheel.step({1000 * tick, {d, y, 0.0}, false, 0.0});
    const auto rings = wheel.stack().rings();
    for (std::size_t i = before; i < rings.size(); ++i) {
      const double t = (static_cast<double>(i) + 0.5) * kH - y;
      const double clear = d - std::sqrt(std::max(kFingertipMm * kFingertipMm - t * t, 0.0));
      ASSERT_LT(rings[i].outer_mm(), clear + 1e-6) << tick;
      ASSERT_GT(wall_of(rings[i]), kThinMm - 1e-5) << tick;
      ASSERT_TRUE(rings[i].touches(rings[i - 1])) << tick;
      ++grown;
    }
  }
  EXPECT_GT(grown, 10u);
}

/// Gain in height of a ring by half of its hoop strain [mm]. R^2 + r^2 is twice the square of a
/// radius between r and R.
double gain_of(const Ring& before, const Ring& after) {
  const auto radius = [](const Ring& ring) {
    return std::sqrt(0.5 * kMm2PerQuantum * static_cast<double>(ring.outer2 + ring.inner2));
  };
  return kH * 0.5 * std::log(radius(before) / radius(after));
}

/// A wide wall below a narrow neck, pressed in. The wall is at its minimum, so all of it bends. The
/// rim rises by the gain of the rings; without the option by more, since a ring of the neck holds
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

/// A rim of 80 mm that is pushed in to about half of its width.
TEST(NarrowRim, DependsLittleOnTheRingHeight) {
  for (const double above_mm : {3.0, 5.0, 7.0}) {
    const auto height = [&](double ring_height_mm) {
      return height_swept(closing_scene(true), kCylinder, kThinMm, above_mm, 30.0, 26.0,
                          ring_height_mm);
    };
    EXPECT_NEAR(height(0.4), height(0.2), 1.0) << above_mm;
    EXPECT_NEAR(height(0.2), height(0.1), 1.0) << above_mm;
  }
}

}  // namespace
}  // namespace clay
