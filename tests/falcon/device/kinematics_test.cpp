#include "tests/falcon/device/kinematics_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace clay::falcon {
namespace {

/// Change of the angles for a small displacement, by central differences: error of order 3.
glm::dvec3 angle_change(const Kinematics& device, const glm::dvec3& at, const glm::dvec3& step) {
  return device.inverse(at + 0.5 * step).value() - device.inverse(at - 0.5 * step).value();
}

struct Chain {
  double thigh, shin, parallelogram;
};

/// The end of a leg, from hip to grip, link by link.
glm::dvec3 end_of(const Geometry& g, int leg, const Chain& t) {
  const double phi = kLegDirectionsRad[leg];
  const glm::dvec3 along(std::cos(phi), std::sin(phi), 0.0),
      aside(-std::sin(phi), std::cos(phi), 0);
  const auto in_plane = [&](double angle) {
    return std::cos(angle) * along + std::sin(angle) * glm::dvec3(0, 0, 1);
  };
  return g.base_radial_mm * along + g.base_lateral_mm * aside + g.thigh_mm * in_plane(t.thigh) +
         g.shin_ends_mm * in_plane(t.shin) +
         g.shin_mm *
             (std::sin(t.parallelogram) * in_plane(t.shin) + std::cos(t.parallelogram) * aside) -
         g.grip_radial_mm * along - g.grip_lateral_mm * aside;
}

RC_GTEST_PROP(ThighAngle, InvertsTheChainOfLinks, ()) {
  const Geometry g = *rc::gen::element(0, 1) ? kLibnifalconGeometry : kMartinHillierGeometry;
  const int leg = *rc::gen::inRange(0, 3);
  const double thigh = within(-0.5, 1.8), elbow = within(0.2, 2.4);
  const glm::dvec3 end = end_of(g, leg, {thigh, thigh + elbow, within(0.3, kPi - 0.3)});
  const auto angle = Kinematics(g).thigh_angle(leg, end);
  RC_ASSERT(angle.has_value());
  RC_ASSERT(std::abs(std::remainder(*angle - thigh, 2 * kPi)) < 1e-9);
}

TEST(Inverse, NamesTheLegThatCannotReach) {
  const Kinematics device(kLibnifalconGeometry);
  const KinematicsError errors[] = {KinematicsError::top_leg_unreachable,
                                    KinematicsError::right_leg_unreachable,
                                    KinematicsError::left_leg_unreachable};
  for (int leg = 0; leg < 3; ++leg) {
    // Beyond the axis: out of reach of this leg, within reach of the others.
    const double phi = kLegDirectionsRad[leg];
    const glm::dvec3 far(-60.0 * std::cos(phi), -60.0 * std::sin(phi), 165.0);
    EXPECT_FALSE(device.thigh_angle(leg, far));
    EXPECT_TRUE(fails_with(device.inverse(far), errors[leg])) << leg;
    EXPECT_TRUE(fails_with(device.jacobian(far), errors[leg])) << leg;
    EXPECT_TRUE(fails_with(device.torques(far, {0, 0, 1}), errors[leg])) << leg;
  }
}

TEST(Inverse, RefusesFarAndInvalidPositions) {
  const Kinematics device(kLibnifalconGeometry);
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {300.0, -300.0, nan, inf, -inf, 1e300})
    for (const glm::dvec3& axis : kAxes)
      EXPECT_FALSE(device.inverse(glm::mix(kFalconCentreMm, glm::dvec3(bad), axis))) << bad;
}

TEST(Inverse, RefusesAFlatShin) {
  Geometry g = kLibnifalconGeometry;
  g.base_lateral_mm = 0.0;
  g.grip_lateral_mm = g.shin_mm;
  EXPECT_TRUE(
      fails_with(Kinematics(g).jacobian({0, 0, 60.0}), KinematicsError::top_leg_unreachable));
  g.grip_lateral_mm *= 0.999;
  EXPECT_TRUE(Kinematics(g).jacobian({0, 0, 60.0}));
}

TEST(Forward, AtCountZeroMatchesTheTriangles) {
  // On the axis all legs are equal: the height is a sin t1 plus a leg of the shin's right triangle.
  const auto height = [](const Geometry& g) {
    const double v = g.grip_lateral_mm - g.base_lateral_mm, u = g.grip_radial_mm - g.base_radial_mm;
    const double shin = g.shin_ends_mm + std::sqrt(g.shin_mm * g.shin_mm - v * v);
    const double base = u - g.thigh_mm * std::cos(g.zero_angle_rad);
    return g.thigh_mm * std::sin(g.zero_angle_rad) + std::sqrt(shin * shin - base * base);
  };
  EXPECT_NEAR(height(kLibnifalconGeometry), 134.6, 0.05);    // published for these sizes
  EXPECT_NEAR(height(kMartinHillierGeometry), 144.8, 0.05);  // by hand, same triangles
  for (const Geometry& g : {kLibnifalconGeometry, kMartinHillierGeometry}) {
    const Kinematics device(g);
    const glm::dvec3 position = device.forward(device.angles_of({0, 0, 0})).value();
    EXPECT_LT(glm::distance(position, {0, 0, height(g)}), 1e-11);
  }
}

