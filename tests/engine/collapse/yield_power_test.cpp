#include "engine/collapse/yield_power.hpp"

#include "tests/engine/clay/stack_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace clay {
namespace {

Twist any_twist(std::mt19937_64& random) {
  const auto one = [&] { return 2.0 * samples::uniform(random) - 1.0; };
  return {one(), one(), one()};
}

/// A twist about a point, 1 rad/s counterclockwise.
Twist about(glm::dvec2 centre, const PlanePose& pose, double gyration) {
  const glm::dvec2 arm = pose.centre_mm - centre;
  return {-arm.y, arm.x, gyration};
}

TEST(YieldPower, AtTheFailedRingMatchesSectionSevenOfThePaper) {
  // A neck of 12 mm with a bore of 5 mm under a wide part; the face of the neck carries the load.
  std::vector<Ring> rings(30, Ring{quanta_from_radius(30), quanta_from_radius(3)});
  rings[8] = {quanta_from_radius(12), quanta_from_radius(5)};
  const ClayStack stack = ClayStack::from_rings(2.0, rings, 0).value();
  const FallenBody body(stack, 8);
  const PlanePose before{{0.0, body.centre_height_mm()}, 0.0};
  const double weight = 3.0, threshold = 2.5,
               carried = 1e-3 * threshold * std::numbers::pi * (144 - 25);
  YieldPower power(stack, 8, body, weight, threshold);
  power.place(before);
  EXPECT_NEAR(power.net({0, -1, 0}), 1.0 - carried / weight, 1e-12);
  EXPECT_NEAR(power.net({0, 1, 0}), -1.0, 1e-12);
  // About a point beyond the neck, weight and clay have the same lever.
  EXPECT_NEAR(power.net(about({40, 18}, before, body.gyration_mm())), 40 * (1.0 - carried / weight),
              1e-9);
}

TEST(YieldPower, ClayResistsOnlyCompression) {
  const ClayStack stack = ClayStack::cylinder(20, 2.0, 20.0, 0.0, 20).value();
  const FallenBody body(stack, 4);
  const PlanePose before{{0.0, body.centre_height_mm()}, 0.0};
  YieldPower power(stack, 4, body, 1.0, 1e3);
  power.place(before);
  // In a rotation about a point of the face, the right half lifts off without resistance. On the
  // left half, which moves down, the integral of |x| is 2 R^3 / 3.
  const double expected = -(2.0 / 3) * 8000;
  EXPECT_NEAR(power.net(about({0, 10}, before, body.gyration_mm())) / expected, 1.0, 5e-3);
}

RC_GTEST_PROP(YieldPower, ReturnsTheSteepestMotionOrNone, ()) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(2, 40);
  const ClayStack stack = samples::stack(random, count, 2.0);
  const auto failed = *rc::gen::inRange<std::size_t>(0, count - 1);
  const FallenBody body(stack, failed);
  const double weight = 1e-5 * body.volume_mm3();
  YieldPower power(stack, failed, body, weight, 30.0 * samples::uniform(random));
  const double low = *rc::gen::element(0.0, 0.5, 1.0);
  power.place({{20 * samples::uniform(random), low * body.centre_height_mm()},
               3.0 * samples::uniform(random)});
  const Twist best = power.steepest();
  const bool rests = best == Twist{0.0};
  const double best_power = rests ? 0.0 : power.net(best) / glm::length(best);
  RC_ASSERT(rests || best_power > 0.0);
  for (int k = 0; k < 300; ++k) {
    const Twist other = any_twist(random);
    RC_ASSERT(power.net(other) / glm::length(other) <= (rests ? 1e-6 : 2.0 * best_power) + 1e-12);
  }
}

}  // namespace
}  // namespace clay
