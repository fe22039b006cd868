// The positions of the two tools of a pinch, and the force.

#include "claystack/engine/wheel.hpp"
#include "engine/tick/contact.hpp"
#include "tests/engine/clay/stack_samples.hpp"
#include "tests/engine/tick/contact_samples.hpp"
#include "tests/engine/tick/pinch_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

using samples::kToolMm;
using samples::pinch_at;
using samples::tube_scene;

struct Pinch {
  Contact outer, inner;
};

Pinch pinch_of(const Tool& tool, const ClayStack& stack, glm::dvec3 hip, double gap_mm) {
  Pinch pinch;
  find_pinch(tool, stack, hip, gap_mm, pinch.outer, pinch.inner);
  return pinch;
}

RC_GTEST_PROP(PinchContact, PutsEachToolOnItsSideOfTheGap, ()) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(1, 60);
  const double h = *rc::gen::element(0.1, 1.0, 7.0);
  const ClayStack stack = samples::stack(random, count, h);
  const double size = 1.0 + 30.0 * samples::uniform(random);
  const double gap = 10.0 * samples::uniform(random);
  const glm::dvec3 hip(80.0 * samples::uniform(random),
                       stack.height_mm() * (2.0 * samples::uniform(random) - 0.5),
                       20.0 * samples::uniform(random));
  const auto [outer, inner] = pinch_of(Tool::build(SphereSpec{size}).value(), stack, hip, gap);
  const auto outer_rings = samples::touched(outer), inner_rings = samples::touched(inner);

  const double d = std::hypot(hip.x, hip.z);
  std::size_t out = 0, in = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = (static_cast<double>(i) + 0.5) * h - hip.y;
    if (std::abs(t) > size) continue;
    // The middle of the covered part of the ring.
    const double covered = 0.5 * (std::max(t - 0.5 * h, -size) + std::min(t + 0.5 * h, size));
    const double f = std::sqrt(size * size - covered * covered);
    // Distance from the axis to the side of each tool that faces the clay. An inner tool beyond the
    // axis touches with its far side.
    const double surface_out = d + gap / 2 + (size - f);
    const double surface_in = std::abs(d - gap / 2 - size) + f;
    const double from_out = stack.rings()[i].outer_mm() - surface_out;
    const double from_in = surface_in - stack.rings()[i].inner_mm();
    // No contact: the outer tool is in the bore, or the inner tool is outside.
    const double past_bore = d + gap / 2 + size + f - stack.rings()[i].inner_mm();
    const double past_outside = stack.rings()[i].outer_mm() - (surface_in - 2.0 * f);
    RC_PRE(std::abs(past_bore) > 1e-9 && std::abs(past_outside) > 1e-9);
    if (from_out > 1e-9 && past_bore > 0.0) {
      RC_ASSERT(out < outer_rings.size());
      RC_ASSERT(outer_rings[out].ring == i);
      RC_ASSERT(std::abs(outer_rings[out++].depth_mm - from_out) < 1e-7);
    }
    if (from_in > 1e-9 && past_outside > 0.0) {
      RC_ASSERT(in < inner_rings.size());
      RC_ASSERT(inner_rings[in].ring == i);
      RC_ASSERT(std::abs(inner_rings[in++].depth_mm - from_in) < 1e-7);
    }
  }
  RC_ASSERT(out == outer_rings.size() && in == inner_rings.size());
  if (out + in == 0) return;
  RC_ASSERT(outer.side == Side::compressive && inner.side == Side::expansive);
  RC_ASSERT(outer.bottom == inner.bottom && outer.top == inner.top);
}

TEST(PinchContact, ToolWiderThanTheBoreIsBeyondTheAxis) {
  const Tool tool = Tool::build(SphereSpec{kToolMm}).value();
  const ClayStack stack = ClayStack::cylinder(100, 0.5, 10.0, 3.0, 100).value();
  // Its centre is at 5 - 2 - 8 = -5 mm, so it reaches 13 mm on the far side, 10 mm beyond the bore.
  const auto [outer, inner] = pinch_of(tool, stack, {3.0, 25.25, -4.0}, 4.0);
  EXPECT_DOUBLE_EQ(inner.axis_distance_mm, 5.0);
  EXPECT_DOUBLE_EQ(inner.radial_x, -0.6);
  EXPECT_DOUBLE_EQ(inner.radial_z, 0.8);
  EXPECT_DOUBLE_EQ(outer.radial_x, 0.6);
  const auto deepest = std::ranges::max(samples::touched(inner), {}, &RingContact::depth_mm);
  EXPECT_DOUBLE_EQ(deepest.depth_mm, 10.0);
}

