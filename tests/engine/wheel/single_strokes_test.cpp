// One careless stroke on a sound pot: it may dent the pot, and must not spoil it.

#include "claystack/engine/wheel.hpp"
#include "engine/tick/joints.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace clay::single_strokes {
namespace {

constexpr double kRingMm = 0.5, kBallMm = 10.0, kFloorMm = 8.0;
constexpr int kStrokes = 40;  // of each kind on each pot

struct Shape {
  std::string name;
  double height_mm, wall_mm;
  double (*outer_mm)(double up_mm);
};
const std::vector<Shape> kShapes{
    {"cylinder", 100.0, 8.0, [](double) { return 45.0; }},
    {"bowl", 60.0, 9.0, [](double up) { return 30.0 + 40.0 * std::sqrt(up / 60.0); }},
    {"belly", 100.0, 6.0,
     [](double up) { return 38.0 + 22.0 * std::sin(std::numbers::pi * up / 110.0); }},
    {"bottle", 110.0, 8.0,
     [](double up) { return std::clamp(45.0 - 1.7 * (up - 60.0), 25.0, 45.0); }},
    {"opened lump", 50.0, 20.0, [](double) { return 50.0; }},
};

Wheel pot_of(const Shape& shape) {
  SceneSpec scene = cylinder_scene({});
  scene.removal = {20.0, 2.0, 2.0, {}};
  scene.stability = StabilitySpec{15.0};
  scene.clay->thin_wall_yields = true;
  scene.clay->finger_mm = 90.0;
  scene.clay->floor_mm = kFloorMm - 1.0;
  return wheel_with(
      scene, shape.height_mm, shape.outer_mm,
      [&](double up) { return up < kFloorMm ? 0.0 : shape.outer_mm(up) - shape.wall_mm; }, kRingMm);
}

/// Whether the wheel still carries a pot in one piece whose bore is open from the floor up.
bool sound(const Wheel& wheel) {
  const auto rings = wheel.stack().rings();
  if (wheel.collapsed() || lowest_gap(rings, 0, rings.size() - 1)) return false;
  const auto above = static_cast<std::size_t>(kFloorMm / kRingMm) + 1;
  return std::ranges::all_of(rings.subspan(above), [](const Ring& r) { return r.inner2 > 0; });
}

/// From outside, or from inside: towards the wall, a few millimetres into it, along it by up to
/// 40 mm, and away.
void press(Hand& hand, const Shape& shape, bool from_inside, bench::Dice& dice) {
  const double up = dice.between(5.0, shape.height_mm - 2.0), along = dice.between(-40.0, 40.0);
  const double depth = dice.between(1.0, 6.0), astray = dice.between(-8.0, 8.0);
  const double speed = dice.between(15.0, 80.0);
  const double out = from_inside ? -1.0 : 1.0;
  const double surface = shape.outer_mm(up) - (from_inside ? shape.wall_mm : 0.0);
  const double in = std::max(surface + out * (kBallMm - depth), 0.0), away = out * 15.0;
  hand.place_at(std::max(in + away, 0.0), up);
  hand.move_to(in, up, speed);
  hand.move_to(std::max(in + astray, 0.0), up + along, speed);
  hand.move_to(std::max(in + astray + away, 0.0), up + along, speed);
}

/// Two tools close on the wall and go along it, 3 mm astray at most.
void pinch(Hand& hand, const Shape& shape, bench::Dice& dice) {
  const auto middle = [&](double up) {
    return shape.outer_mm(std::clamp(up, 10.0, shape.height_mm)) - 0.5 * shape.wall_mm;
  };
  constexpr int kParts = 20;
  const double up = dice.between(15.0, shape.height_mm - 2.0), along = dice.between(-40.0, 40.0);
  const double gap = dice.between(3.0, 10.0), astray = dice.between(-3.0, 3.0);
  const double speed = dice.between(15.0, 80.0);
  for (double open = 30.0; open > 0.0; open -= 0.1) hand.place_at(middle(up), up, gap + open);
  for (int k = 1; k <= kParts; ++k) {
    const double part = static_cast<double>(k) / kParts;
    const double at = std::clamp(up + part * along, 5.0, shape.height_mm + 20.0);
    hand.move_to(middle(at) + part * astray, at, speed, gap);
  }
}

/// Number of pots of each shape that a kind of stroke spoils.
template <class Stroke>
void expect_few_spoiled(int most, Stroke stroke) {
  for (const Shape& shape : kShapes) {
    int spoiled = 0;
    for (int k = 0; k < kStrokes; ++k) {
      bench::Dice dice(static_cast<std::uint64_t>(k) + 1);
      Wheel wheel = pot_of(shape);
      Hand hand(wheel);
      stroke(hand, shape, dice);
      spoiled += sound(wheel) ? 0 : 1;
      expect_balanced(wheel);
    }
    EXPECT_LE(spoiled, most) << shape.name << ", of " << kStrokes;
  }
}

TEST(SingleStrokes, APressFromOutsideSpoilsNoPot) {
  expect_few_spoiled(0, [](Hand& hand, const Shape& shape, bench::Dice& dice) {
    press(hand, shape, false, dice);
  });
}

/// A few go through the wall beside the floor.
TEST(SingleStrokes, APressFromInsideSpoilsFewPots) {
  expect_few_spoiled(
      2, [](Hand& hand, const Shape& shape, bench::Dice& dice) { press(hand, shape, true, dice); });
}

TEST(SingleStrokes, APinchSpoilsNoPot) { expect_few_spoiled(0, pinch); }

/// The largest step outside between neighbouring rings within 2 mm of a height [mm].
double step_outside(const Wheel& wheel, double up_mm) {
  const auto rings = wheel.stack().rings();
  const auto at = static_cast<std::size_t>(up_mm / kRingMm);
  double step = 0.0;
  for (std::size_t i = at - 4; i < at + 4; ++i)
    step = std::max(step, std::abs(rings[i + 1].outer_mm() - rings[i].outer_mm()));
  return step;
}

/// A ball presses a wall outside, near the top of its solid bottom, and goes down. Its own surface
/// rises by at most 0.67 mm from one ring to the next, where it leaves the clay.
TEST(SingleStrokes, APressBesideTheFloorLeavesNoStepOutside) {
  constexpr double kOuterMm = 50.0, kDepthMm = 4.0, kDownMm = 15.0;
  for (const double floor_mm : {20.0, 40.0, 60.0})
    for (const double wall_mm : {12.0, 20.0})
      for (const double below_mm : {0.0, 5.0, 10.0}) {
        Wheel wheel = wheel_with(
            cylinder_scene({}), 80.0, [](double) { return kOuterMm; },
            [&](double up) { return up < floor_mm ? 0.0 : kOuterMm - wall_mm; }, kRingMm);
        Hand hand(wheel);
        const double up = floor_mm - below_mm, in = kOuterMm + kBallMm - kDepthMm;
        hand.place_at(in + 10.0, up);
        hand.move_to(in, up, 30.0);
        hand.move_to(in, up - kDownMm, 30.0);
        hand.move_to(in + 15.0, up - kDownMm, 30.0);
        EXPECT_LE(step_outside(wheel, floor_mm), 1.0)
            << "floor " << floor_mm << " mm, wall " << wall_mm << " mm, from " << up << " mm";
      }
}

}  // namespace
}  // namespace clay::single_strokes
