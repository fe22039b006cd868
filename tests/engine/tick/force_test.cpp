#include "engine/tick/force.hpp"

#include "tests/engine/clay/stack_samples.hpp"
#include "tests/engine/tick/contact_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace clay {
namespace {

constexpr ForcePlan kForcePlan{
    .stiffness_n_per_mm = 0.04, .limit_n = 5.0, .friction = 0.3, .turn = 1.0};

Contact touch(const Tool& tool, const ClayStack& stack, glm::dvec3 hip) {
  Contact contact;
  find_contact(tool, stack, hip, contact);
  return contact;
}

// Rings so thin that the sum is the integral of the energy, even where f' is unbounded at a pole.
constexpr double kRingMm = 0.005;
constexpr ForcePlan kThinPlan{
    .stiffness_n_per_mm = 0.04 * kRingMm, .limit_n = 5.0, .friction = 0.3, .turn = 1.0};

/// f'^2 in the middle of a ring.
double ring_slope2(const Tool& tool, const ClayStack& stack, glm::dvec3 hip,
                   const RingContact& ring) {
  const double slope =
      tool.slope((static_cast<double>(ring.ring) + 0.5) * stack.ring_height_mm() - hip.y);
  return slope * slope;
}

double overlap_energy(const Tool& tool, const ClayStack& stack, glm::dvec3 hip) {
  double sum = 0.0;
  for (const RingContact& ring : samples::touched(touch(tool, stack, hip)))
    sum += ring.depth_mm * ring.depth_mm / (1.0 + ring_slope2(tool, stack, hip, ring));
  return 0.5 * kThinPlan.stiffness_n_per_mm * sum;
}

ClayStack vase() {
  std::vector<Ring> rings;
  for (int i = 0; i < 16000; ++i) {
    const double outer = 40.0 + 8.0 * std::sin(i * 0.07 * kRingMm);
    rings.push_back({quanta_from_radius(outer), quanta_from_radius(outer - 9.0)});
  }
  return ClayStack::from_rings(kRingMm, std::move(rings), 0).value();
}

class SpringForce : public testing::TestWithParam<ToolShapeSpec> {};

TEST_P(SpringForce, EqualsMinusTheGradientOfTheOverlapEnergy) {
  const Tool tool = Tool::build(GetParam()).value();
  const ClayStack stack = vase();
  for (const double angle : {0.0, 1.0, 2.5, 4.0}) {
    for (const bool outside : {true, false}) {
      const double f = tool.radius(0.0);
      const double d = outside ? 44.0 + f - 1.5 : 30.0 - f + 6.5;
      const glm::dvec3 hip(d * std::cos(angle), 35.37, d * std::sin(angle));
      const glm::dvec3 force = spring_force<Model::conserving>(kThinPlan, touch(tool, stack, hip));
      ASSERT_GT(glm::length(force), 0.05);
      for (int axis = 0; axis < 3; ++axis) {
        const double step = 1e-6;
        glm::dvec3 plus = hip, minus = hip;
        plus[axis] += step;
        minus[axis] -= step;
        const double slope =
            (overlap_energy(tool, stack, plus) - overlap_energy(tool, stack, minus)) / (2 * step);
        EXPECT_NEAR(force[axis], -slope, 0.005 * glm::length(force))
            << axis << " " << angle << outside;
      }
      // The force pushes the hand out of the clay: away from the axis outside, toward it inside.
      const double radial = (force.x * hip.x + force.z * hip.z) / d;
      EXPECT_EQ(radial > 0.0, outside);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Shapes, SpringForce,
                         testing::Values(ToolShapeSpec{SphereSpec{10}},
                                         ToolShapeSpec{EllipseSpec{14, 6}},
                                         ToolShapeSpec{SampledSpec{{-9, -3, 4, 9}, {1, 6, 7, 2}}}));

TEST(PaperForce, EqualsKTimesDepthAlongTheUnitNormal) {
  Contact contact;
  contact.radial_x = 0.6;
  contact.radial_z = 0.8;
  contact.rings.lay_out(0, 1);
  contact.rings.put(
      {.ring = 0, .depth_mm = 2.0, .slope = 0.75});  // tan phi = 3/4: cos phi = 0.8, sin phi = 0.6
  const auto outside = spring_force<Model::paper>(kForcePlan, contact);
  EXPECT_NEAR(outside.x, 0.04 * 2.0 * 0.8 * 0.6, 1e-15);
  EXPECT_NEAR(outside.y, 0.04 * 2.0 * 0.6, 1e-15);
  EXPECT_NEAR(outside.z, 0.04 * 2.0 * 0.8 * 0.8, 1e-15);
  contact.side = Side::expansive;
  const auto inside = spring_force<Model::paper>(kForcePlan, contact);
  EXPECT_NEAR(inside.x, -outside.x, 1e-15);
  EXPECT_NEAR(inside.y, outside.y, 1e-15);
}

TEST(Friction, EqualsMuTimesTheSpringForceAlongTheRotation) {
  Contact contact;
  contact.radial_x = 1.0;
  const glm::dvec3 spring(3.0, 4.0, 0.0);
  // A wheel turning counterclockwise seen from above (y toward the viewer) moves +x toward -z.
  EXPECT_NEAR(
      glm::distance(friction_force(kForcePlan, contact, spring), glm::dvec3(0, 0, -0.3 * 5.0)), 0,
      1e-15);
  ForcePlan clockwise = kForcePlan;
  clockwise.turn = -1.0;
  EXPECT_GT(friction_force(clockwise, contact, spring).z, 0.0);
}

TEST(Force, OnTheAxisIsFiniteAndHasNoRadialPart) {
  const Tool tool = Tool::build(SphereSpec{12}).value();
  const Contact contact = touch(tool, ClayStack::cylinder(50, 1.0, 40, 0, 50).value(), {0, 50, 0});
  ASSERT_FALSE(contact.rings.empty());
  const auto spring = spring_force<Model::conserving>(kForcePlan, contact);
  EXPECT_EQ(spring.x, 0.0);
  EXPECT_EQ(spring.z, 0.0);
  EXPECT_GT(spring.y, 0.0);  // pressed down into a lump, the hand is pushed up
  EXPECT_EQ(glm::length(friction_force(kForcePlan, contact, spring)), 0.0);
}

RC_GTEST_PROP(Force, RespectsTheLimitAndKeepsTheDirection, ()) {
  auto random = *samples::random_engine();
  const auto component = [&] {
    return std::pow(10.0, 12 * samples::uniform(random) - 4) *
           (samples::uniform(random) < 0.5 ? -1 : 1);
  };
  const glm::dvec3 spring(component(), component(), 0.0), friction(0.0, 0.0, component());
  const glm::dvec3 force = spring + friction;
  glm::dvec3 limited_spring = spring, limited_friction = friction;
  limit_sum(limited_spring, limited_friction, 5.0);
  const glm::dvec3 limited = limited_spring + limited_friction;
  RC_ASSERT(glm::length(limited) <= 5.0);
  RC_ASSERT(glm::length(glm::cross(limited, force)) <=
            1e-14 * glm::length(limited) * glm::length(force));
  RC_ASSERT(limited_spring.z == 0.0);
  RC_ASSERT(limited_friction.x == 0.0);
  if (glm::length(force) <= 5.0) RC_ASSERT(limited == force);
}

TEST(Force, NonFiniteForceBecomesZero) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double x : {std::nan(""), inf, 1.7e308}) {
    glm::dvec3 spring(x, x, 0.0), friction(0.0, 0.0, 1.0);
    limit_sum(spring, friction, 5.0);
    EXPECT_EQ(spring, glm::dvec3(0.0));
    EXPECT_EQ(friction, glm::dvec3(0.0));
  }
}

}  // namespace
}  // namespace clay
