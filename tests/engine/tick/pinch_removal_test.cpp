#include "engine/tick/removal.hpp"

#include "engine/tick/redistribution.hpp"
#include "tests/engine/clay/stack_samples.hpp"
#include "tests/engine/tick/contact_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr RemovalPlan kPinchRemoval{.rate_per_s = 20.0, .min_wall_mm = 1.0, .paper_fraction = 0.02};

/// A wall between two tools: its radii, and the depth of each tool.
struct Wall {
  double outer = 0.0, inner = 0.0;
  double from_out = 0.0, from_in = 0.0;
  [[nodiscard]] double thickness() const { return outer - inner; }
};

ToolRemoval removal_on(Side side, double depth_mm, std::size_t ring = 0) {
  return {samples::contact_on(ring, ring, side, depth_mm), {}};
}

/// The wall after one tick.
template <Model model>
Wall pinched(Wall wall, double gap_mm, double dt_s, const RemovalPlan& plan = kPinchRemoval) {
  const ClayStack stack = ClayStack::cylinder(1, 1.0, wall.outer, wall.inner, 1).value();
  ToolRemoval outer = removal_on(Side::compressive, wall.from_out);
  ToolRemoval inner = removal_on(Side::expansive, wall.from_in);
  compute_pinch_removal<model>(plan, stack, gap_mm, dt_s, outer, inner);
  const auto taken = [](const ToolRemoval& removal) {
    return removal.removed.empty() ? 0.0 : mm2_from_quanta(removal.removed.at(0));
  };
  Wall after;
  after.outer = std::sqrt(wall.outer * wall.outer - taken(outer));
  after.inner = std::sqrt(wall.inner * wall.inner + taken(inner));
  after.from_out = wall.from_out - (wall.outer - after.outer);
  after.from_in = wall.from_in - (after.inner - wall.inner);
  return after;
}

/// dR/dt = -kappa (R - r), dr/dt = kappa (R - r), in small steps. Each holds while its tool touches
/// and while the wall is thick enough.
Wall integrated(Wall wall, double least_mm, double dt_s) {
  constexpr int kSteps = 20'000;
  const double step = dt_s / kSteps;
  for (int k = 0; k < kSteps; ++k) {
    const double spare = wall.thickness() - least_mm;
    if (spare <= 0.0) break;
    const double both = wall.from_out > 0.0 && wall.from_in > 0.0 ? 0.5 : 1.0;
    const double eps = std::min(20.0 * wall.thickness() * step, both * spare);
    const double out = std::clamp(wall.from_out, 0.0, eps);
    const double in = std::clamp(wall.from_in, 0.0, eps);
    wall = {wall.outer - out, wall.inner + in, wall.from_out - out, wall.from_in - in};
  }
  return wall;
}

TEST(PinchRemoval, BothSurfacesMoveEquallyAndThinTheWallTwiceAsFast) {
  const Wall after = pinched<Model::conserving>({50, 30, 15, 15}, 2.0, 0.004);
  EXPECT_NEAR(after.thickness(), 20.0 * std::exp(-2 * 20.0 * 0.004), 1e-9);
  EXPECT_NEAR(after.outer + after.inner, 80.0, 1e-9);
}

TEST(PinchRemoval, OneToolAloneRemovesAsMuchAsAPress) {
  for (const bool outside : {true, false}) {
    const Wall wall = outside ? Wall{50, 30, 5, 0} : Wall{50, 30, 0, 5};
    const Wall after = pinched<Model::conserving>(wall, 2.0, 0.004);
    EXPECT_NEAR(after.thickness(), 20.0 * std::exp(-20.0 * 0.004), 1e-9);
    EXPECT_EQ(outside ? after.inner : after.outer, outside ? 30.0 : 50.0);
  }
}

RC_GTEST_PROP(PinchRemoval, SolvesTheEquationsOfBothSurfaces, ()) {
  auto random = *samples::random_engine();
  const auto below = [&](double mm) { return mm * samples::uniform(random); };
  Wall wall{50.0, 45.0 - below(40.0), 0.0, 0.0};
  wall.from_out = *rc::gen::element(0.0, 1.0) * below(12.0);
  wall.from_in = *rc::gen::element(0.0, 1.0) * below(12.0);
  const double gap = 0.5 + below(6.0), dt_s = below(0.05);
  const Wall found = pinched<Model::conserving>(wall, gap, dt_s);
  const Wall expected = integrated(wall, std::max(gap, kPinchRemoval.min_wall_mm), dt_s);
  // The error of Euler's method: the wall times (kappa dt)^2 over the number of steps.
  RC_ASSERT(std::abs(found.outer - expected.outer) < 5e-3);
  RC_ASSERT(std::abs(found.inner - expected.inner) < 5e-3);
}

RC_GTEST_PROP(PinchRemoval, TwoHalfStepsEqualOneStep, ()) {
  auto random = *samples::random_engine();
  const auto below = [&](double mm) { return mm * samples::uniform(random); };
  const Wall wall{50.0, 45.0 - below(40.0), below(12.0), below(12.0)};
  const double gap = 0.5 + below(6.0), dt_s = below(0.05), part = samples::uniform(random);
  const Wall once = pinched<Model::conserving>(wall, gap, dt_s);
  const Wall halfway = pinched<Model::conserving>(wall, gap, part * dt_s);
  const Wall twice = pinched<Model::conserving>(halfway, gap, (1.0 - part) * dt_s);
  RC_ASSERT(std::abs(once.outer - twice.outer) < 1e-8);
  RC_ASSERT(std::abs(once.inner - twice.inner) < 1e-8);
}

