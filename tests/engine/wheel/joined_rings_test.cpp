// Presses and cuts on flat shoulders, where rings overlap by little.

#include "claystack/engine/collapse.hpp"
#include "claystack/engine/wheel.hpp"
#include "engine/tick/joints.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clay {
namespace {

/// Of a pot with a shoulder: a wall of 45 mm radius, 50 mm high, and a neck of 25 mm radius.
constexpr double kWideMm = 45.0, kNeckMm = 25.0, kShoulderMm = 50.0, kNeckHighMm = 30.0;
constexpr double kThickMm = 4.0, kRingMm = 1.0;

SceneSpec shoulder_scene() {
  SceneSpec scene = cylinder_scene({});
  scene.removal = {20.0, 2.0, 2.0, {}};
  scene.clay->finger_mm = 90.0;
  scene.clay->thin_wall_yields = true;
  scene.stability = StabilitySpec{100.0};
  return scene;
}

double height_of_shoulder(double lean_deg) {
  return (kWideMm - kNeckMm) / std::tan(lean_deg * std::numbers::pi / 180.0);
}

/// The wall of the shoulder leans inward by this angle from upright.
Wheel pot_with_shoulder(const SceneSpec& scene, double lean_deg) {
  const double slope = std::tan(lean_deg * std::numbers::pi / 180.0);
  const auto outer = [=](double up) {
    return std::clamp(kWideMm - slope * (up - kShoulderMm), kNeckMm, kWideMm);
  };
  return wheel_with(
      scene, kShoulderMm + height_of_shoulder(lean_deg) + kNeckHighMm, outer,
      [=](double up) { return up < 5.0 ? 0.0 : outer(up) - kThickMm; }, kRingMm);
}

bool in_one_piece(const Wheel& wheel) {
  return !lowest_gap(wheel.stack().rings(), 0, wheel.stack().size() - 1);
}

/// Sum of (depth of a tool from inside in a ring)^2 over all rings [mm^2].
double overlap_energy(const Wheel& wheel, const Tool& tool, const glm::dvec3& hip_mm) {
  const auto rings = wheel.stack().rings();
  double sum = 0.0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double t = (static_cast<double>(i) + 0.5) * kRingMm - hip_mm.y;
    if (!(t > tool.low() && t < tool.high())) continue;
    const double depth = std::max(hip_mm.x + tool.radius(t) - rings[i].inner_mm(), 0.0);
    sum += depth * depth;
  }
  return sum;
}

/// A slow press into the middle of the shoulder, by 12 mm beyond its surface.
void press_shoulder(Wheel& wheel, double lean_deg, bool from_inside) {
  const double up = kShoulderMm + 0.5 * height_of_shoulder(lean_deg);
  const double middle = 0.5 * (kWideMm + kNeckMm) - 0.5 * kThickMm;
  Hand hand(wheel);
  const double out = from_inside ? -1.0 : 1.0;
  hand.place_at(middle + out * 16.0, up);
  hand.move_to(middle - out * 2.0, up, 6.0);
  hand.move_to(middle + out * 16.0, up, 20.0);
}

TEST(JoinedRings, APressTearsNoShoulder) {
  for (const double lean_deg : {45.0, 60.0, 66.0, 70.0, 72.0})
    for (const bool from_inside : {false, true}) {
      Wheel wheel = pot_with_shoulder(shoulder_scene(), lean_deg);
      ASSERT_TRUE(in_one_piece(wheel));
      const ClayStack before = wheel.stack();
      press_shoulder(wheel, lean_deg, from_inside);
      EXPECT_TRUE(in_one_piece(wheel)) << lean_deg << (from_inside ? " inside" : " outside");
      EXPECT_FALSE(wheel.collapsed()) << lean_deg;
      EXPECT_NE(wheel.stack(), before);
      expect_balanced(wheel);
    }
}

