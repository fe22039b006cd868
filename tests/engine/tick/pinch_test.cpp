// The wall between two tools, and the input that the wheel refuses.

#include "claystack/engine/wheel.hpp"
#include "tests/engine/tick/pinch_samples.hpp"
#include "tests/support/allocation_counter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <utility>

namespace clay {
namespace {

using samples::pinch_at;
using samples::tube_scene;

/// Holds a pinch for a second.
Wheel held(const SceneSpec& scene, glm::dvec3 hip, double gap_mm) {
  Wheel wheel = Wheel::build(scene).value();
  for (int k = 0; k <= 1000; ++k) wheel.step(pinch_at(1000 * k, hip, gap_mm));
  return wheel;
}

/// The force after pulling up a wall at 20 mm/s for 0.5 s.
glm::dvec3 pulled(std::int64_t period_us) {
  SceneSpec scene = tube_scene(40.0, 30.0);
  scene.force->friction = 0.3;
  Wheel wheel = Wheel::build(scene).value();
  glm::dvec3 force(0.0);
  for (std::int64_t t = 0; t <= 500'000; t += period_us)
    force =
        wheel.step(pinch_at(t, {35.0, 15.0 + 2e-5 * static_cast<double>(t), 0.0}, 4.0)).force_n();
  return force;
}

TEST(Pinch, ForceIsIndependentOfTheRate) {
  const glm::dvec3 fast = pulled(125);
  EXPECT_GT(glm::length(fast), 1e-3);
  for (const std::int64_t period_us : {250, 1000})
    EXPECT_LT(glm::distance(pulled(period_us), fast), 0.05 * glm::length(fast)) << period_us;
}

TEST(Pinch, LeavesTheGapAroundTheHandPosition) {
  for (const Model model : {Model::conserving, Model::paper}) {
    SceneSpec scene = tube_scene(50.0, 40.0);
    scene.model = model;
    const Wheel wheel = held(scene, {0.0, 25.25, -45.5}, 5.0);
    const Ring& ring = wheel.stack().rings()[50];  // its middle is at 25.25 mm
    // The removal of the paper does not stop at the tool; its last tick may overshoot by k (R - r).
    const double slack = model == Model::paper ? 0.04 * 10.0 : 1e-6;
    EXPECT_NEAR(ring.outer_mm(), 48.0, slack);
    EXPECT_NEAR(ring.inner_mm(), 43.0, slack);
    EXPECT_GE(ring.outer_mm() - ring.inner_mm(), 5.0 - 1e-9);
    EXPECT_TRUE(wheel.ledger().imbalance(wheel.stack().recount()) == 0);
  }
}

TEST(Pinch, GapOfThePoseOverridesTheScene) {
  SceneSpec scene = tube_scene(50.0, 40.0);
  const auto wall = [&](ToolMode mode, double gap_mm) {
    scene.tool.mode = mode;
    const Ring ring = held(scene, {45.0, 25.25, 0.0}, gap_mm).stack().rings()[50];
    return ring.outer_mm() - ring.inner_mm();
  };
  EXPECT_NEAR(wall(ToolMode::pinch, 0.0), 4.0, 1e-6);
  EXPECT_NEAR(wall(ToolMode::pinch, 6.0), 6.0, 1e-6);
  EXPECT_NEAR(wall(ToolMode::press, 6.0), 6.0, 1e-6);
  EXPECT_NEAR(wall(ToolMode::trim, 6.0), 6.0, 1e-6);
}

TEST(Pinch, TrimCutsOnBothSides) {
  SceneSpec scene = tube_scene(50.0, 40.0);
  scene.tool.mode = ToolMode::trim;
  const Wheel wheel = held(scene, {45.0, 25.25, 0.0}, 4.0);
  const Ring& ring = wheel.stack().rings()[50];
  EXPECT_NEAR(ring.outer_mm(), 47.0, 1e-6);
  EXPECT_NEAR(ring.inner_mm(), 43.0, 1e-6);
  EXPECT_EQ(wheel.stack().rings()[80], (Ring{quanta_from_radius(50), quanta_from_radius(40)}));
  EXPECT_TRUE(wheel.ledger().trimmed == wheel.ledger().initial - wheel.stack().recount());
}

TEST(Pinch, ToolTooWideForANeckOpensItAndKeepsTheWall) {
  const Wheel wheel = held(tube_scene(12.0, 3.0), {7.0, 25.25, 0.0}, 4.0);
  const Ring& ring = wheel.stack().rings()[50];
  // The outer tool stops at 9 mm and the inner one would reach 11 mm; the wall keeps 4 mm.
  EXPECT_NEAR(ring.outer_mm() - ring.inner_mm(), 4.0, 1e-6);
  EXPECT_GT(ring.inner_mm(), 3.0);
  EXPECT_TRUE(wheel.ledger().imbalance(wheel.stack().recount()) == 0);
}

TEST(Pinch, RefusesAGapWithoutOneInTheScene) {
  SceneSpec scene = tube_scene(50.0, 40.0);
  scene.tool.gap_mm.reset();
  Wheel wheel = Wheel::build(scene).value();
  const Pot before = wheel.pot();
  EXPECT_EQ(wheel.step(pinch_at(0, {45, 25, 0}, 4.0)).flags, kRefused);
  EXPECT_TRUE(wheel.pot() == before);
  EXPECT_EQ(wheel.plan().stages & kPinch, 0u);
  // The refused pose was not stored either: this is the first pose.
  EXPECT_EQ(wheel.step(pinch_at(0, {45, 25, 0}, 0.0)).flags, kContact);
}

TEST(Pinch, RefusesInvalidGaps) {
  Wheel wheel = Wheel::build(tube_scene(50.0, 40.0)).value();
  for (const double gap : {std::nan(""), -1.0, HUGE_VAL, 1.0001e6})
    EXPECT_EQ(wheel.step(pinch_at(0, {45, 25, 0}, gap)).flags, kRefused) << gap;
  EXPECT_EQ(wheel.step(pinch_at(0, {45, 25, 0}, 1e6)).flags, 0u);  // both far away
}

TEST(Pinch, ChecksSettings) {
  SceneSpec scene = tube_scene(50.0, 40.0);
  scene.tool.mode = ToolMode::pinch;
  for (const auto& [gap, message] :
       {std::pair<std::optional<double>, std::string>{
            std::nullopt, "tool.gap_mm: expected a gap for mode pinch, found none"},
        {0.0, "tool.gap_mm: expected a value from 0.001 to 1000, found 0"},
        {std::nan(""), "tool.gap_mm: expected a value from 0.001 to 1000, found nan"}}) {
    scene.tool.gap_mm = gap;
    const auto wheel = Wheel::build(scene);
    ASSERT_FALSE(wheel);
    EXPECT_EQ(wheel.error().message, message);
  }
}

TEST(Pinch, AnUnusedGapDoesNotChangeAPress) {
  const auto play = [](std::optional<double> gap) {
    SceneSpec scene = tube_scene(50.0, 40.0);
    scene.tool.gap_mm = gap;
    scene.force->friction = 0.2;
    Wheel wheel = Wheel::build(scene).value();
    glm::dvec3 impulse(0.0);
    for (int k = 0; k < 3000; ++k)
      impulse += wheel.step({1000 * k, {57.0, 0.02 * k, 0.0}, k > 2500}).force_n();
    Pot pot = wheel.pot();
    pot.thrown_with.reset();  // has the gap
    return std::pair(pot, impulse);
  };
  EXPECT_TRUE(play(4.0) == play(std::nullopt));
}

/// Pulls a wall up, from near its foot to above its top.
Wheel pulled(const SceneSpec& scene, int ticks, double gap_mm) {
  Wheel wheel = Wheel::build(scene).value();
  for (int k = 0; k < ticks; ++k)
    wheel.step(pinch_at(1000 * k, {45.0, 10.0 + 0.02 * k, 0.0}, gap_mm));
  return wheel;
}

TEST(Pinch, PullingUpRaisesAWallAsThickAsTheGap) {
  const Wheel wheel = pulled(tube_scene(50.0, 40.0), 6000, 4.0);
  const auto rings = wheel.stack().rings();
  EXPECT_TRUE(wheel.ledger().imbalance(wheel.stack().recount()) == 0);
  EXPECT_GT(wheel.stack().height_mm(), 1.5 * 50.0);
  // From the start of the pull up to the rim.
  for (std::size_t i = 20; i < rings.size(); ++i)
    EXPECT_NEAR(rings[i].outer_mm() - rings[i].inner_mm(), 4.0, 0.1) << i;
}

TEST(Pinch, ATickAllocatesNothing) {
  SceneSpec scene = tube_scene(50.0, 40.0);
  scene.stability = StabilitySpec{1e6};
  scene.force->friction = 0.2;
  Wheel wheel = Wheel::build(scene).value();
  const std::size_t before = allocation_count();
  std::uint32_t seen = 0;
  for (int k = 0; k < 6000; ++k)
    seen |= wheel.step(pinch_at(1000 * k, {45.0, 10.0 + 0.02 * k, 0.0}, 4.0)).flags;
  EXPECT_EQ(allocation_count(), before);
  EXPECT_TRUE(seen & kGrew);
}

}  // namespace
}  // namespace clay
