// A sponge that follows the slope of the surface (`ClaySpec::sponge_follows`).

#include "claystack/engine/wheel.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

namespace clay::sponge {
namespace {

using Profile = std::function<double(double)>;

constexpr double kPotMm = 80.0, kWallMm = 6.0, kBallMm = 10.0, kLow = 20.0, kHigh = 70.0;

SceneSpec sponge_scene(bool follows) {
  SceneSpec scene = cylinder_scene({.sponge_follows = follows});
  scene.tool = {SphereSpec{kBallMm}, ToolMode::smooth, {}};
  scene.removal = {20.0, 2.0, 2.0, {}};
  return scene;
}

Wheel pot_with(const SceneSpec& scene, const Profile& outer) {
  return wheel_with(scene, kPotMm, outer, [&](double up) { return outer(up) - kWallMm; });
}

double cone(double up) { return 40.0 + 0.5 * up; }
/// Its slope changes by 0.6 over the pot.
double bellied(double up) { return 50.0 - (up - 45.0) * (up - 45.0) / 250.0; }

/// The largest distance of a surface from a profile, between 20 and 70 mm.
double distance_from(const Wheel& wheel, const Profile& profile, bool inside = false) {
  double most = 0.0;
  for (double up = kLow + 0.5 * kH; up < kHigh; up += kH) {
    const Ring& ring = ring_at(wheel, up);
    most = std::max(most, std::abs((inside ? ring.inner_mm() : ring.outer_mm()) - profile(up)));
  }
  return most;
}

/// The sponge stays at the middle of the pot, 2 mm deep, on a surface of this radius.
void hold(Wheel& wheel, double radius_mm, bool inside = false, int ms = 1500) {
  Hand hand(wheel);
  const double sign = inside ? -1.0 : 1.0, at = radius_mm + sign * (kBallMm - 2.0);
  hand.place_at(radius_mm + sign * (kBallMm + 2.0), 45.0);
  hand.move_to(at, 45.0, 20.0);
  for (int k = 0; k < ms; ++k) hand.move_to(at, 45.0, 1.0);
  expect_balanced(wheel);
}

/// The surface of a cone is a line, and that of the belly a parabola: the sponge rests on both.
TEST(SpongeFollows, LeavesASmoothSlopeAsItIs) {
  for (const Profile& profile : {Profile(cone), Profile(bellied)}) {
    Wheel follows = pot_with(sponge_scene(true), profile);
    hold(follows, profile(45.0));
    EXPECT_LT(distance_from(follows, profile), 1e-3);
  }
  Wheel levels = pot_with(sponge_scene(false), cone);
  hold(levels, cone(45.0));
  EXPECT_GT(distance_from(levels, cone), 1.0) << "a level window has ledges at its ends";
}

TEST(SpongeFollows, LeavesTheSlopeOfABoreAsItIs) {
  const auto bore = [](double up) { return cone(up) - kWallMm; };
  Wheel follows = pot_with(sponge_scene(true), cone), levels = pot_with(sponge_scene(false), cone);
  hold(follows, bore(45.0), true);
  hold(levels, bore(45.0), true);
  EXPECT_LT(distance_from(follows, bore, true), 1e-3);
  EXPECT_GT(distance_from(levels, bore, true), 1.0);
}

/// Ridges of 0.3 mm, 4 mm apart, on a cone: a window of the sponge has more than two of them.
TEST(SpongeFollows, SmoothsThrowingRidges) {
  const auto ridged = [](double up) {
    return cone(up) + 0.3 * std::sin(2.0 * std::numbers::pi * up / 4.0);
  };
  Wheel wheel = pot_with(sponge_scene(true), ridged);
  const WideQuanta clay = wheel.stack().volume();
  Hand hand(wheel);
  const double off = kBallMm - 1.5;
  hand.place_at(cone(10.0) + kBallMm + 2.0, 10.0);
  hand.move_to(cone(10.0) + off, 10.0, 20.0);
  hand.move_to(cone(78.0) + off, 78.0, 30.0);
  hand.move_to(cone(78.0) + off + 20.0, 78.0, 60.0);
  EXPECT_LT(distance_from(wheel, cone), 0.03);
  EXPECT_EQ(wheel.stack().volume(), clay);
  expect_balanced(wheel);
}

/// Rings by turns 0.1 mm wider and narrower. Here the sponge moves clay by two rings at once.
TEST(SpongeFollows, CouplesNeighbouringRings) {
  const auto zigzag = [](double up) {
    return 45.0 + (static_cast<int>(up / kH) % 2 == 0 ? 0.1 : -0.1);
  };
  const auto step_mm = [](const Wheel& wheel) {
    return std::abs(ring_at(wheel, 45.1).outer_mm() - ring_at(wheel, 45.3).outer_mm());
  };
  Wheel follows = pot_with(sponge_scene(true), zigzag),
        levels = pot_with(sponge_scene(false), zigzag);
  hold(follows, 45.0);
  hold(levels, 45.0);
  EXPECT_LT(step_mm(follows), 0.01);
  EXPECT_GT(step_mm(levels), 0.05);
}

/// A shoulder that bends by 40 degrees becomes round in half a second, and joins the wall at both
/// ends of the window.
TEST(SpongeFollows, JoinsTheWallAtTheEndsOfItsWindow) {
  const auto shoulder = [](double up) { return 50.0 - 0.84 * std::max(up - 45.0, 0.0); };
  const auto steepest_mm = [](const Wheel& wheel) {
    double most = 0.0;
    for (double up = kLow; up < kHigh; up += kH)
      most = std::max(most, std::abs(ring_at(wheel, up + 1.5 * kH).outer_mm() -
                                     ring_at(wheel, up + 0.5 * kH).outer_mm()));
    return most;
  };
  Wheel follows = pot_with(sponge_scene(true), shoulder),
        levels = pot_with(sponge_scene(false), shoulder);
  hold(follows, 50.0, false, 500);
  hold(levels, 50.0, false, 500);
  EXPECT_LT(steepest_mm(follows), 2.0 * 0.84 * kH);
  EXPECT_GT(steepest_mm(levels), 6.0 * 0.84 * kH);
}

}  // namespace
}  // namespace clay::sponge