/// A bowl on a foot of 30 mm radius, whose wall leans outward.
Wheel bowl_on_foot() {
  constexpr double kFloorMm = 8.0;
  const auto outer = [](double up) { return 30.0 + 40.0 * std::sqrt(up / 60.0); };
  SceneSpec scene = shoulder_scene();
  scene.clay->floor_mm = 7.0;
  return wheel_with(
      scene, 60.0, outer, [=](double up) { return up < kFloorMm ? 0.0 : outer(up - 4.0) - 9.0; },
      kRingMm);
}

TEST(JoinedRings, APressIntoTheCornerOfTheFloorKeepsTheFootOn) {
  for (const double down_to : {12.0, 5.0, 1.0}) {
    Wheel wheel = bowl_on_foot();
    ASSERT_TRUE(in_one_piece(wheel));
    const double foot_mm = wheel.stack().rings()[0].outer_mm();
    Hand hand(wheel);
    hand.place_at(20.0, 40.0);
    hand.move_to(36.0, 40.0, 60.0);
    hand.move_to(38.0, down_to, 20.0);
    hand.move_to(20.0, down_to, 60.0);
    EXPECT_TRUE(in_one_piece(wheel)) << down_to;
    EXPECT_FALSE(wheel.collapsed()) << down_to;
    EXPECT_GE(wheel.stack().rings()[0].outer_mm(), foot_mm) << down_to;
    expect_balanced(wheel);
  }
}

/// The wall goes out farther than the foot reaches.
TEST(JoinedRings, APressOutOverTheFootKeepsTheFootOn) {
  Wheel wheel = bowl_on_foot();
  Hand hand(wheel);
  hand.place_at(30.0, 43.0);
  hand.move_to(49.0, 43.0, 18.0);
  hand.move_to(49.0, 9.0, 18.0);
  EXPECT_TRUE(in_one_piece(wheel));
  EXPECT_FALSE(wheel.collapsed());
  expect_balanced(wheel);
}

/// Two tools go up along the middle of the wall, over the edge and the shoulder to the neck.
void pull_over_shoulder(Wheel& wheel, double lean_deg, double gap_mm) {
  constexpr double kOpenMm = 40.0, kClosing = 600.0;
  const double slope = std::tan(lean_deg * std::numbers::pi / 180.0);
  const double top = kShoulderMm + height_of_shoulder(lean_deg);
  const auto middle = [=](double up) {
    return std::clamp(kWideMm - slope * (up - kShoulderMm), kNeckMm, kWideMm) - 0.5 * kThickMm;
  };
  Hand hand(wheel);
  for (double k = 0.0; k < kClosing; ++k)
    hand.place_at(middle(30.0), 30.0, gap_mm + (kOpenMm - gap_mm) * (1.0 - k / kClosing));
  for (double up = 30.0; up < top + 10.0; up += 0.02) hand.place_at(middle(up), up, gap_mm);
}

TEST(JoinedRings, APinchTearsNoShoulder) {
  for (const double lean_deg : {45.0, 60.0, 66.0, 70.0, 75.0})
    for (const double gap_mm : {3.0, 6.0, 12.0}) {
      Wheel wheel = pot_with_shoulder(shoulder_scene(), lean_deg);
      ASSERT_TRUE(in_one_piece(wheel));
      const ClayStack before = wheel.stack();
      pull_over_shoulder(wheel, lean_deg, gap_mm);
      EXPECT_TRUE(in_one_piece(wheel)) << lean_deg << ", gap " << gap_mm;
      EXPECT_FALSE(wheel.collapsed()) << lean_deg << ", gap " << gap_mm;
      EXPECT_NE(wheel.stack(), before);
      expect_balanced(wheel);
    }
}

