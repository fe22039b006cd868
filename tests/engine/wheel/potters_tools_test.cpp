// Sponge, needle, wire, and trimming the foot of an inverted pot.

#include "claystack/engine/wheel.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace clay {
namespace {

SceneSpec scene_with(ToolMode mode) {
  SceneSpec scene = cylinder_scene(ClaySpec{});
  scene.tool.mode = mode;
  scene.force = ForceSpec{};
  return scene;
}

void move(Wheel& wheel, std::int64_t& time_us, const glm::dvec3& from, const glm::dvec3& to,
          int ticks = 50) {
  for (int k = 0; k <= ticks; ++k)
    wheel.step({time_us += 1000, from + (static_cast<double>(k) / ticks) * (to - from), false});
}

TEST(Needle, LevelsTheRimAtItsHeight) {
  Wheel wheel = Wheel::build(scene_with(ToolMode::needle)).value();
  const Quanta ring = wheel.stack().rings()[0].volume();
  std::int64_t time_us = 0;
  // A needle that does not pass through the wall cuts nothing.
  move(wheel, time_us, {60, 100.04, 0}, {42, 100.04, 0});
  EXPECT_EQ(wheel.stack().size(), 600u);
  move(wheel, time_us, {42, 100.04, 0}, {38, 100.04, 0});
  EXPECT_EQ(wheel.stack().size(), 500u);
  EXPECT_EQ(wheel.ledger().trimmed, WideQuanta{100} * ring);
  EXPECT_EQ(wheel.stack().crown(), 0);
  expect_balanced(wheel);
  // Out and in again above the new rim cuts nothing.
  move(wheel, time_us, {38, 100.04, 0}, {60, 100.04, 0});
  move(wheel, time_us, {60, 100.04, 0}, {38, 100.04, 0});
  EXPECT_EQ(wheel.stack().size(), 500u);
}

TEST(Needle, ProbeReportsContactAndDoesNotCut) {
  for (const ToolMode mode : {ToolMode::needle, ToolMode::wire}) {
    Wheel wheel = Wheel::build(scene_with(mode)).value();
    wheel.step({1000, {60, 100.04, 0}, false});
    EXPECT_EQ(wheel.probe({2000, {55, 100.04, 0}, false}).flags, 0u);
    EXPECT_EQ(wheel.probe({2000, {1, 100.04, 0}, false}).flags, 0u) << "in the empty bore";
    const StepReport report = wheel.probe({2000, {42, 100.04, 0}, false});
    EXPECT_EQ(report.flags, kContact);
    EXPECT_EQ(report.rings_touched, 1u);
    EXPECT_EQ(wheel.stack().size(), 600u);
    EXPECT_EQ(wheel.step({2000, {1, 100.04, 0}, false}).flags, kContact | kCut);
  }
}

TEST(Wire, CutsThePotOffAndLowersIt) {
  SceneSpec scene = scene_with(ToolMode::wire);
  scene.lump.inner_radius_mm = 0.0;
  ClayStack stack = ClayStack::cylinder(10, 1.0, 45.0, 0.0, 40).value();
  std::vector<Ring> rings(stack.rings().begin(), stack.rings().end());
  for (std::size_t i = 0; i < rings.size(); ++i)
    rings[i].outer2 -= static_cast<Quanta>(i) << 36;  // makes the rings distinguishable
  stack = ClayStack::from_rings(1.0, rings, 12345, 40).value();
  Pot pot{stack, {}, Model::conserving, 1.9, {}, {}, {}, {}};
  pot.ledger.initial = stack.volume();
  Wheel wheel = Wheel::build(scene, pot).value();
  std::int64_t time_us = 0;
  move(wheel, time_us, {60, 3.1, 0}, {0.5, 3.1, 0});
  ASSERT_EQ(wheel.stack().size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(wheel.stack().rings()[i], rings[i + 3]);
  EXPECT_EQ(wheel.stack().crown(), 12345);
  EXPECT_EQ(wheel.ledger().trimmed, rings[0].volume() + rings[1].volume() + rings[2].volume());
  expect_balanced(wheel);
  // A wire that starts inside the pot has not passed through the wall and cuts nothing.
  move(wheel, time_us, {0.5, 3.1, 0}, {0.4, 3.1, 0});
  EXPECT_EQ(wheel.stack().size(), 7u);
}

TEST(Wire, NeverRemovesTheWholePot) {
  for (const ToolMode mode : {ToolMode::wire, ToolMode::needle}) {
    Wheel wheel = Wheel::build(scene_with(mode)).value();
    std::int64_t time_us = 0;
    for (const double y : {0.01, 119.99, -3.0, 500.0}) {
      move(wheel, time_us, {60, y, 0}, {0, y, 0});
      move(wheel, time_us, {0, 900, 0}, {60, 900, 0});
    }
    EXPECT_EQ(wheel.stack().size(), 600u);
  }
}

/// Trimming the foot of an inverted pot gives, ring by ring, the mirror image of trimming the rim.
TEST(TrimFoot, MirrorsTrimmingTheRim) {
  SceneSpec scene = scene_with(ToolMode::trim_foot);
  const SampledSpec knife{{-9, -3, 4, 9}, {1, 6, 7, 2}};
  scene.tool.shape = knife;
  SceneSpec upright = scene;
  upright.tool.mode = ToolMode::trim;
  Wheel inverted = Wheel::build(scene).value(), plain = Wheel::build(upright).value();
  std::int64_t time_us = 0;
  for (int k = 0; k < 400; ++k) {
    const glm::dvec3 hip(50.0 - 0.01 * k, 115.0 - 0.1 * k, 0.003 * k);
    time_us += 1000;
    const StepReport a = inverted.step({time_us, hip, false});
    const StepReport b = plain.step({time_us, hip, false});
    EXPECT_NEAR(a.force_n().y, b.force_n().y, 1e-9);
    EXPECT_NEAR(a.force_n().x, b.force_n().x, 1e-9);
  }
  const auto foot = inverted.stack().rings(), rim = plain.stack().rings();
  ASSERT_EQ(foot.size(), rim.size());
  EXPECT_GT(inverted.ledger().trimmed, 0);
  double worst = 0.0;
  for (std::size_t i = 0; i < foot.size(); ++i)
    worst = std::max(worst, std::abs(foot[i].outer_mm() - rim[rim.size() - 1 - i].outer_mm()));
  EXPECT_LT(worst, 1e-9);
  expect_balanced(inverted);
}

/// A foot ring: the tool goes 20 mm deep into a floor of 12 mm and outwards. What remains of the
/// floor is as thick as a wall must be, and the bore above is untouched.
TEST(TrimFoot, HollowsTheFootAndLeavesAFloor) {
  SceneSpec scene = scene_with(ToolMode::trim_foot);
  scene.removal.min_wall_mm = 2.1;
  constexpr std::size_t kFloor = 60, kLeast = 11;  // rings of 0.2 mm
  std::vector<Ring> rings(600, Ring{quanta_from_radius(45.0), quanta_from_radius(38.0)});
  for (std::size_t i = 0; i < kFloor; ++i) rings[i].inner2 = 0;
  Pot pot{ClayStack::from_rings(kH, rings, 0, 2400).value(),
          {},
          Model::conserving,
          1.9,
          {},
          {},
          {},
          {}};
  pot.ledger.initial = pot.stack.volume();
  Wheel wheel = Wheel::build(scene, pot).value();
  std::int64_t time_us = 0;
  move(wheel, time_us, {0, 140, 0}, {0, 100, 0}, 2000);
  move(wheel, time_us, {0, 100, 0}, {20, 100, 0}, 2000);
  move(wheel, time_us, {20, 100, 0}, {20, 140, 0}, 2000);
  const auto cut = wheel.stack().rings();
  ASSERT_EQ(cut.size(), rings.size());
  const std::size_t ceiling = kFloor - kLeast;
  for (std::size_t i = 0; i < cut.size(); ++i)
    EXPECT_EQ(cut[i].inner2 == 0, i >= ceiling && i < kFloor) << i;
  for (std::size_t i = kFloor; i < cut.size(); ++i) EXPECT_EQ(cut[i], rings[i]) << i;
  EXPECT_GT(cut[0].inner_mm(), 20.0);
  EXPECT_GT(wheel.ledger().trimmed, 0);
  expect_balanced(wheel);
}

/// A cut from outside into the ceiling of a hollow foot, up to its bore, cuts the foot ring off.
TEST(TrimFoot, ARingThatIsCutOffFallsAway) {
  SceneSpec scene = scene_with(ToolMode::trim_foot);
  scene.clay = ClaySpec{};
  constexpr std::size_t kCeiling = 40, kFloor = 80;  // rings of 0.2 mm
  std::vector<Ring> rings(600, Ring{quanta_from_radius(45.0), quanta_from_radius(38.0)});
  for (std::size_t i = 0; i < kFloor; ++i)
    rings[i].inner2 = i < kCeiling ? quanta_from_radius(35.0) : 0;
  Pot pot;
  pot.stack = ClayStack::from_rings(kH, rings, 0, 2400).value();
  pot.ledger.initial = pot.stack.volume();
  Wheel wheel = Wheel::build(scene, pot).value();
  std::int64_t time_us = 0;
  // The ball of 8 mm goes in beside the solid ceiling, between heights of 8 and 16 mm.
  move(wheel, time_us, {70, 108, 0}, {40, 108, 0}, 3000);
  EXPECT_LE(wheel.stack().size(), rings.size() - kCeiling) << "the foot ring is gone";
  EXPECT_GE(wheel.stack().size(), rings.size() - kFloor);
  const auto left = wheel.stack().rings();
  for (std::size_t i = 0; i + 1 < left.size(); ++i) EXPECT_TRUE(left[i].touches(left[i + 1])) << i;
  expect_balanced(wheel);
  // The rest stays where it was: the tool touches nothing on its way out, and a pot that is put on
  // the wheel again is trimmed to the same bits.
  Wheel again = Wheel::build(scene, wheel.pot()).value();
  std::int64_t again_us = time_us - 1000;
  move(again, again_us, {40, 108, 0}, {40, 108, 0}, 1);
  for (Wheel* one : {&wheel, &again}) {
    std::int64_t now_us = time_us;
    move(*one, now_us, {40, 108, 0}, {38, 100, 0}, 500);
  }
  EXPECT_TRUE(wheel.pot().stack == again.pot().stack);
  expect_balanced(wheel);
}

/// A wall with waves 8 mm long and 0.3 mm deep.
Pot waved_pot(const SceneSpec& scene) {
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < scene.lump.rings; ++i) {
    const double y = (static_cast<double>(i) + 0.5) * kH;
    rings.push_back({quanta_from_radius(45.0 + 0.15 * std::sin(y * 0.7853981633974483)),
                     quanta_from_radius(38.0)});
  }
  Pot pot{ClayStack::from_rings(kH, rings, 0, 2400).value(),
          {},
          Model::conserving,
          1.9,
          {},
          {},
          {},
          {}};
  pot.ledger.initial = pot.stack.volume();
  return pot;
}

double waves_mm(const Wheel& wheel) {
  double low = 1e300, high = 0.0;
  for (std::size_t i = 250; i < 350; ++i) {
    low = std::min(low, wheel.stack().rings()[i].outer_mm());
    high = std::max(high, wheel.stack().rings()[i].outer_mm());
  }
  return high - low;
}

TEST(Sponge, SmoothsAndRemovesNothing) {
  SceneSpec scene = scene_with(ToolMode::smooth);
  scene.tool.shape = RibSpec{40.0, 8.0};
  Wheel wheel = Wheel::build(scene, waved_pot(scene)).value();
  const double before = waves_mm(wheel);
  const auto bore = [&] {
    std::vector<Quanta> radii;
    for (const Ring& ring : wheel.stack().rings()) radii.push_back(ring.inner2);
    return radii;
  };
  const auto bore_before = bore();
  const WideQuanta clay = wheel.stack().volume();
  std::int64_t time_us = 0;
  move(wheel, time_us, {54, 60, 0}, {52.8, 60, 0}, 500);
  move(wheel, time_us, {52.8, 60, 0}, {52.8, 62, 0}, 2500);
  EXPECT_LT(waves_mm(wheel), 0.4 * before);
  EXPECT_EQ(bore(), bore_before);
  EXPECT_EQ(wheel.stack().volume(), clay);
  EXPECT_EQ(wheel.stack().size(), 600u);
  expect_balanced(wheel);
}

TEST(Sponge, NeedsClayRules) {
  SceneSpec scene = scene_with(ToolMode::smooth);
  scene.clay.reset();
  const auto wheel = Wheel::build(scene);
  ASSERT_FALSE(wheel.has_value());
  EXPECT_EQ(wheel.error().kind, ErrorKind::bad_input);
}

/// The overlap energy of a sponge at rest only falls.
TEST(Sponge, NeverPushesTheHand) {
  for (const bool follows : {false, true}) {
    SceneSpec scene = scene_with(ToolMode::smooth);
    scene.clay->sponge_follows = follows;
    scene.tool.shape = RibSpec{40.0, 8.0};
    Wheel wheel = Wheel::build(scene, waved_pot(scene)).value();
    std::int64_t time_us = 0;
    move(wheel, time_us, {54, 60, 0}, {52.8, 60, 0}, 200);
    double last = 1e300;
    for (int k = 0; k < 500; ++k) {
      double energy = 0.0;
      for (const Ring& ring : wheel.stack().rings().subspan(200, 200)) {
        const double depth = std::max(ring.outer_mm() + 8.0 - 52.8, 0.0);
        energy += depth * depth;
      }
      EXPECT_LE(energy, last + 1e-12) << follows;
      last = energy;
      wheel.step({time_us += 1000, {52.8, 60, 0}, false});
    }
  }
}

}  // namespace
}  // namespace clay
