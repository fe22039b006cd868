#include "claystack/engine/tick.hpp"

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

TEST(MinWall, ReturnsTheWallTheFloorOrTheDiameter) {
  EXPECT_NEAR(min_wall(stack_of(5, {{40, 0}, {40, 35}})).thickness_mm, 5.0, 1e-9);   // wall = floor
  EXPECT_NEAR(min_wall(stack_of(3, {{40, 0}, {40, 35}})).thickness_mm, 3.0, 1e-9);   // floor
  EXPECT_NEAR(min_wall(stack_of(30, {{40, 0}, {40, 38}})).thickness_mm, 2.0, 1e-9);  // wall
  EXPECT_NEAR(min_wall(stack_of(30, {{40, 0}, {7, 0}})).thickness_mm, 14.0, 1e-9);   // across
}

TEST(MinWall, CrossesClayOnly) {
  EXPECT_NEAR(min_wall(stack_of(10, {{20, 15}, {14, 10}})).thickness_mm, 4.0, 1e-9);  // two pieces
  EXPECT_NEAR(min_wall(stack_of(10, {{20, 0}})).thickness_mm, 10.0, 1e-9);            // a puck
}

TEST(MinWall, SearchesAcrossRings) {
  // Neighbours share a level: from the bore of ring 1 (38) to the outside of ring 2 (39).
  const WallMinimum step = min_wall(stack_of(30, {{40, 0}, {44, 38}, {39, 30}}));
  EXPECT_NEAR(step.thickness_mm, 1.0, 1e-9);
  EXPECT_EQ(step.ring, 1u);
  // Two rings apart, with one ring of 0.3 mm between.
  EXPECT_NEAR(min_wall(stack_of(0.3, {{50, 40}, {50, 39}, {40.4, 30}})).thickness_mm, 0.5, 1e-9);
}

RC_GTEST_PROP(MinWall, EqualsTheMinimumOverAllPairs, ()) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::element<std::size_t>(1, 2, 15, 16, 17, 30, 256, 300);
  const double h = *rc::gen::element(0.01, 0.2, 1.0, 20.0);
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < count; ++i) {
    const double outer = 40.0 + 5.0 * samples::uniform(random);
    rings.push_back({quanta_from_radius(outer),
                     quanta_from_radius(outer - 6.0 - 20.0 * samples::uniform(random))});
  }
  const ClayStack stack = ClayStack::from_rings(h, rings, 0).value();
  double least = 1e300;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      const double apart =
          i == j ? 0.0 : h * (std::abs(static_cast<double>(i) - static_cast<double>(j)) - 1.0);
      least = std::min(least,
                       std::hypot(std::max(0.0, rings[j].outer_mm() - rings[i].inner_mm()), apart));
    }
  RC_ASSERT(std::abs(min_wall(stack).thickness_mm - least) < 1e-9);
}

/// A flared wall: radially 3 mm, at 45 degrees. Testing from each ring all rings within reach would
/// take 2^20 times 2 * 3000 tests.
TEST(MinWall, FindsTheWallOfManyFineRingsQuickly) {
  constexpr double kRingMm = 0.001, kWallMm = 3.0;
  std::vector<Ring> rings(std::size_t{1} << 20);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double inner = 20.0 + kRingMm * static_cast<double>(i);
    rings[i] = {quanta_from_radius(inner + kWallMm), quanta_from_radius(inner)};
  }
  const WallMinimum wall = min_wall(ClayStack::from_rings(kRingMm, rings, 0).value());
  EXPECT_NEAR(wall.thickness_mm, kWallMm / std::numbers::sqrt2, kRingMm);
}

TEST(Stresses, EqualWeightOverArea) {
  // SI: a column of 2000 kg/m^3 on rings of 20 and 10 mm; the top one bears no load.
  const auto stresses = stresses_kpa(stack_of(5, {{20, 0}, {10, 0}, {20, 0}}), 2.0);
  ASSERT_EQ(stresses.size(), 3u);
  const double of_one = 2000.0 * 9.80665 * 0.005 * 1e-3;  // kPa under 5 mm of its own width
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