RC_GTEST_PROP(Forward, InvertsInverseFromAColdStart, ()) {
  const Kinematics& device = any_device();
  const glm::dvec3 position = anywhere();
  const auto found = device.forward(device.inverse(position).value());
  RC_ASSERT(found.has_value());
  RC_ASSERT(glm::distance(*found, position) < 1e-11);
}

RC_GTEST_PROP(Forward, InvertsInverseFromAnyStartInTheWorkspace, ()) {
  const Kinematics& device = any_device();
  const glm::dvec3 position = anywhere();
  const auto found = device.forward(device.inverse(position).value(), anywhere());
  RC_ASSERT(found.has_value());
  RC_ASSERT(glm::distance(*found, position) < 1e-11);
}

// Far outside the ball, where a leg is nearly straight or the shins nearly flat.
RC_GTEST_PROP(Forward, FindsThePoseOfReachableCounts, ()) {
  const Kinematics device(kLibnifalconGeometry);
  const auto count = [] { return static_cast<std::int16_t>(within(-1500, 1500)); };
  const LegCounts counts = {count(), count(), count()};
  const auto back = device.forward(device.angles_of(counts))
                        .and_then([&](const glm::dvec3& p) { return device.inverse(p); })
                        .and_then([&](const glm::dvec3& a) { return device.counts_of(a); });
  RC_ASSERT(back == counts);
}

// Counts far out of reach, as encoders may read before homing, give a pose with these angles or an
// error. (If a leg is almost straight, a small motion changes its angle a lot.)
RC_GTEST_PROP(Forward, NeverReturnsAWrongPose, ()) {
  const Kinematics& device = any_device();
  const auto counts = *rc::gen::container<LegCounts>(rc::gen::arbitrary<std::int16_t>());
  const glm::dvec3 angles = device.angles_of(counts);
  const auto found = device.forward(angles, anywhere_within(100.0));
  if (fails_with(found, KinematicsError::not_converged)) return;
  const auto back = device.inverse(*found);
  RC_ASSERT(back.has_value());
  for (int leg = 0; leg < 3; ++leg)
    RC_ASSERT(std::abs(std::remainder((*back)[leg] - angles[leg], 2 * kPi)) < 1e-6);
}

TEST(Forward, ReportsAnglesWithoutAPose) {
  const Kinematics device(kLibnifalconGeometry);
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  // With all thighs straight down, the axis is on the inner side of each: no knee is outward.
  for (const glm::dvec3& angles :
       {glm::dvec3(-kPi / 2), glm::dvec3(nan, 0, 0), glm::dvec3(0, inf, 0)}) {
    EXPECT_TRUE(fails_with(device.forward(angles), KinematicsError::not_converged));
  }
  EXPECT_FALSE(device.forward(glm::dvec3(0.6), glm::dvec3(nan)));
  EXPECT_FALSE(device.forward(glm::dvec3(0.6), glm::dvec3(1000.0)));
}

TEST(Kinematics, NamesTheLegsAsTheUserSeesThem) {
  const auto& [top, right, left] = kLegDirectionsRad;
  EXPECT_GT(std::sin(top), 0.9);
  EXPECT_GT(std::cos(right), 0.9);
  EXPECT_LT(std::cos(left), -0.7);
}

