#include "engine/tick/stability.hpp"

#include "engine/clay/stress.hpp"

#include "engine/tick/kernel_flow.hpp"
#include "engine/tick/redistribution.hpp"
#include "tests/engine/clay/stack_samples.hpp"
#include "tests/engine/tick/contact_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace clay {
namespace {

StepPlan plan_of(double max_stress_kpa, double h = 1.0) {
  SceneSpec scene;
  scene.lump.ring_height_mm = h;
  scene.stability = StabilitySpec{max_stress_kpa};
  return StepPlan::build(scene).value();
}

TEST(Stability, StressEqualsWeightOverArea) {
  const StepPlan plan = plan_of(100.0, 0.5);
  const ClayStack stack = ClayStack::cylinder(200, 0.5, 40.0, 30.0, 200).value();
  // Section 7 with g, in SI units: ring 0 carries 99.5 mm of clay of 1900 kg/m^3.
  const double area = std::numbers::pi * (0.04 * 0.04 - 0.03 * 0.03);
  const double mass = 1900.0 * area * 0.0995;
  const double expected = mass * 9.80665 / area * 1e-3;
  const WideQuanta above = stack.volume() - stack.rings()[0].volume();
  EXPECT_NEAR(stress_kpa(plan.stability.kpa_per_ratio, above, stack.rings()[0].volume()), expected,
              1e-12);
}

TEST(Stability, HoldsAtTheThresholdAndFailsOneUlpAbove) {
  const ClayStack stack = ClayStack::cylinder(100, 1.0, 40.0, 0.0, 100).value();
  StabilityPlan plan = plan_of(100.0).stability;
  const double stress = stress_kpa(plan.kpa_per_ratio, stack.volume() - stack.rings()[0].volume(),
                                   stack.rings()[0].volume());
  plan.max_stress_kpa = stress;
  EXPECT_FALSE(StabilityWatch::check_all(plan, stack));
  plan.max_stress_kpa = std::nextafter(stress, 0.0);
  const auto failure = StabilityWatch::check_all(plan, stack);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->ring, 0u);
  EXPECT_EQ(failure->stress_kpa, stress);
}

TEST(Stability, NamesTheWeakestRing) {
  const Ring wide{quanta_from_radius(50), 0}, neck{quanta_from_radius(5), 0},
      thin{quanta_from_radius(4), 0};
  const ClayStack stack =
      ClayStack::from_rings(1.0, {wide, neck, wide, thin, wide, wide}, 0).value();
  const auto failure = StabilityWatch::check_all(plan_of(0.1).stability, stack);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->ring, 3u);  // 2 * 2500 / 16 above it, against 3 * 2500 / 25 above ring 1
}

TEST(Stability, TopRingCarriesTheCrown) {
  const Ring ring{quanta_from_radius(10), 0};
  const StabilityPlan plan = plan_of(1e-9).stability;
  EXPECT_FALSE(StabilityWatch::check_all(plan, ClayStack::from_rings(1.0, {ring}, 0).value()));
  EXPECT_TRUE(StabilityWatch::check_all(
      plan, ClayStack::from_rings(1.0, {ring}, ring.volume() / 2).value()));
}

TEST(Stability, NewRingOfPaperLoadsAllRingsBelow) {
  ClayStack stack = ClayStack::cylinder(500, 1.0, 30.0, 0.0, 600).value();
  const Quanta ring = stack.rings()[0].volume();
  StepPlan plan = plan_of(1.0);
  plan.stability.max_stress_kpa =
      stress_kpa(plan.stability.kpa_per_ratio, stack.volume() - ring / 2, ring);
  StabilityWatch watch(stack);
  Ledger ledger;
  ledger.outside = ring - 1;  // clay outside the stack since the foot was last checked
  const ToolRemoval removal{samples::contact_on(499, 499), {1000}};
  watch.move_to(stack, 499);
  const Flow flow = press_clay<Model::paper>(plan, {&removal, 1}, true, stack, ledger);
  ASSERT_EQ(flow.grown, 1u);
  const auto failure = watch.check(plan.stability, stack, flow);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->ring, 0u);
}

/// The literal sum of section 7 over every ring.
std::optional<Failure> direct_sum(const StabilityPlan& plan, const ClayStack& stack) {
  std::optional<Failure> worst;
  for (std::size_t i = 0; i < stack.size(); ++i) {
    WideQuanta above = stack.crown();
    for (std::size_t j = i + 1; j < stack.size(); ++j) above += stack.rings()[j].volume();
    const double stress = stress_kpa(plan.kpa_per_ratio, above, stack.rings()[i].volume());
    if (stress > plan.max_stress_kpa && (!worst || stress > worst->stress_kpa))
      worst = Failure{i, stress};
  }
  return worst;
}