RC_GTEST_PROP(PinchRemoval, LeavesTheGapAndTheMinimumWall, ()) {
  auto random = *samples::random_engine();
  const auto below = [&](double mm) { return mm * samples::uniform(random); };
  const RemovalPlan fast{.rate_per_s = 1e6, .min_wall_mm = 2.0, .paper_fraction = 0.9};
  const Wall wall{50.0, 49.0 - below(40.0), below(60.0), below(60.0)};
  const double gap = below(6.0);
  const Wall conserving = pinched<Model::conserving>(wall, gap, 1.0, fast);
  const Wall paper = pinched<Model::paper>(wall, gap, 1.0, fast);
  const double least = std::min(wall.thickness(), std::max(gap, 2.0));
  RC_ASSERT(conserving.thickness() >= least - 1e-9);
  RC_ASSERT(paper.thickness() >= std::min(wall.thickness(), gap) - 1e-9);
  // The amount that the tools remove at this rate.
  const double unlimited = wall.thickness() - wall.from_out - wall.from_in;
  RC_ASSERT(std::abs(conserving.thickness() - std::max(least, unlimited)) < 1e-9);
}

TEST(PinchRemoval, PaperRemovesAFractionOnEitherSide) {
  const Wall after = pinched<Model::paper>({50, 40, 1, 1}, 2.0, 0.001);
  EXPECT_NEAR(after.outer, 50.0 - 0.02 * 10.0, 1e-9);
  EXPECT_NEAR(after.inner, 40.0 + 0.02 * 10.0, 1e-9);
}

RC_GTEST_PROP(PinchRemoval, NeverEmptiesARingAndBalances, ()) {
  auto random = *samples::random_engine();
  ClayStack stack = samples::stack(random, 20);
  const RemovalPlan plan{.rate_per_s = 1e6, .min_wall_mm = 0.001, .paper_fraction = 1.0 - 1e-9};
  const double gap = *rc::gen::element(1e-300, 1e-6, 1.0);
  ToolRemoval removals[2] = {{samples::contact_on(0, 19, Side::compressive, 1e6), {}},
                             {samples::contact_on(0, 19, Side::expansive, 1e6), {}}};
  for (ToolRemoval& removal : removals) {
    for (std::size_t i = 0; i < 20; ++i)
      if (samples::uniform(random) > 0.8) removal.contact.rings.depth(i) = 0.0;
    removal.contact.rings.trim();
  }
  if (*rc::gen::arbitrary<bool>())
    compute_pinch_removal<Model::paper>(plan, stack, gap, 1.0, removals[0], removals[1]);
  else
    compute_pinch_removal<Model::conserving>(plan, stack, gap, 1.0, removals[0], removals[1]);
  for (const ToolRemoval& removal : removals) {
    RC_ASSERT(removal.removed.size() == removal.contact.rings.size());
    for (const Quanta amount : removal.removed) RC_ASSERT(amount >= 0);
  }
  Ledger ledger;
  ledger.initial = stack.volume();
  const StepPlan flow = StepPlan::build({}).value();
  if (*rc::gen::arbitrary<bool>())
    press_clay<Model::conserving>(flow, removals, *rc::gen::arbitrary<bool>(), stack, ledger);
  else
    trim_clay<Model::conserving>(removals, stack, ledger);
  RC_ASSERT(ledger.imbalance(stack.recount()) == 0);
  RC_ASSERT(stack.recount() == stack.volume());
  for (const Ring& ring : stack.rings()) RC_ASSERT(ring.inner2 >= 0 && ring.outer2 > ring.inner2);
}

TEST(PinchRemoval, RemovedClayOfBothToolsFlowsAsOneAmount) {
  constexpr Quanta kMm2 = Quanta{1} << 36;
  const auto flowed = [&](std::vector<std::pair<Side, Quanta>> amounts) {
    ClayStack stack = ClayStack::cylinder(60, 1.0, 50.0, 40.0, 60).value();
    std::vector<ToolRemoval> removals;
    for (const auto& [side, amount] : amounts) {
      removals.push_back(removal_on(side, 1.0, 30));
      removals.back().removed = {amount * kMm2};
    }
    Ledger ledger;
    press_clay<Model::conserving>(StepPlan::build({}).value(), removals, true, stack, ledger);
    return stack;
  };
  const ClayStack both = flowed({{Side::compressive, 40}, {Side::expansive, 60}});
  const ClayStack one = flowed({{Side::compressive, 100}});
  EXPECT_NEAR(mm2_from_quanta(both.rings()[30].outer2), 2500.0 - 40.0, 1e-9);
  EXPECT_NEAR(mm2_from_quanta(both.rings()[30].inner2), 1600.0 + 60.0, 1e-9);
  for (std::size_t i = 31; i < 60; ++i) EXPECT_EQ(both.rings()[i], one.rings()[i]);
}

}  // namespace
}  // namespace clay
