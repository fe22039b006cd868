// Invariants after every tick with clay rules, for any motion of the hand. For a long run:
// CLAYSTACK_AUDIT_TICKS=100000 engine_tests --gtest_filter=ClayAudit.*

#include "claystack/engine/wheel.hpp"
#include "engine/tick/clay_rules.hpp"
#include "engine/tick/contact.hpp"
#include "engine/tick/joints.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace clay {
namespace {

// The radius of a bore of one quantum.
constexpr double kRoundingMm = 4e-6;

int ticks() {
  const char* const text = std::getenv("CLAYSTACK_AUDIT_TICKS");
  return text != nullptr ? std::max(std::atoi(text), 1) : 3000;
}

/// The clay of a ring by which the rim rises: the top ring. A lip, at most 12 mm high and at the
/// rim less than 0.7 as thick as the wall below, rises by a ring of that wall.
Quanta largest_at_rim(const ClayStack& stack) {
  const auto rings = stack.rings();
  const auto count = static_cast<std::size_t>(12.0 / stack.ring_height_mm()) + 1;
  double thickest_mm = 0.0;
  Quanta most = 0;
  for (const Ring& ring : rings.last(std::min(count, rings.size()))) {
    thickest_mm = std::max(thickest_mm, wall_of(ring));
    most = std::max(most, ring.volume());
  }
  return wall_of(rings.back()) < 0.7 * thickest_mm ? most : rings.back().volume();
}

TEST(ClayAudit, AccountsForEveryQuantumAfterEveryTick) {
  for (unsigned rules = 0; rules < kRuleSets; rules += 7) {
    SceneSpec scene = small_scene();
    scene.clay = ClaySpec{(rules & kLift) != 0,
                          (rules & kShift) != 0,
                          (rules & kRim) != 0,
                          (rules & kHoop) != 0,
                          (rules & kHeave) != 0,
                          (rules & kSmear) != 0,
                          120.0,
                          3.0};
    const unsigned set = rules / 7;
    if (set % 2 == 1) scene.clay->finger_mm = 90.0;
    if (set % 4 == 1) scene.clay->finger_behind = 0.5;
    if (set % 3 != 1) scene.clay->heave_slope = 0.2;
    scene.clay->thin_wall_yields = set % 4 < 2;
    scene.clay->rim_sinks = set % 3 == 1;
    scene.clay->narrow_rim_closes = set % 2 == 0;
    scene.clay->pushed_wall_bends = set % 5 != 1;
    scene.clay->pressed_lump_stretches = set % 3 != 2;
    if (set % 5 == 3) scene.lump.inner_radius_mm = 0.0;
    scene.clay->thin_rim_rises = set % 4 != 3;
    Wheel wheel = Wheel::build(scene).value();
    for (const Pose& pose : random_poses(rules + 1, ticks())) {
      if (wheel.collapsed()) wheel = Wheel::build(scene).value();
      const StepReport report = wheel.step(pose);
      const glm::dvec3 force = report.force_n();
      ASSERT_TRUE(std::isfinite(force.x + force.y + force.z));
      ASSERT_GE(wheel.stack().crown(), 0);
      expect_balanced(wheel);
      const auto gap = lowest_gap(wheel.stack().rings(), 0, wheel.stack().size() - 1);
      ASSERT_EQ(wheel.collapsed(), gap.has_value()) << rules;
      if (gap) {
        ASSERT_EQ(wheel.pot().collapse->failed_ring, *gap);
      }
      ASSERT_EQ(wheel.stack().hollow(),
                std::ranges::any_of(wheel.stack().rings(),
                                    [](const Ring& ring) { return ring.inner2 > 0; }));
    }
    if (wheel.collapsed()) continue;
    // Once the hand is away, the clay under it can rise.
    for (int k = 1; k <= 20; ++k)
      wheel.step({1000 * (ticks() + k), {500.0, 500.0, 0.0}, false, 0.0});
    if (wheel.stack().size() < wheel.stack().max_rings()) {
      EXPECT_LT(wheel.stack().crown(), largest_at_rim(wheel.stack())) << rules;
    }
    for (const Ring& ring : wheel.stack().rings()) {
      EXPECT_GE(ring.outer2, quanta_from_radius(kMinRadiusMm));
      EXPECT_GE(ring.inner2, 0);
      EXPECT_GE(wall_of(ring), 3.0 - kRoundingMm) << rules;
    }
  }
}

/// Whether a pot with these rings could be read from a file.
bool is_valid(const ClayStack& stack) {
  const auto rings = stack.rings();
  return ClayStack::from_rings(stack.ring_height_mm(), {rings.begin(), rings.end()}, stack.crown())
      .has_value();
}

/// A press pushes it in by more than its radius.
TEST(ClayAudit, KeepsARingOfOneQuantumValid) {
  for (const double radius_mm : {1.0, 5.0, 20.0})
    for (const bool hoop : {false, true}) {
      SceneSpec scene = small_scene();
      scene.stability.reset();
      scene.removal.rate_per_s = 200.0;
      scene.clay = no_rules();
      scene.clay->shift = true;
      scene.clay->hoop = hoop;
      std::vector<Ring> rings(41, Ring{quanta_from_radius(radius_mm), 0});
      rings[20].inner2 = rings[20].outer2 - 1;
      Pot pot = Wheel::build(scene)->pot();
      pot.stack = ClayStack::from_rings(0.5, rings, 0, 600).value();
      pot.ledger.initial = pot.stack.volume();
      Wheel wheel = Wheel::build(scene, pot).value();
      for (int k = 1; k <= 100; ++k) {
        wheel.step({1000 * k, {12.0 + radius_mm - 0.1 * k, 10.25, 0.0}, false, 0.0});
        ASSERT_TRUE(is_valid(wheel.stack())) << radius_mm << ' ' << hoop << ' ' << k;
      }
      expect_balanced(wheel);
    }
}

/// A neck of 1 mm, where the minimum wall is 3 mm, between wider bores.
TEST(ClayAudit, SpongeKeepsANeckThatIsNarrowerThanTheMinimumWall) {
  for (const bool follows : {false, true}) {
    SceneSpec scene = small_scene();
    scene.stability.reset();
    scene.clay = ClaySpec{.sponge_follows = follows};
    scene.tool.mode = ToolMode::smooth;
    const auto in_neck = [](double up) { return std::abs(up - 40.0) < 0.3; };
    Wheel wheel = wheel_with(
        scene, 75.0, [&](double up) { return in_neck(up) ? 1.0 : 20.0; },
        [&](double up) { return in_neck(up) ? 0.9 : 3.0; }, 0.5);
    for (int k = 1; k <= 500; ++k) wheel.step({1000 * k, {0.0, 40.0, 0.0}, false, 0.0});
    EXPECT_TRUE(is_valid(wheel.stack())) << follows;
    expect_balanced(wheel);
  }
}

/// A sponge on random ways over a pot, also along its solid bottom, past its rim, and in its bore.
TEST(ClayAudit, SpongeKeepsEveryQuantum) {
  SceneSpec scene = small_scene();
  scene.stability.reset();  // so that no pot falls
  scene.clay = ClaySpec{.sponge_follows = true};
  const Pot start = [&] {
    Wheel wheel = Wheel::build(scene).value();
    for (const Pose& pose : random_poses(5, 20'000)) wheel.step(pose);
    return wheel.pot();
  }();
  ASSERT_FALSE(start.collapse);
  scene.tool.mode = ToolMode::smooth;
  Wheel wheel = Wheel::build(scene, start).value();
  const WideQuanta clay = wheel.stack().volume();
  for (Pose pose : random_poses(9, ticks())) {
    pose.gap_mm = 0.0;
    wheel.step(pose);
    ASSERT_EQ(wheel.stack().recount(), clay);
  }
  EXPECT_TRUE(is_valid(wheel.stack()));
}

/// Depth of a tool at this height in a ring [mm]; negative without contact.
double depth_in(const Ring& ring, std::size_t i, const SceneSpec& scene, const Tool& tool,
                double hip_y, const Contact& contact) {
  const double t = (static_cast<double>(i) + 0.5) * scene.lump.ring_height_mm - hip_y;
  if (!(t > tool.low() && t < tool.high())) return -1e9;
  return depth_of(ring, tool.radius(t), contact);
}

/// With the tool at rest the overlap energy of no ring rises, and a new ring has none. So the clay
/// gives no energy to the hand.
void expect_no_gain_of_energy(const SceneSpec& scene) {
  const Tool tool = Tool::build(scene.tool.shape).value();
  Wheel wheel = Wheel::build(scene).value();
  glm::dvec3 last{0.0};
  double worst = 0.0, worst_new = 0.0;
  int seen = 0, grown = 0;
  for (const Pose& pose : random_poses(77, ticks())) {
    if (wheel.collapsed()) wheel = Wheel::build(scene).value();
    const ClayStack before = wheel.stack();
    Contact outer, inner;
    for (Contact* contact : {&outer, &inner})
      contact->rings.reserve(most_contacts(tool, scene.lump.ring_height_mm, scene.lump.max_rings));
    const bool pinch = pose.gap_mm > 0.0;
    if (pinch)
      find_pinch(tool, before, pose.position_mm, pose.gap_mm, outer, inner);
    else
      find_contact(tool, before, pose.position_mm, outer);
    wheel.step(pose);
    const glm::dvec3 motion = pose.position_mm - last;
    last = pose.position_mm;
    if (std::max(std::abs(motion.x), std::abs(motion.y)) > 0.05)
      continue;  // a longer motion is played in parts
    ++seen;
    const std::size_t top = before.size() - 1;
    // Summed over both tools, because the wall between them may move from one to the other.
    const auto energy = [&](const Ring& ring, std::size_t i) {
      double sum = 0.0;
      for (const Contact* contact : {&outer, &inner}) {
        if (contact == &inner && !pinch) continue;
        const double depth =
            std::max(depth_in(ring, i, scene, tool, pose.position_mm.y, *contact), 0.0);
        sum += depth * depth;
      }
      return sum;
    };
    const auto rings = wheel.stack().rings();
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const double now = energy(rings[i], i);
      if (i <= top) {
        worst = std::max(worst, now - energy(before.rings()[i], i));
      } else {
        worst_new = std::max(worst_new, now);
        ++grown;
      }
    }
  }
  EXPECT_GT(seen, 500);
  EXPECT_GT(grown, 0);
  EXPECT_LT(worst, 1e-9);
  EXPECT_LT(worst_new, 1e-9);
}

TEST(ClayAudit, ClayNeverMovesIntoTheTool) {
  SceneSpec scene = small_scene();
  scene.clay = ClaySpec{};
  expect_no_gain_of_energy(scene);
  scene.clay->finger_mm = 90.0;
  scene.clay->finger_behind = 0.5;
  expect_no_gain_of_energy(scene);
  scene.clay->thin_wall_yields = true;
  expect_no_gain_of_energy(scene);
  scene.clay->rim_sinks = true;
  expect_no_gain_of_energy(scene);
  scene.clay->narrow_rim_closes = true;
  expect_no_gain_of_energy(scene);
  scene.clay->lifted_wall_stretches = true;
  expect_no_gain_of_energy(scene);
  scene.clay->heave_slope = 0.2;
  expect_no_gain_of_energy(scene);
  scene.clay->pushed_wall_bends = true;
  expect_no_gain_of_energy(scene);
  scene.clay->pressed_lump_stretches = true;
  expect_no_gain_of_energy(scene);
  scene.clay->thin_rim_rises = true;
  expect_no_gain_of_energy(scene);
  scene.lump.inner_radius_mm = 0.0;
  expect_no_gain_of_energy(scene);
}

}  // namespace
}  // namespace clay