RC_GTEST_PROP(Stability, WatchedRangeMatchesTheFullSum, ()) {
  auto random = *samples::random_engine();
  ClayStack stack = ClayStack::cylinder(40, 1.0, 30.0, 10.0, 400).value();
  SceneSpec scene;
  scene.lump.ring_height_mm = 1.0;
  scene.flow = {2.0, 6.0, 0.27};
  scene.stability = StabilitySpec{1.2 + 2.0 * samples::uniform(random)};
  const StepPlan plan = StepPlan::build(scene).value();
  RC_PRE(!direct_sum(plan.stability, stack));
  Ledger ledger;
  StabilityWatch watch(stack);
  for (int step = 0; step < 60; ++step) {
    const auto bottom =
        static_cast<std::size_t>(samples::uniform(random) * static_cast<double>(stack.size()));
    ToolRemoval removal{samples::contact_on(bottom, std::min(bottom + 3, stack.size() - 1)), {}};
    auto& [contact, removed] = removal;
    for (std::size_t i = contact.bottom; i <= contact.top; ++i) {
      removed.push_back(static_cast<Quanta>(0.4 * samples::uniform(random) *
                                            static_cast<double>(stack.rings()[i].volume())));
    }
    watch.move_to(stack, std::min(contact.top + flow_reach(*plan.kernel), stack.size() - 1));
    const bool trim = samples::uniform(random) < 0.1;
    const bool up = samples::uniform(random) < 0.5;
    const Flow flow = trim ? trim_clay<Model::conserving>({&removal, 1}, stack, ledger)
                           : press_clay<Model::conserving>(plan, {&removal, 1}, up, stack, ledger);
    const auto found = watch.check(plan.stability, stack, flow);
    const auto expected = direct_sum(plan.stability, stack);
    RC_ASSERT(found.has_value() == expected.has_value());
    if (!found) continue;
    RC_ASSERT(found->stress_kpa == expected->stress_kpa);
    return;
  }
}

/// The same sum in linear time, for tall stacks.
std::optional<Failure> running_sum(const StabilityPlan& plan, const ClayStack& stack) {
  std::optional<Failure> worst;
  WideQuanta above = stack.crown();
  for (std::size_t i = stack.size(); i-- > 0; above += stack.rings()[i].volume()) {
    const double stress = stress_kpa(plan.kpa_per_ratio, above, stack.rings()[i].volume());
    if (stress > plan.max_stress_kpa && (!worst || stress > worst->stress_kpa))
      worst = Failure{i, stress};
  }
  return worst;
}

double largest_stress(const StabilityPlan& plan, const ClayStack& stack) {
  StabilityPlan any = plan;
  any.max_stress_kpa = 0.0;
  return running_sum(any, stack)->stress_kpa;
}

/// The crown becomes rings while the tool is far below; then the tool moves a little.
TEST(Stability, NewTopRingsLoadTheRingsBetween) {
  const Ring ring{quanta_from_radius(30.0), 0};
  ClayStack stack =
      ClayStack::from_rings(1.0, std::vector<Ring>(100, ring), 3 * ring.volume(), 200).value();
  StabilityPlan plan = plan_of(100.0).stability;
  StabilityWatch watch(stack);
  Ledger ledger;
  std::size_t grown = 0;
  for (const std::size_t at : {50u, 40u}) {
    const ToolRemoval removal{samples::contact_on(at, at), {ring.volume() / 2}};
    watch.move_to(stack, at);
    const Flow flow = trim_clay<Model::conserving>({&removal, 1}, stack, ledger);
    grown += flow.grown;
    if (at == 40) plan.max_stress_kpa = largest_stress(plan, stack) * (1.0 - 1e-6);
    EXPECT_EQ(watch.check(plan, stack, flow).has_value(), at == 40);
  }
  EXPECT_EQ(grown, 3u);
}

/// Ring 5 does not touch ring 6, and no ring carries much.
ClayStack parted_stack() {
  std::vector<Ring> rings(12, Ring{quanta_from_radius(40.0), quanta_from_radius(37.0)});
  for (std::size_t i = 6; i < rings.size(); ++i)
    rings[i] = {quanta_from_radius(36.5), quanta_from_radius(30.0)};
  return ClayStack::from_rings(1.0, rings, 0).value();
}

TEST(Stability, ARingThatDoesNotTouchTheOneAboveFailsAtAnyStress) {
  const ClayStack stack = parted_stack();
  StabilityPlan plan = plan_of(100.0).stability;
  const auto failed = [&](const Flow& flow) {
    StabilityWatch watch(stack);
    watch.move_to(stack, flow.highest);
    return watch.check(plan, stack, flow);
  };
  EXPECT_FALSE(failed({.lowest = 5, .highest = 6}));  // a scene without clay rules
  plan.gaps_fail = true;
  for (const Flow& flow :
       {Flow{.lowest = 5, .highest = 5}, Flow{.lowest = 6, .highest = 6},
        Flow{.lowest = 0, .highest = 11}, Flow{.lowest = 9, .highest = 9, .lip = 6, .weak = false},
        Flow{.lowest = 9, .highest = 9, .lip = 3, .weak = true}}) {
    const auto failure = failed(flow);
    ASSERT_TRUE(failure) << flow.lowest;
    EXPECT_EQ(failure->ring, 5u);
    EXPECT_EQ(failure->stress_kpa, stresses_kpa(stack, 1.9)[5]);
  }
  EXPECT_FALSE(failed({.lowest = 0, .highest = 4}));
  EXPECT_FALSE(failed({.lowest = 7, .highest = 11}));
  EXPECT_FALSE(failed({.lowest = 0, .highest = 11, .weak = false}));
}

