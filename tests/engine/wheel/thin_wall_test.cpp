// A wall at its minimum that yields (`ClaySpec::thin_wall_yields`).

#include "claystack/engine/wheel.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace clay {
namespace {

constexpr double kWallMm = 5.0;  // of `cylinder_scene`

SceneSpec thin_scene(bool yields, double min_wall_mm = kWallMm) {
  SceneSpec scene = cylinder_scene({.thin_wall_yields = yields});
  scene.removal = {20.0, 2.0, min_wall_mm, {}};
  return scene;
}

/// A ball presses outward in the middle of the wall, as far as 6 mm beyond its bore.
Wheel bellied(const SceneSpec& scene) {
  Wheel wheel = Wheel::build(scene).value();
  Hand hand(wheel);
  hand.place_at(28.0, 60.0);
  hand.move_to(36.0, 60.0, 5.0);
  hand.move_to(36.0, 60.01, 0.02);
  return wheel;
}

/// By Pappus a wall of thickness w and middle radius m has the volume 2 pi m w a mm of height.
TEST(ThinWall, BendsOutwardKeepsItsThicknessAndSinks) {
  const Wheel stays = bellied(thin_scene(false)), bends = bellied(thin_scene(true));
  EXPECT_LT(ring_at(stays, 60.0).inner_mm(), 40.5);
  EXPECT_NEAR(ring_at(bends, 60.0).inner_mm(), 46.0, 0.2);
  double volume_mm3 = 0.0;
  for (const Ring& ring : bends.stack().rings()) {
    EXPECT_NEAR(wall_of(ring), kWallMm, 3e-3);
    EXPECT_GT(wall_of(ring), kWallMm - 4e-6);
    volume_mm3 += 2.0 * std::numbers::pi * middle_of(ring) * kWallMm * kH;
  }
  const double started_mm3 = std::numbers::pi * (45.0 * 45.0 - 40.0 * 40.0) * 120.0;
  EXPECT_NEAR(volume_mm3, started_mm3, 1e-3 * started_mm3);
  EXPECT_LT(bends.stack().height_mm(), 119.0);
  EXPECT_GT(bends.stack().height_mm(), 115.0);
  expect_balanced(bends);
}

/// r every 0.5 mm of a wall that a ball pushes out and draws up, in rings of this height.
std::vector<double> bent_bore(double ring_height_mm) {
  Wheel wheel = Wheel::build(in_rings_of(ring_height_mm, 120.0, thin_scene(true))).value();
  Hand hand(wheel);
  hand.place_at(28.0, 40.0);
  hand.move_to(36.0, 40.0, 20.0);
  hand.move_to(37.0, 90.0, 30.0);
  hand.move_to(20.0, 100.0, 50.0);
  std::vector<double> radii;
  for (double y = 0.25; y < 105.0; y += 0.5) radii.push_back(ring_at(wheel, y).inner_mm());
  return radii;
}

/// The result does not depend on the height of the rings, to first order.
TEST(ThinWall, BendsAlikeInRingsOfAnyHeight) {
  const double coarse = change_by_halving(0.4, bent_bore), fine = change_by_halving(0.2, bent_bore);
  EXPECT_LT(coarse, 0.03);
  EXPECT_LT(fine, 0.6 * coarse);
}

/// A wall that is thinner than the minimum from the start: no stroke thickens it.
TEST(ThinWall, AWallBelowTheMinimumKeepsWhatItHas) {
  SceneSpec scene = thin_scene(true);
  scene.lump.inner_radius_mm = 42.0;
  Wheel wheel = Wheel::build(scene).value();
  Hand hand(wheel);
  hand.place_at(28.0, 60.0);
  hand.move_to(35.0, 60.0, 5.0);
  EXPECT_GT(ring_at(wheel, 60.0).inner_mm(), 44.0);
  for (const Ring& ring : wheel.stack().rings()) EXPECT_NEAR(wall_of(ring), 3.0, 2e-3);
  expect_balanced(wheel);
}

/// With nothing above to take the clay from, the wall stays.
TEST(ThinWall, StaysWhereTheRimCannotSink) {
  SceneSpec scene = thin_scene(true);
  scene.lump.rings = scene.lump.max_rings = 1;
  scene.lump.ring_height_mm = 20.0;
  Wheel wheel = Wheel::build(scene).value();
  const Ring before = wheel.stack().rings().front();
  Hand hand(wheel);
  hand.place_at(28.0, 10.0);
  hand.move_to(36.0, 10.0, 5.0);
  EXPECT_EQ(wheel.stack().rings().front(), before);
  expect_balanced(wheel);
}

/// Without `shift` no wall bends, thin or not.
TEST(ThinWall, NeedsShiftToBend) {
  SceneSpec scene = thin_scene(true);
  scene.clay->shift = false;
  EXPECT_LT(ring_at(bellied(scene), 60.0).inner_mm(), 40.01);
}

/// Two tools go out by 8 mm with a wall that they cannot thin, in its middle and at its rim.
Wheel carried_out(const SceneSpec& scene, double up_mm) {
  Wheel wheel = Wheel::build(scene).value();
  Hand hand(wheel);
  hand.place_at(42.5, up_mm, kWallMm);
  hand.move_to(50.5, up_mm, 20.0, kWallMm);
  return wheel;
}

/// The wall comes along, also the rings where the tools are widest, and the rim sinks.
TEST(ThinWall, ComesAlongWithTwoToolsThatGoOut) {
  for (const double up : {60.0, 115.0}) {
    EXPECT_LT(ring_at(carried_out(thin_scene(false), up), up).inner_mm(), 40.01) << up;
    const Wheel wheel = carried_out(thin_scene(true), up);
    EXPECT_NEAR(middle_of(ring_at(wheel, up)), 50.5, 0.5) << up;
    double below = middle_of(wheel.stack().rings().front());
    for (const Ring& ring : wheel.stack().rings()) {
      EXPECT_LT(std::abs(middle_of(ring) - below), 2.0 * kH) << up;
      EXPECT_NEAR(wall_of(ring), kWallMm, 3e-3) << up;
      below = middle_of(ring);
    }
    EXPECT_LT(wheel.stack().height_mm(), 120.0) << up;
    expect_balanced(wheel);
  }
}

/// A wall of 7 mm whose rim is rounded on one side, down to 3 mm at the top.
Wheel half_rounded(const SceneSpec& scene, bool outside) {
  const auto off = [](double up) {
    const double from = std::max(up - 56.0, 0.0);
    return 4.0 - std::sqrt(std::max(16.0 - from * from, 0.0));
  };
  return wheel_with(
      scene, 60.0, [&](double up) { return 47.0 - (outside ? off(up) : 0.0); },
      [&](double up) { return 40.0 + (outside ? 0.0 : off(up)); });
}

/// Projection of the rim over the rings below it [mm], on the side that is cut.
double ledge_of(const Wheel& wheel, bool outside) {
  const auto rings = wheel.stack().rings();
  double ledge = 0.0;
  for (std::size_t i = rings.size() - 20; i + 1 < rings.size(); ++i)
    ledge = std::max(ledge, outside ? rings[i + 1].outer_mm() - rings[i].outer_mm()
                                    : rings[i].inner_mm() - rings[i + 1].inner_mm());
  return ledge;
}

/// A ball cuts the other side of the rim, as deep as the minimum wall leaves it.
TEST(ThinWall, ACutLeavesNoLedgeAtTheRim) {
  for (const bool outside : {false, true})
    for (const bool yields : {false, true}) {
      SceneSpec scene = thin_scene(yields, 3.0);
      scene.tool.mode = ToolMode::trim;
      Wheel wheel = half_rounded(scene, !outside);
      const double height = wheel.stack().height_mm();
      Hand hand(wheel);
      hand.place_at(outside ? 58.0 : 29.0, 66.0);
      hand.move_to(outside ? 51.0 : 36.0, 66.0, 5.0);
      hand.move_to(outside ? 44.0 : 43.0, 70.0, 5.0);
      if (yields) {
        EXPECT_LE(ledge_of(wheel, outside), kH + 1e-3) << outside;
        EXPECT_LT(wheel.stack().height_mm(), height);
        EXPECT_GT(wheel.stack().height_mm(), height - 4.0);
      } else {
        EXPECT_GT(ledge_of(wheel, outside), 2.0 * kH) << outside;
        EXPECT_EQ(wheel.stack().height_mm(), height);
      }
      for (const Ring& ring : wheel.stack().rings()) EXPECT_GT(wall_of(ring), 3.0 - 4e-6);
      expect_balanced(wheel);
    }
}

/// A tip of 3 mm by 1 mm on a wall of 7 mm goes as a whole, since the cutter cannot thin it; one of
/// 3 mm by 5 mm is a wall, and stays.
TEST(ThinWall, ACutTakesATipNoHigherThanItIsThick) {
  for (const double high : {1.0, 5.0}) {
    SceneSpec scene = thin_scene(true, 3.0);
    scene.tool.mode = ToolMode::trim;
    Wheel wheel = wheel_with(
        scene, 60.0, [&](double up) { return up > 60.0 - high ? 43.0 : 47.0; },
        [](double) { return 40.0; });
    Hand hand(wheel);
    hand.place_at(29.0, 56.0);
    hand.move_to(32.0, 56.0, 5.0);
    EXPECT_NEAR(wheel.stack().height_mm(), high == 1.0 ? 59.0 : 60.0, 1e-9);
    expect_balanced(wheel);
  }
}

/// The load of each ring is right after the cut: the pot falls after as many poses as a copy of it
/// that was put on the wheel.
TEST(ThinWall, AfterACutThePotFallsWhenItShould) {
  SceneSpec scene = thin_scene(true, 3.0);
  scene.tool.mode = ToolMode::trim;
  scene.stability = StabilitySpec{1.6};
  Wheel cut = wheel_with(
      scene, 60.0, [](double up) { return up > 58.0 ? 43.0 : 47.0; }, [](double) { return 40.0; });
  const std::size_t size = cut.stack().size();
  Hand hand(cut);
  hand.place_at(29.0, 56.0);
  hand.move_to(32.0, 56.0, 5.0);
  hand.move_to(29.0, 90.0, 100.0);
  hand.move_to(70.0, 90.0, 100.0);
  hand.move_to(70.0, 12.0, 100.0);
  ASSERT_EQ(cut.stack().size(), size - 10);
  Wheel again = Wheel::build(scene, cut.pot()).value();
  const auto poses_until_it_falls = [](Wheel& wheel) {
    int poses = 0;
    for (; !wheel.collapsed() && poses < 4000; ++poses)
      wheel.step({100'000'000 + 1000 * poses, {60.0 - 0.004 * poses, 12.0, 0.0}, false, 0.0});
    return poses;
  };
  const int poses = poses_until_it_falls(again);
  EXPECT_GT(poses, 1000);
  EXPECT_LT(poses, 4000);
  EXPECT_EQ(poses_until_it_falls(cut), poses);
}

/// The rim of a straight wall at its minimum is no ledge: a cutter does not lower it.
TEST(ThinWall, ACutSparesAStraightRim) {
  SceneSpec scene = thin_scene(true);
  scene.tool.mode = ToolMode::trim;
  Wheel wheel = Wheel::build(scene).value();
  Hand hand(wheel);
  hand.place_at(58.0, 112.0);
  hand.move_to(50.0, 112.0, 10.0);
  hand.move_to(50.0, 121.0, 10.0);
  EXPECT_EQ(wheel.stack(), Wheel::build(scene)->stack());
}

}  // namespace
}  // namespace clay
