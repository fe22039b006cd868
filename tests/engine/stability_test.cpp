#include "stability.hpp"

#include "redistribution.hpp"
#include "stack_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace clay {
namespace {

StepPlan plan_of(double max_stress_kpa, double h = 1.0) {
  SceneSpec scene;
  scene.lump.ring_height_mm = h;
  scene.stability = StabilitySpec{max_stress_kpa};
  return StepPlan::build(scene).value();
}

TEST(Stability, StressIsWeightOverArea) {
  const StepPlan plan = plan_of(100.0, 0.5);
  const ClayStack stack = ClayStack::cylinder(200, 0.5, 40.0, 30.0, 200).value();
  // SI, section 7 with g: 99.5 mm of 1900 kg/m^3 stand on ring 0.
  const double area = std::numbers::pi * (0.04 * 0.04 - 0.03 * 0.03);
  const double mass = 1900.0 * area * 0.0995;
  const double expected = mass * 9.80665 / area * 1e-3;
  const WideQuanta above = stack.volume() - stack.rings()[0].volume();
  EXPECT_NEAR(stress_kpa(plan.stability, above, stack.rings()[0].volume()), expected, 1e-12);
}

TEST(Stability, HoldsAtTheThresholdAndFailsAnUlpBeyond) {
  const ClayStack stack = ClayStack::cylinder(100, 1.0, 40.0, 0.0, 100).value();
  StabilityPlan plan = plan_of(100.0).stability;
  const double stress =
      stress_kpa(plan, stack.volume() - stack.rings()[0].volume(), stack.rings()[0].volume());
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

TEST(Stability, TheTopRingCarriesTheCrown) {
  const Ring ring{quanta_from_radius(10), 0};
  const StabilityPlan plan = plan_of(1e-9).stability;
  EXPECT_FALSE(StabilityWatch::check_all(plan, ClayStack::from_rings(1.0, {ring}, 0).value()));
  EXPECT_TRUE(StabilityWatch::check_all(
      plan, ClayStack::from_rings(1.0, {ring}, ring.volume() / 2).value()));
}

/// The literal sum of section 7 over every ring.
std::optional<Failure> literal(const StabilityPlan& plan, const ClayStack& stack) {
  std::optional<Failure> worst;
  for (std::size_t i = 0; i < stack.size(); ++i) {
    WideQuanta above = stack.crown();
    for (std::size_t j = i + 1; j < stack.size(); ++j) above += stack.rings()[j].volume();
    const double stress = stress_kpa(plan, above, stack.rings()[i].volume());
    if (stress > plan.max_stress_kpa && (!worst || stress > worst->stress_kpa))
      worst = Failure{i, stress};
  }
  return worst;
}

RC_GTEST_PROP(Stability, WatchingTheFlowSeesWhatTheLiteralSumSees, ()) {
  auto random = *samples::random_engine();
  ClayStack stack = ClayStack::cylinder(40, 1.0, 30.0, 10.0, 400).value();
  SceneSpec scene;
  scene.lump.ring_height_mm = 1.0;
  scene.flow = {2.0, 6.0, 0.27};
  scene.stability = StabilitySpec{1.2 + 2.0 * samples::uniform(random)};
  const StepPlan plan = StepPlan::build(scene).value();
  RC_PRE(!literal(plan.stability, stack));
  Ledger ledger;
  StabilityWatch watch;
  for (int step = 0; step < 60; ++step) {
    Bite bite;
    auto& [contact, removed] = bite;
    contact.bottom =
        static_cast<std::size_t>(samples::uniform(random) * static_cast<double>(stack.size()));
    contact.top = std::min(contact.bottom + 3, stack.size() - 1);
    for (std::size_t i = contact.bottom; i <= contact.top; ++i) {
      contact.rings.push_back({static_cast<std::uint32_t>(i), 1.0, 0.0});
      removed.push_back(static_cast<Quanta>(0.4 * samples::uniform(random) *
                                            static_cast<double>(stack.rings()[i].volume())));
    }
    watch.move_to(stack, std::min(contact.top + plan.kernel.length(), stack.size() - 1));
    const bool trim = samples::uniform(random) < 0.1;
    const bool up = samples::uniform(random) < 0.5;
    const Flow flow = trim ? trim_clay<Model::conserving>({&bite, 1}, stack, ledger)
                           : press_clay<Model::conserving>(plan, {&bite, 1}, up, stack, ledger);
    const auto seen = watch.check(plan.stability, stack, flow.lowest, flow.grown);
    const auto expected = literal(plan.stability, stack);
    RC_ASSERT(seen.has_value() == expected.has_value());
    if (!seen) continue;
    RC_ASSERT(seen->stress_kpa == expected->stress_kpa);
    return;
  }
}

}  // namespace
}  // namespace clay
