// Pot and force do not depend on the ring height or on the pose rate.

#include "app/bench/convergence_experiments.hpp"

#include "claystack/engine/clay.hpp"
#include "claystack/engine/wheel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clay {
namespace {

using bench::Experiment;

class Convergence : public testing::TestWithParam<Experiment> {
 protected:
  const Experiment& e = GetParam();
  double percent_of_radius(double mm) const { return 100.0 * mm / e.scene.lump.outer_radius_mm; }
};

TEST_P(Convergence, TenTimesFinerRingsKeepTheProfile) {
  const auto coarse = bench::played(e.scene, e.poses);
  const auto fine = bench::played(bench::refined(e.scene, 10), e.poses);
  const auto difference = bench::profile_difference(coarse.stack, fine.stack);
  EXPECT_LT(percent_of_radius(difference.rms_mm), 0.5);
  EXPECT_LT(percent_of_radius(difference.outline_mm), 0.5);
}

TEST_P(Convergence, TenTimesFinerRingsKeepTheForce) {
  const auto coarse = bench::played(e.scene, e.poses);
  const auto fine = bench::played(bench::refined(e.scene, 10), e.poses);
  EXPECT_LT(bench::force_difference(coarse, fine).rms_percent, 1.0);
}

TEST_P(Convergence, OneAndFourKilohertzGiveTheSamePotAndForce) {
  const auto slow = bench::played(e.scene, e.poses);
  const auto fast = bench::played(e.scene, bench::resampled(e.poses, 250));
  EXPECT_LT(bench::force_difference(slow, fast).rms_percent, 1.0);
  const auto difference = bench::profile_difference(slow.stack, fast.stack);
  EXPECT_LT(percent_of_radius(difference.rms_mm), 0.2);
  EXPECT_LT(percent_of_radius(difference.outline_mm), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Strokes, Convergence, testing::ValuesIn(bench::convergence_experiments()),
                         [](const auto& stroke) {
                           std::string name = stroke.param.name;
                           std::ranges::replace(name, ' ', '_');
                           return name;
                         });

class RestingRib : public testing::TestWithParam<std::pair<double, double>> {};

/// The exact solution holds for any ring height that divides the rib and for any rate.
TEST_P(RestingRib, FollowsTheExactSolution) {
  const auto [h, rate_hz] = GetParam();
  const bench::RestingRib rib = bench::resting_rib(h, rate_hz);
  Wheel wheel = Wheel::build(rib.scene).value();
  const auto under = static_cast<std::size_t>(30.0 / h);
  for (const Pose& pose : rib.poses) {
    const double t_s = 1e-6 * static_cast<double>(pose.time_us);
    const StepReport report = wheel.step(pose);
    EXPECT_NEAR(report.force_n().x, rib.force_n(t_s), 1e-6) << t_s;
    const Ring& ring = wheel.stack().rings()[under];
    EXPECT_NEAR(ring.outer_mm() - ring.inner_mm(), rib.wall_mm(t_s), 1e-6) << t_s;
  }
  EXPECT_LT(rib.force_n(0.1), 1e-12);  // the clay has yielded completely
}
INSTANTIATE_TEST_SUITE_P(AnyGridAnyRate, RestingRib,
                         testing::Values(std::pair{1.0, 250.0}, std::pair{0.5, 1000.0},
                                         std::pair{0.1, 1000.0}, std::pair{0.5, 8000.0}));

TEST(RestingRib, DisplacesTheExactVolume) {
  const bench::RestingRib rib = bench::resting_rib(0.5, 1000.0);
  SceneSpec scene = rib.scene;
  scene.tool.mode = ToolMode::trim;
  Wheel wheel = Wheel::build(scene).value();
  for (const Pose& pose : rib.poses) wheel.step(pose);
  const double cut = static_cast<double>(wheel.ledger().trimmed) * wheel.stack().mm3_per_quantum();
  // 20 mm high, from 40 mm radius to 36 mm.
  EXPECT_NEAR(cut, std::numbers::pi * 20.0 * (40.0 * 40.0 - 36.0 * 36.0), 1e-4);
}

}  // namespace
}  // namespace clay