/// The rings move away from the tool: a tick of the clay does not raise the overlap energy.
TEST(JoinedRings, NoRingFollowsIntoTheTool) {
  constexpr double kPart = 0.4;  // of the height of the shoulder
  constexpr double kMiddleMm = kWideMm - kPart * (kWideMm - kNeckMm) - 0.5 * kThickMm;
  for (const double lean_deg : {60.0, 66.0, 70.0, 72.0}) {
    const SceneSpec scene = shoulder_scene();
    Wheel wheel = pot_with_shoulder(scene, lean_deg);
    const Tool tool = Tool::build(scene.tool.shape).value();
    Hand hand(wheel);
    double worst = 0.0;
    for (int k = 0; k < 1500; ++k) {
      const glm::dvec3 hip_mm{kMiddleMm - 14.0 + 0.008 * k,
                              kShoulderMm + kPart * height_of_shoulder(lean_deg), 0.0};
      const double before = overlap_energy(wheel, tool, hip_mm);
      hand.place_at(hip_mm.x, hip_mm.y);
      worst = std::max(worst, overlap_energy(wheel, tool, hip_mm) - before);
    }
    EXPECT_LT(worst, 1e-9) << lean_deg;
    EXPECT_FALSE(wheel.collapsed()) << lean_deg;
    expect_balanced(wheel);
  }
}

/// The wall bends out and up along the shoulder, and the rim sinks and grows. A second part of the
/// throw begins with the last pose of the first part, in or off the clay: this pose moves no clay.
TEST(JoinedRings, APressContinuesWithTheSameBitsAfterEveryTick) {
  SceneSpec scene = shoulder_scene();
  scene.tool.shape = EllipseSpec{15.0, 8.0};
  int in_clay = 0;
  for (const double lean_deg : {48.0, 56.0, 64.0}) {
    Wheel wheel = pot_with_shoulder(scene, lean_deg);
    for (int k = 0; k < 1500; ++k) {
      const Pose pose{1000 * (k + 1), {20.0 + 0.01 * k, 65.0 + 0.015 * k, 0.0}, false, 0.0};
      if ((wheel.step(pose).flags & kContact) == 0 || wheel.collapsed()) continue;
      ++in_clay;
      Wheel next = Wheel::build(scene, wheel.pot()).value();
      EXPECT_TRUE(next.step(pose).flags & kContact) << k;
      ASSERT_EQ(next.stack(), wheel.stack()) << lean_deg << ", tick " << k;
    }
  }
  EXPECT_GT(in_clay, 2000);
}

/// The cutter goes through the shoulder. The neck has no support then, at any stress.
TEST(JoinedRings, ACutThroughAShoulderDropsTheNeck) {
  constexpr double kLeanDeg = 75.0;
  SceneSpec scene = shoulder_scene();
  scene.tool = {SphereSpec{3.0}, ToolMode::trim, 5.0};
  scene.removal.min_wall_mm = 0.1;
  Wheel wheel = pot_with_shoulder(scene, kLeanDeg);
  press_shoulder(wheel, kLeanDeg, true);
  ASSERT_TRUE(wheel.collapsed());
  const Pot pot = wheel.pot();
  const Collapse& fall = *pot.collapse;
  EXPECT_TRUE(fall.parted());
  EXPECT_LT(fall.stress_kpa, 100.0);
  const auto rings = pot.stack.rings();
  EXPECT_EQ(lowest_gap(rings, 0, rings.size() - 1), fall.failed_ring);
  const double failed_mm = (static_cast<double>(fall.failed_ring) + 0.5) * kRingMm;
  EXPECT_GT(failed_mm, kShoulderMm);
  EXPECT_LT(failed_mm, kShoulderMm + height_of_shoulder(kLeanDeg));
  const auto frames = fall_frames(pot);
  EXPECT_LT(frames.back().potential_mj, frames.front().potential_mj);
  expect_balanced(wheel);
}

/// Scenes of older versions keep their pots.
TEST(JoinedRings, WithoutClayRulesNoPotFallsInParts) {
  constexpr double kLeanDeg = 75.0;
  SceneSpec scene = shoulder_scene();
  scene.clay.reset();
  scene.tool = {SphereSpec{3.0}, ToolMode::trim, 5.0};
  scene.removal.min_wall_mm = 0.1;
  Wheel wheel = pot_with_shoulder(scene, kLeanDeg);
  press_shoulder(wheel, kLeanDeg, true);
  EXPECT_FALSE(in_one_piece(wheel));
  EXPECT_FALSE(wheel.collapsed());
}

}  // namespace
}  // namespace clay
