// The force of a partly covered ring at the front of the tool.

#include "engine/tick/front.hpp"

#include "claystack/engine/wheel.hpp"
#include "engine/tick/force.hpp"
#include "tests/engine/clay/stack_samples.hpp"

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace clay {
namespace {

/// A ball of 10 mm radius that rises by 0.02 mm per millisecond into clay, 4 mm deep at its axis;
/// it leaves no clay behind.
class Front : public testing::TestWithParam<double> {
 protected:
  static constexpr double kRingMm = 0.2, kRise = 0.02, kDt = 0.001, kAxis = 46.0, kOuter = 50.0;
  StepPlan plan = [] {
    SceneSpec scene;
    scene.lump.ring_height_mm = kRingMm;
    scene.tool.shape = SphereSpec{10.0};
    return StepPlan::build(scene).value();
  }();

  Contact behind_end_at(double level_mm) {
    std::vector<Ring> rings;
    for (int i = 0; i < 200; ++i) {
      // The clay that the ball has left: down to the surface along its path.
      const double t = (i + 0.5) * kRingMm - (level_mm - 10.0);
      const double outer = t < 10.0 && t > 0.0 ? kAxis - std::sqrt(100.0 - t * t) : kOuter;
      rings.push_back({quanta_from_radius(outer), 0});
    }
    stack = ClayStack::from_rings(kRingMm, std::move(rings), 0).value();
    Contact contact;
    find_contact(plan.tool, stack, {kAxis, level_mm - 10.0, 0.0}, contact, {0.0, kRise, 0.0});
    measure_front(plan, stack, level_mm - 10.0, kDt, contact);
    return contact;
  }
  ClayStack stack = ClayStack::cylinder(1, 1, 1, 0, 1).value();
};

/// The exact integral behind the pole of the ball: the depth is 4 mm plus the radius of the ball
/// there, minus the yielded part, w (1 - exp(-kappa s / v)).
TEST_P(Front, ForceIsContinuousAsTheEndOfTheToolCrossesARing) {
  const Contact contact = behind_end_at(30.0 + GetParam() * kRingMm);
  double expected = 0.0;
  constexpr int kParts = 100'000;
  for (int k = 0; k < kParts; ++k) {
    const double s = (k + 0.5) * 1.0 / kParts, t = 10.0 - s, f = std::sqrt(100.0 - t * t);
    const double depth = 4.0 + f - kOuter * -std::expm1(-20.0 * s * kDt / kRise);
    if (depth < 0.0) break;
    // -dE/dy of (depth cos theta)^2 / 2, cos theta = f / 10.
    expected += (depth * f * f / 100.0 * (-t / f) - depth * depth * t / 100.0) / kParts;
  }
  double found = 0.0;
  for (const RingContact& piece : contact.front)
    found += piece.coverage * kRingMm * piece.depth_mm *
             (piece.facing.lean + 0.5 * piece.depth_mm * piece.facing.turn);
  ASSERT_TRUE(contact.has_front);
  EXPECT_NEAR(found, expected, 0.03 * std::abs(expected));
}
INSTANTIATE_TEST_SUITE_P(Places, Front, testing::Values(0.05, 0.3, 0.45, 0.55, 0.7, 0.95));

TEST_F(Front, IsAbsentForAToolAtRest) {
  behind_end_at(30.05);
  Contact contact;
  find_contact(plan.tool, stack, {kAxis, 20.05, 0.0}, contact);
  measure_front(plan, stack, 20.05, kDt, contact);
  EXPECT_FALSE(contact.has_front);
  // A partly covered ring has the depth of its neighbour.
  for (std::size_t k = 0; k < contact.edge_count; ++k) EXPECT_LT(contact.edges[k].depth_mm, 0.1);
}

/// Over the rim and back on another path, through clay that does not yield: the force is a
/// gradient, so it does no net work. Without the end term a rib injects 63 % of the work on its
/// path.
TEST(FlatEnds, DoNoWorkOverTheRim) {
  for (const ToolShapeSpec& shape :
       {ToolShapeSpec{RibSpec{20.0, 6.0}}, ToolShapeSpec{SampledSpec{{-8, 0, 9}, {3, 6, 2}}}})
    for (const double h : {2.0, 0.5}) {
      SceneSpec scene;
      scene.lump.rings = static_cast<std::size_t>(60.0 / h);
      scene.lump.ring_height_mm = h;
      scene.lump.outer_radius_mm = 40.0;
      scene.lump.inner_radius_mm = 30.0;
      scene.removal.rate_per_s = 0.0;
      scene.force->limit_n = 10.0;
      scene.tool.shape = shape;
      Wheel wheel = Wheel::build(scene).value();
      const std::vector<glm::dvec3> loop{{47, 75, 0}, {44, 75, 0}, {44, 55, 0},
                                         {45, 50, 0}, {47, 65, 0}, {47, 75, 0}};
      double work = 0.0, absolute_work = 0.0;
      std::int64_t time_us = 0;
      glm::dvec3 at = loop.front(), force = wheel.step({0, at, false, 0.0}).force_n();
      for (std::size_t k = 1; k < loop.size(); ++k)
        for (int i = 1; i <= 4000; ++i) {
          const glm::dvec3 next = glm::mix(loop[k - 1], loop[k], i / 4000.0);
          const glm::dvec3 now = wheel.step({time_us += 1000, next, false, 0.0}).force_n();
          const double step = 0.5 * glm::dot(force + now, next - at);
          work += step;
          absolute_work += std::abs(step);
          force = now;
          at = next;
        }
      EXPECT_GT(absolute_work, 1.0);
      // A ring counts once its middle is covered, so the error is proportional to the ring height.
      EXPECT_LT(std::abs(work), 0.02 * h * absolute_work) << h;
    }
}

/// A rib that stands in a wall of equal rings. Its ends lie on borders between rings, as exactly as
/// floating point permits: the force is that of a rib a little higher or lower.
TEST(FlatEnds, ForceDoesNotDependOnRoundingAtABorderOfRings) {
  constexpr double h = 0.335;
  SceneSpec scene;
  scene.lump.ring_height_mm = h;
  scene.lump.inner_radius_mm = 30.0;
  scene.tool.shape = RibSpec{12.0 * h, 6.0};
  const auto force_at = [&](double up_mm) {
    Wheel wheel = Wheel::build(scene).value();
    wheel.step({0, {49.0, up_mm, 0.0}, false, 0.0});
    return wheel.step({1000, {49.0, up_mm, 0.0}, false, 0.0}).force_n();
  };
  for (int border = 20; border < 100; ++border) {
    const double up_mm = border * h;
    EXPECT_NEAR(force_at(up_mm).y, force_at(up_mm + 1e-7).y, 1e-6) << border;
  }
}

/// A rib sinks into solid clay. -dE/dy of its lower end is K' depth^2 / 2, depth that of the end in
/// the clay below it: 4 + 6 mm, as no clay has yielded before the end comes.
TEST(FlatEnds, ForceOfALeadingEndDependsNeitherOnRingsNorOnSpeed) {
  for (const double h : {0.5, 0.125})
    for (const double speed_mm_s : {40.0, 80.0}) {
      SceneSpec scene;
      scene.lump.rings = static_cast<std::size_t>(50.0 / h);
      scene.lump.ring_height_mm = h;
      scene.tool.shape = RibSpec{20.0, 6.0};
      Wheel wheel = Wheel::build(scene).value();
      std::int64_t time_us = 0;
      for (double up = 60.5; up > 56.0; up -= 1e-3 * speed_mm_s) {
        const glm::dvec3 force =
            wheel.step({time_us += 1000, {4.0, up, 0.0}, false, 0.0}).force_n();
        if (up > 58.0) continue;  // the end is not yet one ring deep
        ASSERT_NEAR(force.y, 0.5 * scene.force->stiffness_n_per_mm2 * 100.0, 1e-6)
            << h << ' ' << speed_mm_s << ' ' << up;
      }
    }
}

/// Forces of a tool that sinks into solid clay with clay rules, at the speed and with the steps of
/// an encoder: from 6 mm below the rim on.
std::vector<glm::dvec3> sinking(const ToolShapeSpec& shape, double x_mm, double speed_mm_s,
                                double step_mm) {
  SceneSpec scene;
  scene.lump.rings = 200;
  scene.lump.ring_height_mm = 0.25;
  scene.tool.shape = shape;
  scene.clay = ClaySpec{};
  Wheel wheel = Wheel::build(scene).value();
  const double start_mm = 50.2 - wheel.plan().tool.low();
  const auto lasts = static_cast<int>(8.0 / speed_mm_s * 1000.0);
  std::vector<glm::dvec3> forces;
  for (int k = 0; k < lasts; ++k) {
    const double up = start_mm - 1e-3 * speed_mm_s * k;
    const Pose pose{1000 * (k + 1), {x_mm, std::round(up / step_mm) * step_mm, 0.0}, false, 0.0};
    const glm::dvec3 force = wheel.step(pose).force_n();
    if (up < start_mm - 6.2) forces.push_back(force);
  }
  return forces;
}

/// As above: K' depth^2 / 2 with a depth of 4 + 6 mm.
TEST(FlatEnds, ASlowRibIsFeltWithoutPulses) {
  for (const double speed_mm_s : {1.0, 4.0, 16.0, 64.0})
    for (const double step_mm : {0.001, 0.06, 0.1})
      for (const glm::dvec3& force : sinking(RibSpec{20.0, 6.0}, 4.0, speed_mm_s, step_mm))
        ASSERT_NEAR(force.y, 0.5 * ForceSpec{}.stiffness_n_per_mm2 * 100.0, 0.01)
            << speed_mm_s << ' ' << step_mm;
}

/// The front behind the tip of a ball has the mean speed of the hand, not that of an encoder's
/// step.
TEST_F(Front, HasNoPulsesFromStepsOfAnEncoder) {
  for (const double step_mm : {0.001, 0.06}) {
    const auto forces = sinking(SphereSpec{10.0}, 20.0, 4.0, step_mm);
    for (std::size_t k = 1; k < forces.size(); ++k)
      ASSERT_LT(glm::distance(forces[k], forces[k - 1]), 0.05) << step_mm;
  }
}

/// The hand's work on an end that moves at random, in clay of random depth, is never negative: the
/// end returns at most the energy that it took. The force is linear in the displacement of a step,
/// so its work is exact.
TEST(FlatEnds, NeverReturnMoreEnergyThanTheyTook) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int run = 0; run < 200; ++run) {
    FlatEnd end;
    double depth = 5.0, work = 0.0, most = 0.0;
    for (int k = 0; k < 2000; ++k) {
      depth = std::clamp(depth + 0.5 * (unit(random) - 0.5), 0.0, 10.0);
      end.advance(0.0, depth);
      const double before = end.pressed_mm, way = 2.0 * (unit(random) - 0.5);
      end.advance(way, depth);
      // Beyond half the depth the force is constant; beyond 0 there is none.
      const double elastic = end.pressed_mm - before;
      work += 0.5 * depth * (end.pressed_mm + before) * elastic;
      if (way > 0.0) work += 0.5 * depth * depth * (way - elastic);
      ASSERT_GE(work, -1e-9) << run << ' ' << k;
      most = std::max(most, work);
    }
    EXPECT_GT(most, 1.0);
  }
}

}  // namespace
}  // namespace clay