TEST(PinchContact, HasNoDirectionOnTheAxis) {
  const Tool tool = Tool::build(SphereSpec{kToolMm}).value();
  const ClayStack stack = ClayStack::cylinder(100, 0.5, 20.0, 3.0, 100).value();
  const auto [outer, inner] = pinch_of(tool, stack, {0, 25, 0}, 4.0);
  for (const Contact& contact : {outer, inner}) {
    EXPECT_FALSE(contact.rings.empty());
    EXPECT_EQ(contact.axis_distance_mm, 10.0);
    EXPECT_EQ(contact.radial_x, 0.0);
    EXPECT_EQ(contact.radial_z, 0.0);
  }
}

/// E_out + E_in of a tube from its geometry: the integral over the height of the squared depth
/// along the normal of the ball, by the midpoint rule with slices far thinner than a ring.
double energy(const SceneSpec& scene, glm::dvec3 hip, double gap_mm) {
  const LumpSpec& lump = scene.lump;
  const double d = std::hypot(hip.x, hip.z), reach = gap_mm / 2 + kToolMm;
  double sum = 0.0;
  constexpr std::size_t kSlices = 200;  // of a ring
  const double slice = lump.ring_height_mm / kSlices;
  for (std::size_t i = 0; i < lump.rings * kSlices; ++i) {
    const double t = (static_cast<double>(i) + 0.5) * slice - hip.y;
    if (std::abs(t) > kToolMm) continue;
    const double f = std::sqrt(kToolMm * kToolMm - t * t);
    const double from_out = std::max(0.0, lump.outer_radius_mm + f - (d + reach));
    const double from_in = std::max(0.0, std::abs(d - reach) + f - lump.inner_radius_mm);
    const double cosine = f / kToolMm;
    sum += (from_out * from_out + from_in * from_in) * cosine * cosine;
  }
  return 0.5 * scene.force->stiffness_n_per_mm2 * slice * sum;
}

/// The initial force, before any clay has moved.
glm::dvec3 force_at(const SceneSpec& scene, glm::dvec3 hip, double gap_mm) {
  return Wheel::build(scene).value().step(pinch_at(0, hip, gap_mm)).force_n();
}

TEST(PinchForce, EqualsMinusTheGradientOfBothOverlapEnergies) {
  SceneSpec scene = tube_scene(50.0, 40.0);
  scene.force->stiffness_n_per_mm2 = 0.002;
  SceneSpec narrow = tube_scene(16.0, 4.0);  // its bore is narrower than the tool
  narrow.force = scene.force;
  for (const auto& [tube, d] : {std::pair{scene, 45.0},
                                {scene, 46.3},
                                {scene, 43.0},
                                {scene, 51.0},
                                {narrow, 9.0},
                                {narrow, 11.5}})
    for (const double angle : {0.0, 1.0, 2.5, 4.0})
      for (const double y : {25.1, 49.3, 0.2}) {
        const glm::dvec3 hip(d * std::cos(angle), y, d * std::sin(angle));
        const glm::dvec3 force = force_at(tube, hip, 4.0);
        ASSERT_LT(glm::length(force), 5.0);
        for (int axis = 0; axis < 3; ++axis) {
          const double step = 1e-6;
          glm::dvec3 plus = hip, minus = hip;
          plus[axis] += step;
          minus[axis] -= step;
          const double slope = (energy(tube, plus, 4.0) - energy(tube, minus, 4.0)) / (2 * step);
          // The rings are coarser than the slices, which gives a few per cent for a grazing contact
          // and for the unbounded f' of a pole in the clay.
          EXPECT_NEAR(force[axis], -slope, 0.03 * glm::length(force) + 1e-5)
              << axis << " at " << d << ", " << y;
        }
      }
}

TEST(PinchForce, RadialPartsCancelInTheMiddleOfAWall) {
  SceneSpec scene = tube_scene(50.0, 40.0);
  const auto force = [&](double d) { return force_at(scene, {d, 25.0, 0.0}, 4.0); };
  EXPECT_NEAR(glm::length(force(45.0)), 0.0, 1e-12);
  EXPECT_LT(force(45.5).x, -0.1);  // towards the middle
  EXPECT_GT(force(44.5).x, 0.1);
}

TEST(PinchForce, FrictionOfBothToolsAddsUp) {
  SceneSpec scene = tube_scene(50.0, 40.0);
  scene.force->stiffness_n_per_mm2 = 0.004;
  const auto alone = [&](double outer_mm, double inner_mm) {
    SceneSpec tube = scene;
    tube.lump.outer_radius_mm = outer_mm;
    tube.lump.inner_radius_mm = inner_mm;
    return std::abs(force_at(tube, {45.0, 25.0, 0.0}, 4.0).x);
  };
  // Thinner tubes that only one tool touches, at the same depth as in the whole wall.
  const double springs = alone(50.0, 43.5) + alone(46.5, 40.0);
  scene.force->friction = 0.3;
  const glm::dvec3 force = force_at(scene, {45.0, 25.0, 0.0}, 4.0);
  EXPECT_GT(springs, 0.1);
  EXPECT_NEAR(glm::distance(force, glm::dvec3(0.0, 0.0, -0.3 * springs)), 0.0, 1e-12);
}

}  // namespace
}  // namespace clay
