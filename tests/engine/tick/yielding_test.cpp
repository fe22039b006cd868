// The yielding law compared with its equation, integrated in small steps.

#include "engine/tick/yielding.hpp"

#include "tests/engine/clay/stack_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr RemovalPlan kYieldingPlan{
    .rate_per_s = 20.0, .yield_depth_mm = 0.25, .min_wall_mm = 0.5, .paper_fraction = 0.0};

/// A tool in a wall, at the start of a tick.
struct Press {
  double wall = 10.0, depth = 0.0;
};

/// The state after a tick in which the tool advances by `advance`.
Press yielded(Press at, double advance, double dt_s) {
  Yielding one;
  one.wall[0] = at.wall;
  one.depth[0] = at.depth + advance;
  one.advance[0] = advance;
  one.since[0] = 1.0;
  one.target[0] = at.wall - one.depth[0];
  yield(kYieldingPlan, dt_s, one, 1);
  return {at.wall - (one.depth[0] - one.left[0]), one.left[0]};
}

/// d depth / dt = v - kappa w min(1, depth / delta), by the midpoint rule.
Press integrated(Press at, double advance, double dt_s) {
  constexpr int kSteps = 4000;
  const double step = dt_s / kSteps, speed = advance / dt_s;
  const auto rate = [](double wall, double depth) {
    return kYieldingPlan.rate_per_s * wall *
           std::clamp(depth / kYieldingPlan.yield_depth_mm, 0.0, 1.0);
  };
  for (int k = 0; k < kSteps; ++k) {
    const double half = 0.5 * step * rate(at.wall, at.depth);
    const double gone = step * rate(at.wall - half, at.depth + 0.5 * step * speed - half);
    at = {at.wall - gone, at.depth + step * speed - gone};
  }
  return at;
}

/// At every depth and rate, on the exponential, on the logistic curve and in the transition.
RC_GTEST_PROP(Yielding, SolvesTheEquationOfAToolAtRest, ()) {
  auto random = *samples::random_engine();
  const Press at{2.0 + 8.0 * samples::uniform(random), 1.5 * samples::uniform(random)};
  const double dt_s = *rc::gen::element(0.000125, 0.001, 0.004);
  const Press found = yielded(at, 0.0, dt_s), expected = integrated(at, 0.0, dt_s);
  RC_ASSERT(std::abs(found.depth - expected.depth) < 1e-5);
  RC_ASSERT(std::abs(found.wall - found.depth - (at.wall - at.depth)) < 1e-12);
}

/// A tool at rest in closed form: an exponential to the yield depth, then a logistic curve.
Press exact_at_rest(const Press& at, double dt_s) {
  const double kappa = kYieldingPlan.rate_per_s, delta = kYieldingPlan.yield_depth_mm;
  const double behind = at.wall - at.depth, knee = std::min(at.depth, delta);
  const double until_knee_s = std::log(at.wall / (behind + knee)) / kappa;
  if (until_knee_s >= dt_s) {
    const double wall = at.wall * std::exp(-kappa * dt_s);
    return {wall, wall - behind};
  }
  const double decay = std::exp(-kappa * behind * (dt_s - until_knee_s) / delta);
  const double depth = behind * knee * decay / (behind + knee * (1.0 - decay));
  return {behind + depth, depth};
}

/// The bounds of docs/model.md: the series for the time until the knee loses digits in a long tick.
TEST(Yielding, FollowsTheClosedFormOfAToolAtRest) {
  const auto expect_near = [](double dt_s, double bound_mm) {
    for (double wall = 1.0; wall <= 40.0; wall += 0.5)
      for (double depth = 0.01; depth < wall - kYieldingPlan.min_wall_mm; depth += 0.1)
        ASSERT_NEAR(yielded({wall, depth}, 0.0, dt_s).depth,
                    exact_at_rest({wall, depth}, dt_s).depth, bound_mm)
            << wall << " " << depth;
  };
  expect_near(0.001, 1e-9);
  expect_near(0.004, 1e-6);
  expect_near(0.05, 0.04);
}

