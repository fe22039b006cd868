#include "claystack/engine/clay.hpp"
#include "claystack/engine/wheel.hpp"
#include "tests/engine/clay/stack_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace clay {
namespace {

using samples::scene_of;

SceneSpec arbitrary_scene() {
  SceneSpec scene = scene_of(*rc::gen::element(Model::conserving, Model::paper));
  scene.lump.inner_radius_mm = *rc::gen::element(0.0, 0.5, 20.0);
  scene.lump.max_rings = *rc::gen::element<std::size_t>(0, 42, 120);
  if (*rc::gen::arbitrary<bool>()) scene.stability = StabilitySpec{*rc::gen::element(1.2, 5.0)};
  scene.tool.mode = *rc::gen::element(ToolMode::press, ToolMode::press, ToolMode::trim);
  return scene;
}

constexpr glm::dvec3 kFree{90.0, 10.0, 0.0};  // clear of the clay for all these tools

/// From free air to the clay, some motion, and back.
std::vector<Pose> arbitrary_stroke(std::int64_t time_us) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * samples::uniform(random);
  };
  std::vector<Pose> poses;
  glm::dvec3 at = kFree;
  const auto move_to = [&](glm::dvec3 goal, double seconds) {
    const int ticks = static_cast<int>(seconds * 1000.0);
    const glm::dvec3 step = (goal - at) / static_cast<double>(ticks);
    for (int i = 0; i < ticks; ++i) {
      at += step;
      poses.push_back({time_us += 1000, at, false, 0.0});
    }
  };
  poses.push_back({time_us, kFree, false, 0.0});
  // The first motion is up or down, so that no stroke inherits the previous direction.
  move_to({90.0, uniform(0.0, 50.0), 0.0}, 0.05);
  const int places = *rc::gen::inRange(1, 4);
  move_to({uniform(34.0, 45.0), at.y, 0.0}, 0.05);
  for (int i = 0; i < places; ++i) move_to({uniform(0.0, 40.0), uniform(0.0, 60.0), 0.0}, 0.25);
  move_to({at.x, 90.0, 0.0}, 0.1);
  move_to({90.0, 90.0, 0.0}, 0.05);
  move_to(kFree, 0.05);
  return poses;
}

/// Returns whether the tool touches clay at the end.
bool play(Wheel& wheel, const std::vector<Pose>& poses) {
  std::uint32_t flags = 0;
  for (const Pose& pose : poses) flags = wheel.step(pose).flags;
  return (flags & kContact) != 0;
}

RC_GTEST_PROP(ContinuedThrow, GivesTheSameBitsAsAnUninterruptedThrow, ()) {
  const SceneSpec scene = arbitrary_scene();
  auto built = Wheel::build(scene);
  RC_PRE(built.has_value());
  Wheel& whole = *built;
  std::optional<Pot> before;
  std::int64_t time_us = 0;
  for (int stroke = 0; stroke < 3; ++stroke) {
    const auto poses = arbitrary_stroke(time_us);
    const bool touches = play(whole, poses);
    time_us = poses.back().time_us + 1000;
    auto part = before ? Wheel::build(scene, *before) : Wheel::build(scene);
    RC_ASSERT(part.has_value());
    play(*part, poses);
    RC_ASSERT(part->pot() == whole.pot());
    RC_ASSERT(part->ledger().imbalance(part->stack().recount()) == 0);
    // A wide flange can reach kFree; then the next stroke would start in the clay.
    if (whole.collapsed() || touches) return;
    before = part->pot();
  }
  RC_CLASSIFY(whole.stack().size() > scene.lump.rings, "grew");
}