RC_GTEST_PROP(Kinematics, RotatesWithItsLegs, ()) {
  const Kinematics& device = any_device();
  const glm::dvec3 p = anywhere(), angles = device.inverse(p).value();
  // A third of a turn clockwise maps each leg to the next.
  const double c = -0.5, s = -std::sqrt(0.75);
  const glm::dvec3 turned(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
  const glm::dvec3 expected(angles[2], angles[0], angles[1]);
  RC_ASSERT(glm::distance(device.inverse(turned).value(), expected) < 1e-13);
}

RC_GTEST_PROP(Jacobian, EqualsTheSlopeOfTheAngles, ()) {
  const Kinematics& device = any_device();
  const glm::dvec3 position = anywhere();
  const glm::dmat3 jacobian = device.jacobian(position).value();
  const double step = 1e-2;
  for (const glm::dvec3& axis : kAxes) {
    const glm::dvec3 slope = angle_change(device, position, step * axis) / step;
    RC_ASSERT(glm::distance(jacobian * axis, slope) < 1e-6 * glm::length(slope));
  }
}

// Central differences have an error of order 3; combining two, one twice as long, gives order 5.
RC_GTEST_PROP(Torques, DoTheWorkOfTheForce, ()) {
  const Kinematics& device = any_device();
  const glm::dvec3 position = anywhere(), force = any_vector(8.0), direction = any_vector(1.0);
  RC_PRE(glm::length(direction) > 0.1);
  const glm::dvec3 step = 2e-2 * glm::normalize(direction);
  const glm::dvec3 change =
      (8.0 * angle_change(device, position, 0.5 * step) - angle_change(device, position, step)) /
      3.0;
  const double work = glm::dot(device.torques(position, force).value(), change);
  RC_ASSERT(std::abs(work - glm::dot(force, step)) <= 1e-9 * glm::length(force) * 2e-2);
}

RC_GTEST_PROP(Torques, MatchTheMechanicalPower, ()) {
  const Kinematics& device = any_device();
  const glm::dvec3 position = anywhere(), force = any_vector(8.0), velocity = any_vector(1000.0);
  const glm::dvec3 torques = device.torques(position, force).value();
  const glm::dvec3 turning = device.jacobian(position).value() * velocity;
  RC_ASSERT(std::abs(glm::dot(torques, turning) - glm::dot(force, velocity)) <=
            1e-12 * (glm::length(torques) * glm::length(turning) + 1.0));
}

// The force of torques is J^T torques; J comes from numerical slopes of the angles.
RC_GTEST_PROP(Torques, PushInTheRequestedDirection, ()) {
  const Kinematics& device = any_device();
  const glm::dvec3 position = anywhere(), force = any_vector(8.0);
  RC_PRE(glm::length(force) > 1e-3);
  const glm::dvec3 torques = device.torques(position, force).value();
  glm::dvec3 produced(0.0);
  const double step = 1e-2;
  for (int axis = 0; axis < 3; ++axis)
    produced[axis] = glm::dot(torques, angle_change(device, position, step * kAxes[axis])) / step;
  const double sine =
      glm::length(glm::cross(produced, force)) / glm::length(produced) / glm::length(force);
  RC_ASSERT(glm::dot(produced, force) > 0.0);
  RC_ASSERT(std::asin(std::min(sine, 1.0)) < 0.01 * kPi / 180);
  RC_ASSERT(std::abs(glm::length(produced) / glm::length(force) - 1.0) < 1e-6);
}

// Rounding to whole counts turns the force slightly. Each torque is off by at most half a count;
// the forces of one count of each motor bound the effect.
RC_GTEST_PROP(Torques, InWholeCountsKeepTheDirectionWithinACount, ()) {
  const Kinematics& device = any_device();
  const glm::dvec3 position = anywhere(), force = any_vector(20.0);  // often above the limit
  const glm::dvec3 torques = device.torques(position, force).value();
  const LegCounts motors = motor_counts(torques);
  const double peak = std::max({std::abs(torques.x), std::abs(torques.y), std::abs(torques.z)});
  const double rendered = std::min(1.0, kMotorLimit / (kMotorCountsPerNmm * peak));
  const glm::dmat3 jacobian = device.jacobian(position).value();
  const auto force_of = [&jacobian](const glm::dvec3& counts) {
    return -1.0 / kMotorCountsPerNmm * counts * jacobian;
  };
  const glm::dvec3 produced = force_of({motors[0], motors[1], motors[2]});
  double bound = 1e-9;
  for (const glm::dvec3& motor : kAxes) bound += 0.5 * glm::length(force_of(motor));
  RC_ASSERT(glm::distance(produced, rendered * force) <= bound);
}

TEST(Torques, ReportALegWithFlatShins) {
  // A special device: on its axis at this height all shins are horizontal, and none can push along
  // z.
  Geometry g = kLibnifalconGeometry;
  const double thigh = kPi / 4;
  g.grip_lateral_mm = g.base_lateral_mm;
  g.grip_radial_mm = g.base_radial_mm + g.thigh_mm * std::cos(thigh) - g.shin_ends_mm - g.shin_mm;
  const Kinematics device(g);
  const glm::dvec3 position(0, 0, g.thigh_mm * std::sin(thigh));
  ASSERT_TRUE(device.jacobian(position));
  EXPECT_TRUE(fails_with(device.torques(position, {0, 0, 1}), KinematicsError::singular));
  EXPECT_TRUE(device.torques(position + glm::dvec3(0, 0, 1.0), {0, 0, 1}));
}

}  // namespace
}  // namespace clay::falcon
