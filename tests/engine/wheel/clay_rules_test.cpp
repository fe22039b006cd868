// The clay rules on the wheel, compared with closed forms, and their invariants.

#include "claystack/engine/wheel.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"
#include "tests/support/allocation_counter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace clay {
namespace {

/// Hoop strain splits evenly over thickness and height: w ~ 1 / sqrt(m).
TEST(ClayRules, CollaringThickensTheWallByHalfTheHoopStrain) {
  ClaySpec clay = no_rules();
  clay.shift = clay.hoop = clay.rim = true;
  SceneSpec scene = cylinder_scene(clay);
  scene.removal.min_wall_mm = 5.5;  // no clay is squeezed out
  Wheel wheel = Wheel::build(scene).value();
  const double height = wheel.stack().height_mm();
  Hand hand(wheel);
  hand.place_at(56.0, 60.0);
  hand.move_to(49.0, 60.0, 5.0);
  hand.move_to(56.0, 60.0, 50.0);
  const Ring& ring = ring_at(wheel, 60.1);
  EXPECT_LT(middle_of(ring), 38.0);
  const double thicker = 5.0 * std::sqrt(42.5 / middle_of(ring)) - 5.0;
  EXPECT_GT(thicker, 0.25);
  EXPECT_NEAR(wall_of(ring) - 5.0, thicker, 0.05 * thicker);
  EXPECT_GT(wheel.stack().height_mm(), height + 0.3);
  expect_balanced(wheel);
}

/// A ball that rises along a thick wall and presses 7 mm into it, in rings of this height. R every
/// 0.5 mm.
std::vector<double> heaved_profile(double ring_height_mm) {
  ClaySpec clay = no_rules();
  clay.heave = clay.rim = true;
  SceneSpec scene = in_rings_of(ring_height_mm, 60.0, cylinder_scene(clay));
  scene.lump.inner_radius_mm = 20.0;
  scene.removal.min_wall_mm = 2.0;
  Wheel wheel = Wheel::build(scene).value();
  for (int k = 0; k < 3000; ++k) {
    const double part = k / 3000.0;
    wheel.step({1000 * (k + 1), {55.0 - 7.0 * std::sin(2.7 * part), 20.0 + 20.0 * part, 0.0}});
  }
  std::vector<double> radii;
  for (double y = 0.5; y < 59.0; y += 0.5) radii.push_back(ring_at(wheel, y).outer_mm());
  return radii;
}

/// Heave compares walls over a distance, not from ring to ring: otherwise its limit would fall with
/// the height of the rings, and more and more clay would go elsewhere.
TEST(ClayRules, AHeavedWallHasALimitAsRingsGetLower) {
  EXPECT_LT(change_by_halving(0.05, heaved_profile), 0.01);  // 0.007; from ring to ring it is 0.013
}

TEST(ClayRules, WithoutHoopAShiftKeepsTheClayOfEachRing) {
  ClaySpec clay = no_rules();
  clay.shift = clay.heave = true;
  Wheel wheel = Wheel::build(cylinder_scene(clay)).value();
  Hand hand(wheel);
  hand.place_at(56.0, 60.0);
  hand.move_to(49.0, 60.0, 5.0);
  const Ring& ring = ring_at(wheel, 49.0);  // beside the contact no clay is removed or added
  EXPECT_LT(middle_of(ring), 42.2);
  const Ring& still = wheel.stack().rings().front();
  EXPECT_NEAR(mm2_from_quanta(ring.volume()), mm2_from_quanta(still.volume()), 2.0);
}

TEST(ClayRules, BellyingThinsTheWallAndLowersTheRim) {
  ClaySpec clay = no_rules();
  clay.shift = clay.hoop = clay.rim = clay.heave = true;
  SceneSpec scene = cylinder_scene(clay);
  scene.lump.outer_radius_mm = 42.0;
  scene.removal.min_wall_mm = 0.2;
  Wheel wheel = Wheel::build(scene).value();
  const double height = wheel.stack().height_mm();
  Hand hand(wheel);
  hand.place_at(28.0, 60.0);
  hand.move_to(36.0, 60.0, 5.0);
  hand.move_to(28.0, 60.0, 50.0);
  EXPECT_GT(middle_of(ring_at(wheel, 60.0)), 46.0);
  EXPECT_LT(wall_of(ring_at(wheel, 60.0)), 1.9);
  // The other half of the strain of each ring.
  double lower = 0.0;
  for (const Ring& ring : wheel.stack().rings())
    lower += kH * 0.5 * std::log(middle_of(ring) / 41.0);
  EXPECT_NEAR(height - wheel.stack().height_mm(), lower, 0.05 * lower);
  EXPECT_LT(wheel.stack().height_mm(), height - 0.3);
  EXPECT_LT(wheel.stack().size(), 600u);
  expect_balanced(wheel);
}

/// A rolling mill: the wall enters at w0 and leaves at w1; the wall above rises unchanged.
TEST(ClayRules, APinchLiftsTheRimLikeARollingMill) {
  ClaySpec clay = no_rules();
  clay.lift = clay.rim = true;
  SceneSpec scene = cylinder_scene(clay);
  scene.removal = {200.0, 0.25, 1.0, {}};
  Wheel wheel = Wheel::build(scene).value();
  constexpr double kGap = 4.0;
  const double rise = rise_of_pinch(wheel, 20.0, kGap);
  // By volume, because the wall is not quite thin.
  const Ring& thinned = ring_at(wheel, 65.0);
  const double part = 1.0 - static_cast<double>(thinned.volume()) /
                                static_cast<double>(wheel.stack().rings().front().volume());
  EXPECT_NEAR(wall_of(thinned), kGap, 0.05);
  EXPECT_NEAR(rise, 1.0 - kGap / 5.0, 0.02 * (1.0 - kGap / 5.0));
  EXPECT_NEAR(rise, part, 0.02 * part);
  // No clay piles up in front of the tools.
  EXPECT_EQ(ring_at(wheel, 110.0), wheel.stack().rings().back());
  expect_balanced(wheel);
}

TEST(ClayRules, APinchBesideTheWallCentresIt) {
  ClaySpec clay = no_rules();
  clay.lift = clay.shift = clay.rim = true;
  Wheel wheel = Wheel::build(cylinder_scene(clay)).value();
  Hand hand(wheel);
  hand.place_at(44.0, 40.0);
  hand.move_to(44.0, 80.0, 20.0, 6.0);
  const Ring& ring = ring_at(wheel, 60.0);
  EXPECT_GT(middle_of(ring), 43.2);
  EXPECT_LT(middle_of(ring), 44.6);
  EXPECT_NEAR(wall_of(ring), 5.0 * 42.5 / middle_of(ring), 0.05);
}

/// A lump without a bore cannot move as a shell, so it yields as without the rules.
TEST(ClayRules, ASolidLumpYieldsAsWithoutRules) {
  SceneSpec plain = cylinder_scene(no_rules());
  plain.lump.inner_radius_mm = 0.0;
  plain.clay.reset();
  SceneSpec ruled = plain;
  ruled.clay = ClaySpec{};
  Wheel old_wheel = Wheel::build(plain).value(), new_wheel = Wheel::build(ruled).value();
  for (Wheel* wheel : {&old_wheel, &new_wheel}) {
    Hand hand(*wheel);
    hand.place_at(53.0, 60.0);
    hand.place_at(53.0, 60.0);
  }
  const Ring before = Wheel::build(plain)->stack().rings()[300];
  EXPECT_LT(ring_at(new_wheel, 60.0).outer2, before.outer2);
  EXPECT_EQ(ring_at(new_wheel, 60.0), ring_at(old_wheel, 60.0));
  expect_balanced(new_wheel);
}

/// A wall at its minimum bends away from the tool without getting thinner.
TEST(ClayRules, AWallAtItsMinimumBends) {
  ClaySpec clay;
  SceneSpec scene = cylinder_scene(clay);
  scene.removal.min_wall_mm = 5.0;
  Wheel wheel = Wheel::build(scene).value();
  Hand hand(wheel);
  hand.place_at(56.0, 60.0);
  hand.move_to(50.0, 60.0, 5.0);
  EXPECT_LT(middle_of(ring_at(wheel, 60.0)), 39.0);
  for (const Ring& ring : wheel.stack().rings()) EXPECT_GT(wall_of(ring), 5.0 - 1e-9);
}

/// The wall of one ring carries the clay above it until it is too thin: w = g M / (2 pi r beta).
TEST(ClayRules, APotCutInTwoFalls) {
  constexpr double kThresholdKpa = 200.0;
  SceneSpec scene = cylinder_scene({});
  scene.tool.mode = ToolMode::trim;
  scene.removal.min_wall_mm = 0.01;
  scene.stability = StabilitySpec{kThresholdKpa};
  Wheel wheel = Wheel::build(scene).value();
  Hand hand(wheel);
  hand.place_at(56.0, 60.0);
  hand.move_to(51.0, 60.0, 10.0);
  EXPECT_FALSE(wheel.collapsed());  // 1 mm of the wall of 5 mm is left
  hand.move_to(46.0, 60.0, 10.0);
  ASSERT_TRUE(wheel.collapsed());
  const Pot pot = wheel.pot();
  ASSERT_TRUE(pot.collapse);
  const std::size_t failed = pot.collapse->failed_ring;
  EXPECT_NEAR((static_cast<double>(failed) + 0.5) * kH, 60.0, 2.0);
  const double above_mm3 = std::numbers::pi * (45.0 * 45.0 - 40.0 * 40.0) * 60.0;
  const double weight_n = 9.81 * 1.9e-6 * above_mm3;
  const double thickest_mm = weight_n / (kThresholdKpa * 1e-3) / (2.0 * std::numbers::pi * 40.0);
  EXPECT_LT(wall_of(pot.stack.rings()[failed]), 1.01 * thickest_mm);
  EXPECT_NEAR(wall_of(pot.stack.rings()[failed + 100]), 5.0, 0.01);
  expect_balanced(wheel);
}

TEST(ClayRules, NoToolOpensTheFloor) {
  SceneSpec scene = cylinder_scene({});
  scene.lump.inner_radius_mm = 0.0;
  scene.clay->floor_mm = 7.0;
  Wheel wheel = Wheel::build(scene).value();
  Hand hand(wheel);
  hand.place_at(1.0, 135.0);
  hand.move_to(1.0, 8.0, 60.0);
  hand.move_to(15.0, 8.0, 60.0);
  std::size_t solid = 0;
  while (wheel.stack().rings()[solid].inner2 == 0) ++solid;
  EXPECT_EQ(solid, 35u);
  expect_balanced(wheel);
}

/// One position quantum up or down in the first tick of a level press. If only the sign of the
/// motion counted, the pots would differ by 1 mm.
TEST(ClayRules, FlowIsContinuousInTheDirectionOfMotion) {
  const auto pressed = [](double first_dy) {
    SceneSpec scene = cylinder_scene({});
    scene.lump.inner_radius_mm = 20.0;
    Wheel wheel = Wheel::build(scene).value();
    Hand hand(wheel);
    hand.place_at(56.0, 60.1);
    hand.place_at(56.0, 60.1 + first_dy);
    hand.move_to(48.0, 60.1 + first_dy, 10.0);
    return wheel.pot();
  };
  const double quantum = 0x1p-16;
  const Pot up = pressed(quantum), down = pressed(-quantum);
  double max_mm = 0.0;
  for (std::size_t i = 0; i < std::min(up.stack.size(), down.stack.size()); ++i)
    max_mm = std::max(max_mm,
                      std::abs(up.stack.rings()[i].outer_mm() - down.stack.rings()[i].outer_mm()));
  EXPECT_LT(max_mm, 1e-3);
}

TEST(ClayRules, ProbeMatchesStep) {
  Wheel wheel = Wheel::build(small_scene()).value();
  glm::dvec3 last{0.0};
  const auto is_short = [&](const Pose& pose) {
    const glm::dvec3 motion = pose.position_mm - last;
    return std::max(std::abs(motion.x), std::abs(motion.y)) < 0.05;
  };
  for (const Pose& pose : random_poses(9, 2000)) {
    const StepReport probed = wheel.probe(pose);
    const ClayStack before = wheel.stack();
    EXPECT_EQ(wheel.probe(pose).force_n(), probed.force_n());
    EXPECT_EQ(wheel.stack(), before);
    const StepReport report = wheel.step(pose);
    // step() plays a longer motion in parts; probe() does not.
    if (!(report.flags & kGrew) && is_short(pose)) {
      EXPECT_EQ(report.force_n(), probed.force_n());
    }
    last = pose.position_mm;
  }
}

TEST(ClayRules, ATickAllocatesNothing) {
  Wheel wheel = Wheel::build(small_scene()).value();
  const auto poses = random_poses(5, 3000);
  const std::size_t before = allocation_count();
  for (const Pose& pose : poses) wheel.step(pose);
  EXPECT_EQ(allocation_count(), before);
}

/// Cut anywhere, in clay or in air; the second half starts at the position of the hand.
TEST(ClayRules, ASavedPotContinuesWithTheSameBits) {
  SceneSpec scene = small_scene();
  scene.stability.reset();  // a fallen pot does not continue
  const auto poses = random_poses(3, 4000);
  Wheel whole = Wheel::build(scene).value();
  for (const Pose& pose : poses) whole.step(pose);
  for (const std::size_t cut : {1u, 500u, 1234u, 2345u, 3999u}) {
    Wheel first = Wheel::build(scene).value();
    for (std::size_t k = 0; k <= cut; ++k) first.step(poses[k]);
    Wheel second = Wheel::build(scene, first.pot()).value();
    for (std::size_t k = cut; k < poses.size(); ++k) second.step(poses[k]);
    EXPECT_EQ(second.pot(), whole.pot()) << cut;
  }
}

/// A rib above a wall of 5 mm, whose crown holds clay for three rings of 0.2 mm.
TEST(ClayRules, NoRingRisesIntoAToolAboveTheRim) {
  SceneSpec scene = cylinder_scene({});
  scene.tool.shape = RibSpec{20.0, 6.0};
  const Ring ring{quanta_from_radius(45.0), quanta_from_radius(40.0)};
  const std::vector<Ring> rings(100, ring);
  Pot pot = Wheel::build(scene).value().pot();
  pot.stack = ClayStack::from_rings(kH, rings, 3 * ring.volume()).value();
  pot.ledger = {};
  pot.ledger.initial = pot.stack.volume();
  // The rib ends in the upper half of the top ring, and just above that ring.
  for (const double clear_mm : {-0.05, 0.05})
    for (const double gap_mm : {0.0, 2.0}) {
      Wheel wheel = Wheel::build(scene, pot).value();
      for (const std::int64_t ms : {1, 2}) {
        const Pose pose{1000 * ms, {44.0, 30.0 + clear_mm, 0.0}, false, gap_mm};
        EXPECT_EQ(wheel.step(pose).flags & kGrew, 0u) << clear_mm << " " << gap_mm;
      }
      wheel.step({3000, {80.0, 60.0, 0.0}});
      EXPECT_EQ(wheel.stack().size(), 103u) << clear_mm << " " << gap_mm;
      expect_balanced(wheel);
    }
}

TEST(ClayRules, PaperModelHasNoRules) {
  SceneSpec scene = small_scene();
  scene.model = Model::paper;
  Wheel ruled = Wheel::build(scene).value();
  EXPECT_EQ(ruled.plan().stages & kRules, 0u);
  scene.clay.reset();
  Wheel plain = Wheel::build(scene).value();
  for (const Pose& pose : random_poses(4, 500)) {
    ruled.step(pose);
    plain.step(pose);
  }
  Pot pot = ruled.pot(), expected = plain.pot();
  pot.thrown_with.reset(), expected.thrown_with.reset();  // the settings differ, the clay does not
  EXPECT_EQ(pot, expected);
}

}  // namespace
}  // namespace clay