/// A ring that grows from a leaning crown depends on the state of the rim, which is not part of the
/// rings.
TEST(ContinuedThrow, KeepsALeaningRim) {
  const SceneSpec scene = scene_of(Model::conserving);
  const auto poses = [](double x) {
    std::vector<Pose> stroke = {{0, {90.0, 38.0, 0.0}, false, 0.0}};
    for (int i = 1; i <= 500; ++i)
      stroke.push_back({1000 * i, {x, 27.0 + 0.007 * i, 0.0}, false, 0.0});
    stroke.push_back({600'000, {90.0, 38.0, 0.0}, false, 0.0});
    return stroke;
  };
  Wheel wheel = Wheel::build(scene).value();
  play(wheel, poses(36.5));
  const Pot leaning = wheel.pot();
  EXPECT_NE(leaning.rim, Rim{});
  Pot level = leaning;
  level.rim = {};
  const auto continued = [&](const Pot& pot) {
    Wheel next = Wheel::build(scene, pot).value();
    for (int i = 0; i < 10; ++i) {
      play(next, poses(34.0 - 0.5 * i));
      next = Wheel::build(scene, next.pot()).value();
    }
    return next.pot();
  };
  EXPECT_GT(continued(leaning).stack.size(), leaning.stack.size());
  EXPECT_NE(continued(leaning).stack, continued(level).stack);
}

TEST(ContinuedThrow, LumpAsAPotEqualsTheLump) {
  for (const Model model : {Model::conserving, Model::paper})
    for (const std::size_t max_rings : {std::size_t{0}, std::size_t{100}}) {
      SceneSpec scene = scene_of(model);
      scene.lump.max_rings = max_rings;
      const Pot lump = Wheel::build(scene).value().pot();
      const Wheel again = Wheel::build(scene, lump).value();
      EXPECT_EQ(again.pot(), lump);
      EXPECT_EQ(again.stack().max_rings(), max_rings == 0 ? 160u : max_rings);
    }
}

TEST(ContinuedThrow, APotRemembersTheSettingsOfTheLastStroke) {
  const SceneSpec scene = scene_of(Model::conserving);
  Wheel lump = Wheel::build(scene).value();
  EXPECT_EQ(lump.pot().thrown_with, settings_of(scene));
  lump.step({1000, kFree, false, 0.0});
  SceneSpec other = scene;
  other.tool.shape = SphereSpec{7.0};
  Wheel wheel = Wheel::build(other, lump.pot()).value();
  EXPECT_EQ(wheel.pot().thrown_with, settings_of(scene));  // no stroke yet
  wheel.step({1000, kFree, false, 0.0});
  EXPECT_EQ(wheel.pot().thrown_with, settings_of(other));
  Pot drawn = lump.pot();
  drawn.thrown_with.reset();
  Wheel of_drawing = Wheel::build(scene, drawn).value();
  EXPECT_FALSE(of_drawing.pot().thrown_with);
  of_drawing.step({1000, kFree, false, 0.0});
  EXPECT_EQ(of_drawing.pot().thrown_with, settings_of(scene));
}

TEST(ContinuedThrow, APotRemembersItsShapingToolWhileNeedleAndWireCutIt) {
  SceneSpec scene = scene_of(Model::conserving);
  scene.tool.shape = SphereSpec{7.0};
  const auto stroke = [&](const Pot& on, ToolMode mode, double radius_mm) {
    SceneSpec next = scene;
    next.tool.shape = SphereSpec{radius_mm};
    next.tool.mode = mode;
    Wheel wheel = Wheel::build(next, on).value();
    EXPECT_EQ(wheel.pot(), on);  // no stroke yet
    wheel.step({1000, kFree, false, 0.0});
    return wheel.pot();
  };
  const Pot lump = Wheel::build(scene).value().pot();
  EXPECT_FALSE(stroke(lump, ToolMode::press, 7.0).shaped_with);
  const Pot levelled = stroke(lump, ToolMode::needle, 0.5);
  EXPECT_EQ(levelled.shaped_with, scene.tool);
  EXPECT_EQ(stroke(levelled, ToolMode::wire, 0.5).shaped_with, scene.tool);
  EXPECT_FALSE(stroke(levelled, ToolMode::trim, 3.0).shaped_with);
}

TEST(ContinuedThrow, UsesTheRingsOfThePot) {
  Pot pot = Wheel::build(scene_of(Model::conserving)).value().pot();
  SceneSpec other = scene_of(Model::conserving);
  other.lump = {.rings = 7,
                .ring_height_mm = 3.0,
                .outer_radius_mm = 10.0,
                .inner_radius_mm = 2.0,
                .max_rings = 0,
                .density_g_cm3 = 1.9};
  const Wheel wheel = Wheel::build(other, pot).value();
  EXPECT_EQ(wheel.pot(), pot);
  // 0.05 N per mm of depth and mm of height, for rings of 1 mm.
  EXPECT_DOUBLE_EQ(wheel.plan().force.stiffness_n_per_mm, 0.05);
}

TEST(ContinuedThrow, RefusesAPotThatDoesNotFitTheScene) {
  const SceneSpec scene = scene_of(Model::conserving);
  const Pot pot = Wheel::build(scene).value().pot();
  const auto refused = [&](const SceneSpec& on, const Pot& start, const std::string& message) {
    const auto wheel = Wheel::build(on, start);
    ASSERT_FALSE(wheel) << message;
    EXPECT_EQ(wheel.error().kind, ErrorKind::bad_input);
    EXPECT_EQ(wheel.error().message, message);
  };
  refused(scene_of(Model::paper), pot, "model: expected the pot's, conserving, found paper");
  SceneSpec other = scene;
  other.lump.density_g_cm3 = 2.5;
  refused(other, pot, "lump.density_g_cm3: expected the pot's, 1.9, found 2.5");
  other = scene;
  other.lump.max_rings = 39;
  refused(other, pot, "lump.max_rings: expected 0 or at least the pot's rings, 40, found 39");
  Pot fallen = pot;
  fallen.collapse = Collapse{};
  refused(scene, fallen, "pot: expected a standing pot, found a collapsed one");
  refused(scene, rounded_pot(pot, 0.001).value(),
          "pot: expected an exact one, found one rounded to 0.001 mm: its clay is not the clay "
          "that was counted");
  other = scene;
  other.stability = StabilitySpec{0.1};
  const auto heavy = Wheel::build(other, pot);
  ASSERT_FALSE(heavy);
  const std::string& message = heavy.error().message;
  EXPECT_EQ(message.find("stability.max_stress_kpa: expected more than "), 0u) << message;
  EXPECT_NE(message.find(", the stress under the pot's own weight at ring 0, found 0.1"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace clay
