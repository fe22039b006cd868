// Shapes that strokes leave with clay rules: lips, undercuts, feet, cuts.

#include "claystack/engine/wheel.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace clay {
namespace {

constexpr double kTallMm = 60.0, kThickMm = 8.0, kMiddleMm = 41.0;
constexpr std::size_t kLipRings = 20;  // half of the wall's thickness

/// A wall of 8 mm with a lip that is rounded as a half circle.
Wheel rounded_wall() {
  const auto half = [](double up) {
    const double in = std::max(up - (kTallMm - 0.5 * kThickMm), 0.0);
    return std::sqrt(0.25 * kThickMm * kThickMm - in * in);
  };
  SceneSpec scene = cylinder_scene({});
  scene.removal.min_wall_mm = 1.0;
  return wheel_with(
      scene, kTallMm, [&](double up) { return kMiddleMm + half(up); },
      [&](double up) { return kMiddleMm - half(up); });
}

std::vector<Ring> lip_of(const Wheel& wheel) {
  const auto rings = wheel.stack().rings();
  return {rings.end() - static_cast<std::ptrdiff_t>(kLipRings), rings.end()};
}

TEST(ClayShapes, AWallGrowsBelowItsLip) {
  Wheel wheel = rounded_wall();
  const std::vector<Ring> lip = lip_of(wheel);
  const std::size_t size = wheel.stack().size();
  Hand hand(wheel);
  hand.place_at(kMiddleMm, 18.0, 8.5);
  hand.move_to(kMiddleMm, 32.0, 20.0, 5.0);
  EXPECT_GT(wheel.stack().size(), size + 10);
  EXPECT_EQ(lip_of(wheel), lip);
  const auto rings = wheel.stack().rings();
  for (std::size_t i = size - kLipRings; i < rings.size() - kLipRings; ++i)
    EXPECT_EQ(rings[i], rings[size - kLipRings - 1]) << i;
  expect_balanced(wheel);
}

TEST(ClayShapes, AWallSinksBelowItsLip) {
  Wheel wheel = rounded_wall();
  const std::vector<Ring> lip = lip_of(wheel);
  const std::size_t size = wheel.stack().size();
  Hand hand(wheel);
  hand.place_at(20.0, 22.0);
  hand.move_to(36.0, 22.0, 10.0);
  ASSERT_LT(wheel.stack().size(), size);
  const std::vector<Ring> lower = lip_of(wheel);
  for (std::size_t k = 0; k < kLipRings; ++k)
    EXPECT_NEAR(wall_of(lower[k]), wall_of(lip[k]), 1e-6) << k;
  expect_balanced(wheel);
}

/// The largest step of a surface that is steeper than 3.
double largest_ledge(const Wheel& wheel, double (Ring::*surface)() const) {
  const auto rings = wheel.stack().rings();
  double largest = 0.0, ledge = 0.0;
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    const double step = (rings[i + 1].*surface)() - (rings[i].*surface)();
    if (std::abs(step) <= 3.0 * kH) {
      ledge = 0.0;
      continue;
    }
    ledge = step * ledge > 0.0 ? ledge + step : step;
    largest = std::max(largest, std::abs(ledge));
  }
  return largest;
}

/// A tube with a bore of 22 mm radius.
Wheel thick_tube(double height_mm, double outer_mm, const ToolShapeSpec& tool) {
  SceneSpec scene = cylinder_scene({});
  scene.removal = {20.0, 2.0, 3.0, {}};
  scene.tool.shape = tool;
  return wheel_with(
      scene, height_mm, [=](double) { return outer_mm; }, [](double) { return 22.0; });
}

/// Presses from the bore outward, and stays there for 0.2 s.
void press_out(Wheel& wheel, double up_mm, double to_mm, double speed_mm_s) {
  Hand hand(wheel);
  hand.place_at(10.0, up_mm);
  hand.move_to(to_mm, up_mm, speed_mm_s);
  hand.move_to(to_mm, up_mm + 0.01, 0.05);
}

/// A ball that is pressed into a thick wall by more than its radius, and a pinch that stops there.
TEST(ClayShapes, NoStrokeLeavesASteepUndercut) {
  const auto thick = [] { return thick_tube(70.0, 55.0, SphereSpec{10.0}); };
  Wheel pressed = thick();
  press_out(pressed, 35.0, 29.0, 20.0);
  EXPECT_GT(ring_at(pressed, 35.0).inner_mm(), 36.0);
  EXPECT_LT(largest_ledge(pressed, &Ring::inner_mm), 1.0);
  Wheel pinched = thick();
  Hand fingers(pinched);
  fingers.place_at(38.5, 20.0, 34.0);
  fingers.move_to(38.5, 40.0, 20.0, 8.0);
  EXPECT_LT(largest_ledge(pinched, &Ring::inner_mm), 1.0);
  EXPECT_LT(largest_ledge(pinched, &Ring::outer_mm), 1.0);
  expect_balanced(pressed);
  expect_balanced(pinched);
}