RC_GTEST_PROP(Yielding, TwoHalfStepsEqualOneStep, ()) {
  auto random = *samples::random_engine();
  const Press at{2.0 + 8.0 * samples::uniform(random), 0.25 * samples::uniform(random)};
  const double dt_s = 0.01 * samples::uniform(random), part = samples::uniform(random);
  const Press once = yielded(at, 0.0, dt_s);
  const Press twice = yielded(yielded(at, 0.0, part * dt_s), 0.0, (1.0 - part) * dt_s);
  RC_ASSERT(std::abs(once.depth - twice.depth) < 1e-10);
}

/// Within 1 % of the yield depth, with ticks of 1 ms and the speeds of a hand.
RC_GTEST_PROP(Yielding, SolvesTheEquationOfAMovingTool, ()) {
  auto random = *samples::random_engine();
  const Press at{4.0 + 6.0 * samples::uniform(random), 1.0 * samples::uniform(random)};
  const double advance = 0.05 * (2.0 * samples::uniform(random) - 1.0);
  RC_PRE(at.depth + advance > 0.0);
  const Press found = yielded(at, advance, 0.001), expected = integrated(at, advance, 0.001);
  RC_ASSERT(std::abs(found.depth - std::max(expected.depth, 0.0)) <
            0.01 * kYieldingPlan.yield_depth_mm);
}

/// v delta / (kappa w), up to the ratio of depth to wall: the depth for a slow hand.
TEST(Yielding, DepthAtConstantSpeedIsIndependentOfTheRate) {
  for (const double rate_hz : {250.0, 1000.0, 8000.0}) {
    Press at{10.0, 0.0};
    const double speed = 10.0;
    for (int k = 0; k < static_cast<int>(0.02 * rate_hz); ++k)
      at = yielded(at, speed / rate_hz, 1.0 / rate_hz);
    // The wall has decreased from 10 to 9.8 mm.
    EXPECT_NEAR(at.depth, speed * 0.25 / (20.0 * 9.8), 1e-4) << rate_hz;
  }
}

TEST(Yielding, PressingStartsAtTheFirstContactWithinATick) {
  // Half of the motion is outside the clay: equal to a tick of half the time from the surface.
  Yielding one;
  one.wall[0] = 10.0;
  one.depth[0] = 0.02;
  one.advance[0] = 0.04;
  one.since[0] = 1.0;
  one.target[0] = 9.98;
  yield(kYieldingPlan, 0.001, one, 1);
  EXPECT_NEAR(one.left[0], yielded({10.0, 0.0}, 0.02, 0.0005).depth, 1e-12);
}

TEST(Yielding, NeverPassesTheToolOrPushesClayIntoIt) {
  for (const double advance : {-5.0, -0.1, 0.0, 0.1, 5.0})
    for (const double depth : {1e-9, 0.1, 3.0, 20.0})
      for (const double dt_s : {0.0, 1e-6, 0.001, 0.05}) {
        Yielding one;
        one.wall[0] = 10.0;
        one.depth[0] = depth;
        one.advance[0] = advance;
        one.since[0] = 1.0;
        one.target[0] = 10.0 - depth;
        yield(kYieldingPlan, dt_s, one, 1);
        EXPECT_GE(one.left[0], 0.0) << advance << " " << depth << " " << dt_s;
        EXPECT_LE(one.left[0], depth) << advance << " " << depth << " " << dt_s;
        EXPECT_TRUE(dt_s > 0.0 || one.left[0] == depth);
      }
}

/// Rows of both kinds: some tools were in their rings before the tick, some were not.
RC_GTEST_PROP(Yielding, EachRowYieldsAsIfItWereAlone, ()) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(1, Yielding::kMost + 1);
  Yielding all{};
  for (std::size_t k = 0; k < count; ++k) {
    all.wall[k] = 1.0 + 9.0 * samples::uniform(random);
    all.depth[k] = 0.4 * samples::uniform(random);
    all.advance[k] = 0.4 * samples::uniform(random) - 0.1;
    all.since[k] = samples::uniform(random) < 0.5 ? 1.0 : samples::uniform(random);
    all.target[k] = all.wall[k] - all.depth[k];
  }
  Yielding together = all;
  yield_each(kYieldingPlan, 0.001, together, count);
  for (std::size_t k = 0; k < count; ++k) {
    Yielding alone{};
    alone.copy(0, all, k);
    yield(kYieldingPlan, 0.001, alone, 1);
    RC_ASSERT(together.left[k] == alone.left[0]);
  }
}

}  // namespace
}  // namespace clay
