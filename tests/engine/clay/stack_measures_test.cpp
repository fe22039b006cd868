#include "claystack/engine/plan.hpp"

#include "engine/tick/stability.hpp"
#include "tests/engine/clay/stack_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace clay {
namespace {

ClayStack stack_of(double h, std::initializer_list<std::pair<double, double>> radii) {
  std::vector<Ring> rings;
  for (const auto& [outer, inner] : radii)
    rings.push_back({quanta_from_radius(outer), quanta_from_radius(inner)});
  return ClayStack::from_rings(h, std::move(rings), 0).value();
}

TEST(Stresses, EqualWeightOverArea) {
  // SI units: clay of 2000 kg/m^3 in rings of 20 and 10 mm radius; the top ring carries no load.
  const auto stresses = stresses_kpa(stack_of(5, {{20, 0}, {10, 0}, {20, 0}}), 2.0);
  ASSERT_EQ(stresses.size(), 3u);
  const double of_one = 2000.0 * 9.80665 * 0.005 * 1e-3;  // kPa under 5 mm of equal width
  EXPECT_NEAR(stresses[0], of_one * (400.0 + 100.0) / 400.0, 1e-9);
  EXPECT_NEAR(stresses[1], of_one * 400.0 / 100.0, 1e-9);
  EXPECT_EQ(stresses[2], 0.0);
}

RC_GTEST_PROP(Stresses, MatchTheStabilityStage, ()) {
  auto random = *samples::random_engine();
  const ClayStack stack = samples::stack(random, *rc::gen::inRange<std::size_t>(1, 300), 0.5);
  SceneSpec scene;
  scene.lump.ring_height_mm = stack.ring_height_mm();
  scene.stability = StabilitySpec{1e-9};
  const auto worst = StabilityWatch::check_all(StepPlan::build(scene).value().stability, stack);
  const auto stresses = stresses_kpa(stack, scene.lump.density_g_cm3);
  const double most = *std::max_element(stresses.begin(), stresses.end());
  RC_ASSERT(worst.has_value() == (most > 1e-9));
  if (!worst) return;
  RC_ASSERT(worst->stress_kpa == most);
  RC_ASSERT(stresses[worst->ring] == most);
}

TEST(Capacity, IsTheVolumeOfTheOpenBore) {
  const double pi = std::numbers::pi;
  EXPECT_NEAR(capacity_mm3(stack_of(5, {{40, 0}, {40, 30}, {40, 20}})), pi * 5 * (900 + 400), 1e-6);
  EXPECT_EQ(capacity_mm3(stack_of(5, {{40, 30}, {40, 30}})), 0.0);          // a through bore
  EXPECT_EQ(capacity_mm3(stack_of(5, {{40, 0}, {40, 30}, {40, 0}})), 0.0);  // closed
  const Ring wall{quanta_from_radius(40), quanta_from_radius(30)};
  const auto crowned =
      ClayStack::from_rings(5.0, {{quanta_from_radius(40), 0}, wall}, wall.volume() / 5).value();
  EXPECT_NEAR(capacity_mm3(crowned), pi * 6 * 900, 1e-6);
}

}  // namespace
}  // namespace clay