/// The undercut of a press of 32 mm begins 16 mm above the contact.
TEST(ClayShapes, ADeepPressLeavesNoLedge) {
  Wheel wheel = thick_tube(90.0, 90.0, SphereSpec{10.0});
  press_out(wheel, 40.0, 44.0, 20.0);
  EXPECT_GT(ring_at(wheel, 40.0).inner_mm(), 53.0);
  EXPECT_LT(largest_ledge(wheel, &Ring::inner_mm), 1.0);
  expect_balanced(wheel);
}

/// For any position of its flat ends between the rings.
TEST(ClayShapes, ARibLeavesNoLedgeAtItsEnds) {
  for (int k = 0; k < 12; ++k) {
    Wheel wheel = thick_tube(70.0, 55.0, RibSpec{20.7, 5.0});
    const double up = 30.0 + 0.37 * k;
    press_out(wheel, up, 25.0, 10.0);
    EXPECT_GT(ring_at(wheel, up).inner_mm(), 28.0);
    EXPECT_LT(largest_ledge(wheel, &Ring::inner_mm), 1.5) << up;
    expect_balanced(wheel);
  }
}

/// A solid lump, opened by a ball that goes down the axis to 15 mm, and out.
Wheel opened_lump(double out_mm, std::optional<double> finger_mm,
                  std::optional<double> finger_behind = {}) {
  SceneSpec scene =
      cylinder_scene({.floor_mm = 5.0, .finger_mm = finger_mm, .finger_behind = finger_behind});
  scene.lump.rings = 200;
  scene.lump.outer_radius_mm = 48.0;
  scene.lump.inner_radius_mm = 0.0;
  scene.removal = {20.0, 2.0, 2.0, {}};
  Wheel wheel = Wheel::build(scene).value();
  Hand hand(wheel);
  hand.place_at(0.0, 60.0);
  hand.move_to(0.0, 15.0, 20.0);
  hand.move_to(out_mm, 15.0, 16.0);
  expect_balanced(wheel);
  return wheel;
}

double narrowest_bore(const Wheel& wheel) {
  double least = 1e9;
  for (const Ring& ring : wheel.stack().rings())
    if (ring.inner2 > 0) least = std::min(least, ring.inner_mm());
  return least;
}

/// The rest of the finger stands nearer to the axis than the ball, by two radii of it or as many as
/// the scene says, and leans away by 1 : 8.
TEST(ClayShapes, AFingerKeepsTheBoreOpen) {
  constexpr double kHip = 15.0, kRadius = 10.0;
  for (const std::optional<double> behind : {std::optional<double>(), {2.0}, {1.0}, {0.5}}) {
    const Wheel wheel = opened_lump(36.0, 90.0, behind);
    const auto rings = wheel.stack().rings();
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const double up = (static_cast<double>(i) + 0.5) * kH;
      const double finger = 36.0 - kRadius * behind.value_or(2.0) - (up - kHip) / 8.0;
      if (up > kHip + kRadius) {
        EXPECT_GT(rings[i].inner_mm(), finger - 0.2) << up << ", " << behind.value_or(2.0);
      }
    }
  }
}

/// A lump opened at its bottom becomes a bowl, not a bottle.
TEST(ClayShapes, AFingerCloseBehindTheToolLeavesAWideMouth) {
  const auto mouth = [](std::optional<double> behind) {
    return opened_lump(28.0, 90.0, behind).stack().rings().back().inner_mm();
  };
  EXPECT_LT(mouth({}), 10.0);
  EXPECT_GT(mouth(0.5), 17.0);
}

TEST(ClayShapes, ClayClosesOverABallAloneButNotOverAFinger) {
  EXPECT_LT(narrowest_bore(opened_lump(42.0, {})), 10.0);
  EXPECT_GT(narrowest_bore(opened_lump(42.0, 90.0)), 15.0);
}

/// A neck of 8 mm radius with a wall of 4 mm over a belly: the finger would stand at 12 mm there.
TEST(ClayShapes, AFingerSparesTheNeckOverABelly) {
  const auto neck = [](std::optional<double> finger_mm) {
    const auto inner = [](double up) { return std::clamp(40.0 - 3.2 * (up - 40.0), 8.0, 40.0); };
    Wheel wheel = wheel_with(
        cylinder_scene({.finger_mm = finger_mm}), 60.0, [&](double up) { return inner(up) + 4.0; },
        inner);
    Hand hand(wheel);
    hand.place_at(20.0, 20.0);
    hand.move_to(36.0, 20.0, 20.0);
    EXPECT_GT(ring_at(wheel, 20.0).inner_mm(), 43.0);
    return ring_at(wheel, 55.0);
  };
  EXPECT_EQ(neck(90.0), neck({}));
}

