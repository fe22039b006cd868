// That what is timed against each other does the same work.

#include "bare_tick.hpp"
#include "claystack/engine/wheel.hpp"
#include "pressing.hpp"
#include "stage_cost.hpp"
#include "stroke_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace clay::test {
namespace {

TEST(BareTick, LeavesTheVeryStackThatTheEngineLeaves) {
  for (const double inner_mm : {0.0, 20.0}) {
    SceneSpec scene;
    scene.force.reset();
    scene.lump.inner_radius_mm = inner_mm;
    Wheel wheel = Wheel::build(scene).value();
    bench::BareWheel bare(scene);
    for (const Pose& pose : app::stroke_poses(scene, app::kFirmMm)) {
      wheel.step(pose);
      bare.step(pose);
    }
    EXPECT_NE(wheel.stack(), Wheel::build(scene)->stack());
    EXPECT_EQ(wheel.stack(), bare.stack());
  }
}

TEST(StageCost, PutsInWhatItSays) {
  SceneSpec bare;
  bare.force.reset();
  const unsigned none = StepPlan::build(bare)->stages;
  EXPECT_EQ(none, 0u);
  const auto stages = [&](const char* stage) {
    return StepPlan::build(app::with_stage(bare, stage).value())->stages;
  };
  EXPECT_EQ(stages("force"), kForce);
  EXPECT_EQ(stages("friction"), kForce | kFriction);
  EXPECT_EQ(stages("stability"), kStability);
  EXPECT_EQ(stages("pinch"), kPinch);
  EXPECT_GT(app::with_stage(bare, "inner surface")->lump.inner_radius_mm, 0.0);
  EXPECT_FALSE(app::with_stage(bare, "contact"));
}

TEST(Presser, TouchesAsManyRingsAsItIsTimedBy) {
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

TEST(StrokeRun, AnOutcomeDoesNotDeviateFromItselfAndDoesFromAnother) {
  const auto coarse = bench::play_engine({100, 500, 30.0}, Model::conserving);
  const auto fine = bench::play_engine({400, 1000, 30.0}, Model::conserving);
  const auto same = bench::deviation(coarse, coarse);
  EXPECT_EQ(same.profile_max_mm, 0.0);
  EXPECT_EQ(same.force_max_n, 0.0);
  const auto other = bench::deviation(coarse, fine);
  EXPECT_GT(other.profile_max_mm, 0.0);
  EXPECT_GE(other.profile_max_mm, other.profile_mean_mm);
  EXPECT_GT(other.force_max_n, 0.0);
  // Sampled at the same instants, whatever the rate: 2.4 s by 8 ms, and the first.
  EXPECT_EQ(coarse.force_n.size(), 301u);
  EXPECT_EQ(fine.force_n.size(), 301u);
  EXPECT_EQ(coarse.volume_error, 0.0);
}

TEST(StrokeRun, ANotANumberShowsAsOne) {
  auto broken = bench::play_engine({100, 500, 30.0}, Model::conserving);
  const auto sound = broken;
  broken.outer_mm[7] = std::nan("");
  EXPECT_TRUE(std::isnan(bench::deviation(broken, sound).profile_max_mm));
}

}  // namespace
}  // namespace clay::test
