// A thin rim that rises as two tools lift the wall below it (`ClaySpec::thin_rim_rises`).

#include "claystack/engine/wheel.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace clay::thin_rim {
namespace {

constexpr double kMiddleMm = 42.0, kWallMm = 5.0, kPotMm = 70.0, kTipMm = 2.0, kTipHighMm = 3.0,
                 kGapMm = 4.0, kBallMm = 10.0;

SceneSpec pull_scene(bool rises) {
  SceneSpec scene = cylinder_scene(
      {.thin_wall_yields = true, .lifted_wall_stretches = true, .thin_rim_rises = rises});
  scene.removal = {20.0, 2.0, 2.0, {}};
  return scene;
}

double half_wall(double up) { return 0.5 * (up > kPotMm - kTipHighMm ? kTipMm : kWallMm); }

/// Two tools lift a cylinder with a thin tip, past its rim.
Wheel pulled(bool rises, double ring_mm = kH) {
  Wheel wheel = wheel_with(
      pull_scene(rises), kPotMm, [](double up) { return kMiddleMm + half_wall(up); },
      [](double up) { return kMiddleMm - half_wall(up); }, ring_mm);
  Hand hand(wheel);
  hand.place_at(kMiddleMm, 20.0, kWallMm + 2.0);
  hand.move_to(kMiddleMm, 20.5, 1.0, kGapMm);
  hand.move_to(kMiddleMm, 110.0, 20.0, kGapMm);
  expect_balanced(wheel);
  return wheel;
}

/// The height of the rim that is thinner than 3 mm.
double thin_mm(const Wheel& wheel) {
  const auto rings = wheel.stack().rings();
  std::size_t first = rings.size();
  while (first > 0 && wall_of(rings[first - 1]) < 3.0) --first;
  return static_cast<double>(rings.size() - first) * wheel.stack().ring_height_mm();
}

/// The tip stays as high as it was; its copies would be a nib of more than twice that height. The
/// wall below it has the clay: 1 mm of the wall's thickness over more than 40 mm raises it.
TEST(ThinRim, RisesAsItIs) {
  const Wheel rises = pulled(true), grows = pulled(false);
  EXPECT_NEAR(thin_mm(rises), kTipHighMm, 0.6);
  EXPECT_GT(thin_mm(grows), 2.0 * kTipHighMm);
  const double h = rises.stack().height_mm();
  EXPECT_GT(h, kPotMm + 5.0);
  EXPECT_GT(wall_of(ring_at(rises, h - kTipHighMm - 1.0)), 0.9 * kGapMm);
  EXPECT_LT(rises.stack().crown(), rises.stack().rings().front().volume()) << "no clay waits";
}

TEST(ThinRim, DependsLittleOnTheRingHeight) {
  const Wheel coarse = pulled(true, 0.2), fine = pulled(true, 0.1);
  EXPECT_NEAR(thin_mm(coarse), thin_mm(fine), 0.5);
  EXPECT_NEAR(coarse.stack().height_mm(), fine.stack().height_mm(), 0.5);
}

/// A wall that is thicker than the distance of the tools is what an unfinished pull leaves, and its
/// thinner rim is no fault: it tapers as before.
TEST(ThinRim, IsThinnerThanTheToolsLeaveTheWall) {
  const auto thrown = [](bool rises) {
    const auto half = [](double up) { return up > 67.0 ? 3.0 : 7.0; };
    Wheel wheel = wheel_with(
        pull_scene(rises), kPotMm, [&](double up) { return kMiddleMm + half(up); },
        [&](double up) { return kMiddleMm - half(up); });
    Hand hand(wheel);
    hand.place_at(kMiddleMm, 20.0, 16.0);
    hand.move_to(kMiddleMm, 20.5, 1.0, 7.0);
    hand.move_to(kMiddleMm, 45.0, 20.0, 7.0);
    return wheel.pot();
  };
  EXPECT_TRUE(thrown(true).stack == thrown(false).stack);
}

/// The square of the overlap of two balls with a ring [mm^2]; `up`: from their middles.
double overlap_mm2(const Ring& ring, double x, double up) {
  if (std::abs(up) >= kBallMm) return 0.0;
  const double f = std::sqrt(kBallMm * kBallMm - up * up), apart = 0.5 * kGapMm + kBallMm;
  const double outer = std::max(ring.outer_mm() + f - (x + apart), 0.0);
  const double inner = std::max(x - apart + f - ring.inner_mm(), 0.0);
  return outer * outer + inner * inner;
}

/// Two tools lift the wall and pass the tip off its middle, so that one of them touches it: in no
/// tick does a ring move into them.
TEST(ThinRim, DoesNotRiseIntoATool) {
  for (const double off_mm : {-3.0, -1.6, 1.6, 3.0}) {
    Wheel wheel = wheel_with(
        pull_scene(true), kPotMm, [](double up) { return kMiddleMm + half_wall(up); },
        [](double up) { return kMiddleMm - half_wall(up); });
    Hand hand(wheel);
    hand.place_at(kMiddleMm, 20.0, kWallMm + 2.0);
    hand.move_to(kMiddleMm, 20.5, 1.0, kGapMm);
    hand.move_to(kMiddleMm, 40.0, 20.0, kGapMm);
    double x = kMiddleMm, worst_mm2 = 0.0;
    for (double y = 40.0; y < 100.0; y += 0.02) {
      x = std::clamp(x + 0.02 * off_mm / 10.0, kMiddleMm - std::abs(off_mm),
                     kMiddleMm + std::abs(off_mm));
      const std::vector<Ring> before(wheel.stack().rings().begin(), wheel.stack().rings().end());
      hand.move_to(x, y, 20.0, kGapMm);
      double up = 0.5 * kH - y;
      for (std::size_t i = 0; i < wheel.stack().size(); ++i, up += kH) {
        const double was = i < before.size() ? overlap_mm2(before[i], x, up) : 0.0;
        worst_mm2 = std::max(worst_mm2, overlap_mm2(wheel.stack().rings()[i], x, up) - was);
      }
    }
    EXPECT_LT(worst_mm2, 1e-9) << off_mm;
    expect_balanced(wheel);
  }
}

}  // namespace
}  // namespace clay::thin_rim