/// A plate's wall is laid out, and the solid bottom holds it.
TEST(ClayShapes, AWallKeepsItsFoot) {
  SceneSpec scene = cylinder_scene({});
  scene.removal = {20.0, 2.0, 3.0, {}};
  Wheel wheel = wheel_with(
      scene, 60.0, [](double) { return 84.0; }, [](double up) { return up < 6.0 ? 0.0 : 70.0; });
  Hand finger(wheel);
  for (int pass = 0; pass < 3; ++pass) {
    const double to = 63.0 + 3.0 * pass;
    finger.place_at(50.0, 15.5);
    finger.move_to(to, 15.5, 30.0);
    finger.move_to(to + 4.0, 40.0, 30.0);
  }
  EXPECT_GT(ring_at(wheel, 20.0).outer_mm(), 86.0);
  EXPECT_LT(largest_ledge(wheel, &Ring::outer_mm), 1.0);
  expect_balanced(wheel);
}

/// Where nothing can be squeezed out, a wall moves from zero at the bottom, without a step.
TEST(ClayShapes, TheSolidBottomHoldsTheWall) {
  ClaySpec clay = no_rules();
  clay.shift = true;
  SceneSpec scene = cylinder_scene(clay);
  scene.removal.min_wall_mm = 14.0;
  Wheel wheel = wheel_with(
      scene, 60.0, [](double) { return 84.0; }, [](double up) { return up < 6.0 ? 0.0 : 70.0; });
  Hand finger(wheel);
  finger.place_at(96.0, 13.0);
  finger.move_to(91.0, 13.0, 30.0);
  EXPECT_LT(ring_at(wheel, 13.0).outer_mm(), 82.0);
  EXPECT_NEAR(ring_at(wheel, 6.1).outer_mm(), 84.0, 0.01);
}

/// The wall follows the tool and stops there, and two tools put it between them: within 0.5 mm of 8
/// mm, and 0.3 mm of 1.5 mm.
TEST(ClayShapes, AWallGoesNoFartherThanTheTool) {
  constexpr double kOuterMm = 45.0, kBallMm = 10.0, kDepthMm = 8.0;
  for (const double wall : {4.0, 8.0, 14.0}) {
    SceneSpec scene = cylinder_scene({});
    scene.lump.inner_radius_mm = kOuterMm - wall;
    scene.removal = {20.0, 2.0, 3.0, {}};
    const double inner = scene.lump.inner_radius_mm, middle = kOuterMm - 0.5 * wall;
    const auto passed = [&](double away, double to) {
      Wheel wheel = Wheel::build(scene).value();
      Hand hand(wheel);
      hand.place_at(away, 20.0);
      hand.move_to(to, 35.0, 20.0);
      hand.move_to(to, 85.0, 20.0);
      hand.move_to(away, 95.0, 20.0);
      return ring_at(wheel, 60.0);
    };
    EXPECT_NEAR(passed(inner - 14.0, inner - kBallMm + kDepthMm).inner_mm(), inner + kDepthMm, 0.5);
    EXPECT_NEAR(passed(kOuterMm + 14.0, kOuterMm + kBallMm - kDepthMm).outer_mm(),
                kOuterMm - kDepthMm, 0.5);
    Wheel pinched = Wheel::build(scene).value();
    Hand fingers(pinched);
    fingers.place_at(middle + 1.5, 15.0, wall + 4.0);
    fingers.move_to(middle + 1.5, 85.0, 20.0, 0.7 * wall);
    EXPECT_NEAR(middle_of(ring_at(pinched, 50.0)), middle + 1.5, 0.3) << wall;
  }
}

/// A cutter takes clay away and bends nothing, at the minimum wall too.
TEST(ClayShapes, ACutBendsNoWall) {
  for (const double min_wall : {4.0, 5.0}) {
    SceneSpec scene = cylinder_scene({});
    scene.tool.mode = ToolMode::trim;
    scene.removal.min_wall_mm = min_wall;
    Wheel wheel = Wheel::build(scene).value();
    const std::vector<Ring> before(wheel.stack().rings().begin(), wheel.stack().rings().end());
    Hand hand(wheel);
    hand.place_at(58.0, 112.0);
    hand.move_to(52.0, 112.0, 10.0);
    hand.move_to(52.0, 121.0, 10.0);
    ASSERT_EQ(wheel.stack().size(), before.size());
    Quanta most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(wheel.stack().rings()[i].inner2, before[i].inner2);
      most = std::max(most, before[i].outer2 - wheel.stack().rings()[i].outer2);
    }
    EXPECT_NEAR(mm2_from_quanta(most), 45.0 * 45.0 - (40.0 + min_wall) * (40.0 + min_wall), 1e-6);
    expect_balanced(wheel);
  }
}

}  // namespace
}  // namespace clay
