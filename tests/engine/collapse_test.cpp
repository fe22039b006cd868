#include "collapse.hpp"

#include "stack_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace clay {
namespace {

struct Point {
  double x, y;
};
/// Right-handed turn in the plane (radial, y), about the pivot.
Point turned(Point p, Point pivot, double angle) {
  const double x = p.x - pivot.x, y = p.y - pivot.y;
  return {pivot.x + x * std::cos(angle) - y * std::sin(angle),
          pivot.y + x * std::sin(angle) + y * std::cos(angle)};
}

/// Lowest point of the fallen part, by turning both ends of every ring's section.
double lowest(const ClayStack& stack, std::size_t first, Point pivot, double angle) {
  double least = 1e300;
  for (std::size_t i = first; i < stack.size(); ++i)
    for (const double side : {-1.0, 1.0})
      for (const double level : {0.0, 1.0}) {
        const double y = stack.ring_height_mm() * (static_cast<double>(i) + level);
        least = std::min(least, turned({side * stack.rings()[i].outer_mm(), y}, pivot, angle).y);
      }
  return least;
}

RC_GTEST_PROP(Collapse, RestsOnTheWheelOrHangs, ()) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(2, 60);
  const ClayStack stack = samples::stack(random, count, 2.0);
  const auto failed = *rc::gen::inRange<std::size_t>(0, count - 1);
  const Point pivot{70.0 * samples::uniform(random),
                    2.0 * static_cast<double>(failed) + 4.0 * samples::uniform(random)};
  const Collapse fall = settle(stack, {failed, 1.0}, {pivot.x, pivot.y, 0.0});
  RC_ASSERT(fall.angle_rad >= 0.0 && fall.angle_rad <= std::numbers::pi);

  const double rest = lowest(stack, failed + 1, pivot, fall.angle_rad);
  RC_ASSERT(rest > -1e-9);
  // Height of the centre of mass: falls all the way.
  double mass = 0.0, moment = 0.0;
  for (std::size_t i = failed + 1; i < count; ++i) {
    mass += static_cast<double>(stack.rings()[i].volume());
    moment += static_cast<double>(stack.rings()[i].volume()) * (2.0 * static_cast<double>(i) + 1.0);
  }
  const auto com = [&](double angle) { return turned({0.0, moment / mass}, pivot, angle).y; };
  for (int k = 0; k < 20; ++k)
    RC_ASSERT(com(fall.angle_rad * k / 20) >= com(fall.angle_rad * (k + 1) / 20) - 1e-9);
  // And it stops for a reason: on the wheel, or at the lowest point of its arc.
  const bool on_wheel = std::abs(rest) < 1e-6;
  const bool hangs = com(fall.angle_rad + 1e-3) > com(fall.angle_rad) &&
                     com(fall.angle_rad - 1e-3) > com(fall.angle_rad);
  RC_ASSERT(on_wheel || hangs);
}

TEST(Collapse, TurnsAboutAHorizontalAxisAwayFromTheTool) {
  const ClayStack stack = ClayStack::cylinder(50, 2.0, 20.0, 0.0, 50).value();
  const Collapse fall = settle(stack, {10, 3.5}, {0.0, 22.0, 25.0});
  EXPECT_EQ(fall.failed_ring, 10u);
  EXPECT_EQ(fall.stress_kpa, 3.5);
  // The tool is at +z; a right-handed turn about -x carries the top from +y toward -z.
  EXPECT_NEAR(fall.axis.x, -1.0, 1e-15);
  EXPECT_NEAR(fall.axis.y, 0.0, 1e-15);
  EXPECT_NEAR(fall.axis.z, 0.0, 1e-15);
  EXPECT_GT(fall.angle_rad, 0.1);
}

TEST(Collapse, OnTheAxisAndAtTheTopItIsDefined) {
  const ClayStack stack = ClayStack::cylinder(50, 2.0, 20.0, 0.0, 50).value();
  const Collapse axis = settle(stack, {10, 1.0}, {0.0, 22.0, 0.0});
  EXPECT_TRUE(std::isfinite(axis.angle_rad));
  EXPECT_EQ(axis.axis, glm::dvec3(0, 0, 1));
  EXPECT_TRUE(std::isfinite(settle(stack, {49, 1.0}, {20.0, 99.0, 0.0}).angle_rad));
}

}  // namespace
}  // namespace clay