/// The part above the lower failure falls.
TEST(Stability, TheLowerOfAGapAndAnOverloadedRingFails) {
  const ClayStack stack = parted_stack();
  StabilityPlan plan = plan_of(1.0).stability;
  plan.gaps_fail = true;
  const auto stresses = stresses_kpa(stack, 1.9);
  const auto failed_ring = [&](double threshold_kpa) {
    plan.max_stress_kpa = threshold_kpa;
    StabilityWatch watch(stack);
    watch.move_to(stack, 11);
    return watch.check(plan, stack, {.lowest = 0, .highest = 11})->ring;
  };
  EXPECT_EQ(failed_ring(0.999 * stresses[0]), 0u);
  ASSERT_GT(stresses[0], stresses[5]);
  EXPECT_EQ(failed_ring(1.001 * stresses[0]), 5u);
}

/// Walls from a tenth of the radius to solid. Some stacks have a nearly empty top ring, so that the
/// crown becomes many rings.
ClayStack random_stack(std::mt19937_64& random, std::size_t count) {
  std::vector<Ring> rings;
  while (rings.size() < count) {
    const Quanta outer2 = quanta_from_radius(20.0 + 40.0 * samples::uniform(random));
    rings.push_back({outer2, static_cast<Quanta>(0.8 * samples::uniform(random) *
                                                 static_cast<double>(outer2))});
  }
  if (samples::uniform(random) < 0.3) rings.back().inner2 = rings.back().outer2 / 100 * 99;
  return ClayStack::from_rings(1.0, std::move(rings), 0, count + 300).value();
}

ToolRemoval random_removal(std::mt19937_64& random, const ClayStack& stack) {
  const auto bottom =
      static_cast<std::size_t>(samples::uniform(random) * static_cast<double>(stack.size()));
  ToolRemoval removal{samples::contact_on(bottom, std::min(bottom + 5, stack.size() - 1)), {}};
  for (std::size_t i = bottom; i <= removal.contact.top; ++i) {
    removal.removed.push_back(static_cast<Quanta>(0.2 * samples::uniform(random) *
                                                  static_cast<double>(stack.rings()[i].volume())));
  }
  return removal;
}

/// The tool jumps over stacks with one and two levels of sums. Clay may flow to the top from far
/// below (reach 0), and growth may take several ticks (a thin ring on top).
template <Model model>
void check_jumps_against_the_running_sum() {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::element<std::size_t>(50, 700, 6000);
  ClayStack stack = random_stack(random, count);
  SceneSpec scene;
  scene.lump.ring_height_mm = 1.0;
  scene.flow = {4.0, *rc::gen::element(0.0, 12.0), 0.27};
  scene.stability = StabilitySpec{1.0};
  StepPlan plan = StepPlan::build(scene).value();
  plan.stability.max_stress_kpa =
      largest_stress(plan.stability, stack) * *rc::gen::element(1.0, 1.0001, 1.02, 3.0);
  Ledger ledger;
  StabilityWatch watch(stack);
  bool failed = false;
  for (int step = 0; step < 40 && !failed; ++step) {
    const ToolRemoval removal = random_removal(random, stack);
    const std::size_t highest =
        std::min(removal.contact.top + flow_reach(*plan.kernel), stack.size() - 1);
    watch.move_to(stack, highest);
    const bool trim = samples::uniform(random) < 0.1;
    const bool up = samples::uniform(random) < 0.5;
    const Flow flow = trim ? trim_clay<model>({&removal, 1}, stack, ledger)
                           : press_clay<model>(plan, {&removal, 1}, up, stack, ledger);
    const auto found = watch.check(plan.stability, stack, flow);
    const auto expected = running_sum(plan.stability, stack);
    RC_ASSERT(found.has_value() == expected.has_value());
    if (!found) continue;
    RC_ASSERT(found->ring == expected->ring);
    RC_ASSERT(found->stress_kpa == expected->stress_kpa);
    failed = true;
  }
  RC_CLASSIFY(failed, "failed");
}

RC_GTEST_PROP(Stability, JumpsMatchTheRunningSum, ()) {
  check_jumps_against_the_running_sum<Model::conserving>();
}
RC_GTEST_PROP(Stability, JumpsMatchTheRunningSumInPaper, ()) {
  check_jumps_against_the_running_sum<Model::paper>();
}

}  // namespace
}  // namespace clay
