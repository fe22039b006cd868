// Workloads that are compared do the same work.

#include "app/bench/bare_tick.hpp"
#include "app/bench/pressing.hpp"
#include "app/bench/stage_cost.hpp"
#include "app/bench/stroke_run.hpp"
#include "claystack/engine/wheel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace clay::test {
namespace {

TEST(BareTick, MatchesTheEnginesStackAndReportBitForBit) {
  for (const double inner_mm : {0.0, 20.0}) {
    SceneSpec scene;
    scene.force.reset();
    scene.lump.inner_radius_mm = inner_mm;
    Wheel wheel = Wheel::build(scene).value();
    bench::BareWheel bare(scene);
    for (const Pose& pose : bench::stroke_poses(scene, bench::kFirmMm)) {
      const StepReport report = wheel.step(pose), bare_report = bare.step(pose);
      ASSERT_EQ(report.flags, bare_report.flags);
      ASSERT_EQ(report.rings_touched, bare_report.rings_touched);
    }
    EXPECT_NE(wheel.stack(), Wheel::build(scene)->stack());
    EXPECT_EQ(wheel.stack(), bare.stack());
  }
}

TEST(StageCost, EnablesTheNamedStage) {
  SceneSpec bare;
  bare.force.reset();
  const unsigned none = StepPlan::build(bare)->stages;
  EXPECT_EQ(none, 0u);
  const auto stages = [&](const char* stage) {
    return StepPlan::build(bench::with_stage(bare, stage).value())->stages;
  };
  EXPECT_EQ(stages("force"), kForce);
  EXPECT_EQ(stages("friction"), kForce | kFriction);
  EXPECT_EQ(stages("stability"), kStability);
  EXPECT_EQ(stages("pinch"), kPinch);
  const auto rules = [&](const char* rule) {
    return StepPlan::build(bench::with_stage(bare, rule).value())->clay.rules;
  };
  EXPECT_EQ(rules("lift"), kLift);
  EXPECT_EQ(rules("shift"), kShift);
  EXPECT_EQ(rules("rim"), kRim);
  EXPECT_EQ(rules("hoop"), kShift | kHoop);
  EXPECT_EQ(rules("heave"), kHeave);
  EXPECT_EQ(rules("smear"), kSmear);
  EXPECT_GT(bench::with_stage(bare, "inner surface")->lump.inner_radius_mm, 0.0);
  EXPECT_FALSE(bench::with_stage(bare, "contact"));
}

/// Counts rings, not seconds: the cost of a stroke is the number of rings its ticks reach.
TEST(StageCost, TimesAShortStrokeForAnyRingHeight) {
  for (const auto& [rings, ring_height_mm] :
       {std::pair(std::size_t{200}, 0.5), std::pair(std::size_t{1} << 20, 0.001),
        std::pair(std::size_t{1} << 24, 0.02), std::pair(std::size_t{1} << 24, 1.0)}) {
    SceneSpec scene;
    scene.lump.rings = rings;
    scene.lump.ring_height_mm = ring_height_mm;
    const auto timed = bench::timed_stroke(scene, bench::kFirmMm);
    ASSERT_TRUE(timed) << rings;
    EXPECT_LE(timed->scene.lump.rings, 2 * bench::kMostRingsInReach);
    if (rings == 200) {
      EXPECT_EQ(timed->poses, bench::stroke_poses(scene, bench::kFirmMm));
      EXPECT_EQ(timed->scene, scene);
    }
    Wheel wheel = Wheel::build(timed->scene).value();
    std::size_t touched = 0, in_contact = 0;
    for (const Pose& pose : timed->poses) {
      const StepReport report = wheel.step(pose);
      touched += report.rings_touched;
      in_contact += report.rings_touched > 0;
      EXPECT_LE(report.rings_touched, bench::rings_in_reach(scene));
    }
    EXPECT_LE(touched, bench::kMostRingVisits) << rings;
    EXPECT_GE(in_contact, timed->poses.size() * 9 / 10) << rings;
  }
}

TEST(StageCost, RefusesStrokesThatReachTooManyRings) {
  SceneSpec scene;
  scene.lump.rings = std::size_t{1} << 20;
  scene.lump.ring_height_mm = 0.001;
  scene.flow.reach_mm = 100.0;
  EXPECT_FALSE(bench::timed_stroke(scene, bench::kFirmMm));
  EXPECT_FALSE(bench::cost_of(scene, "stability"));
}

TEST(Presser, TouchesTheStatedNumberOfRings) {
  bench::Presser ball(bench::press_scene(200));
  ball.press();
  EXPECT_NEAR(ball.rings_touched(), 30.0, 5.0);
  bench::LiteralPresser literal(bench::press_scene(200), bench::LiteralWriting::eased);
  literal.press();
  EXPECT_NEAR(literal.rings_touched(), 30.0, 5.0);
  for (const std::size_t rings : {1u, 30u, 300u}) {
    bench::Presser rib(bench::rib_scene(rings));
    rib.press();
    EXPECT_NEAR(rib.rings_touched(), static_cast<double>(rings), 0.5) << rings;
  }
}

TEST(StrokeRun, DeviationIsZeroOnlyFromItself) {
  const auto coarse = bench::play({100, 500, 30.0}, bench::Variant::conserving);
  const auto fine = bench::play({400, 1000, 30.0}, bench::Variant::conserving);
  const auto same = bench::deviation(coarse, coarse);
  EXPECT_EQ(same.profile_max_mm, 0.0);
  EXPECT_EQ(same.force_max_n, 0.0);
  const auto other = bench::deviation(coarse, fine);
  EXPECT_GT(other.profile_max_mm, 0.0);
  EXPECT_GE(other.profile_max_mm, other.profile_mean_mm);
  EXPECT_GT(other.force_max_n, 0.0);
  // Sampled at the same instants for any rate: 2.4 s by 8 ms, and the first.
  EXPECT_EQ(coarse.force_n.size(), 301u);
  EXPECT_EQ(fine.force_n.size(), 301u);
  EXPECT_EQ(coarse.volume_error, 0.0);
}

TEST(StrokeRun, DeviationFromNanIsNan) {
  auto broken = bench::play({100, 500, 30.0}, bench::Variant::conserving);
  const auto sound = broken;
  broken.outer_mm[7] = std::nan("");
  EXPECT_TRUE(std::isnan(bench::deviation(broken, sound).profile_max_mm));
}

}  // namespace
}  // namespace clay::test
