// Counts: encoder readings, and motor commands.

#include "tests/falcon/device/kinematics_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

namespace clay::falcon {
namespace {

TEST(Encoder, HasTheResolutionOfWheelAndGear) {
  const Kinematics device(kLibnifalconGeometry);
  const glm::dvec3 one = device.angles_of({1, 1, 1}) - device.angles_of({0, 0, 0});
  EXPECT_NEAR(one.x, 6.359e-4, 5e-8);
  const glm::dvec3 turn = device.angles_of({9881, -9881, 0}) - device.angles_of({0, 0, 0});
  EXPECT_NEAR(turn.x, 2 * kPi, one.x);
  EXPECT_NEAR(turn.y, -2 * kPi, one.x);
  EXPECT_EQ(turn.z, 0.0);
}

RC_GTEST_PROP(Encoder, InvertsItsReading, ()) {
  const Kinematics& device = any_device();
  const auto counts = *rc::gen::container<LegCounts>(rc::gen::arbitrary<std::int16_t>());
  const glm::dvec3 angles = device.angles_of(counts);
  RC_ASSERT(device.counts_of(angles).value() == counts);
  const glm::dvec3 off = any_vector(0.49 * 6.359e-4);
  RC_ASSERT(device.counts_of(angles + off).value_or(counts) == counts);
}

TEST(Encoder, RefusesAnglesBeyondInt16) {
  const Kinematics device(kMartinHillierGeometry);
  EXPECT_TRUE(device.counts_of(device.angles_of({32767, -32768, 0})));
  for (const double bad : {30.0, -30.0, 1e300, std::nan("")}) {
    for (const glm::dvec3& axis : kAxes)
      EXPECT_TRUE(fails_with(device.counts_of(glm::mix(glm::dvec3(0.0), glm::dvec3(bad), axis)),
                             KinematicsError::beyond_encoder));
  }
}

RC_GTEST_PROP(Encoder, CoversTheWorkspaceWithin1600Counts, ()) {
  const Kinematics device(kLibnifalconGeometry);
  const auto counts = device.inverse(anywhere()).and_then([&](const glm::dvec3& angles) {
    return device.counts_of(angles);
  });
  for (const std::int16_t count : counts.value()) RC_ASSERT(std::abs(count) <= 1600);
}

TEST(MotorCounts, AreTheNegatedTorques) {
  EXPECT_EQ(motor_counts({100.0, -200.0, 0.26}, 10.0), (LegCounts{-1000, 2000, -3}));
  EXPECT_EQ(motor_counts({0.019835 * 7.62 * 100, 0, 0}), (LegCounts{-100, 0, 0}));
}

RC_GTEST_PROP(MotorCounts, KeepTheDirectionWhenAMotorSaturates, ()) {
  const glm::dvec3 torques = any_vector(5000.0);
  const double scale = 10.0;
  const LegCounts motors = motor_counts(torques, scale);
  const double peak = std::max({std::abs(torques.x), std::abs(torques.y), std::abs(torques.z)});
  const double rendered = 1.0 / std::max(1.0, peak * scale / 4095);
  for (int leg = 0; leg < 3; ++leg) {
    const int count = motors[static_cast<std::size_t>(leg)];
    RC_ASSERT(std::abs(count) <= kMotorLimit);
    RC_ASSERT(std::abs(count + rendered * scale * torques[leg]) <= 0.5 + 1e-9);
  }
}

TEST(MotorCounts, AreZeroForTorquesThatAreNotFinite) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e308}) {
    for (const glm::dvec3& axis : kAxes) {
      EXPECT_EQ(motor_counts(glm::mix(glm::dvec3(0.1), glm::dvec3(bad), axis)), LegCounts{});
    }
  }
  EXPECT_EQ(motor_counts({0, 0, 0}), LegCounts{});
}

// The motor scale was chosen to agree with Novint's figure, more than 2 lbf.
TEST(MotorCounts, GiveTheStatedForceInEveryDirection) {
  const Kinematics device(kLibnifalconGeometry);
  const auto max_newtons = [&](const glm::dvec3& direction) {
    const glm::dvec3 torques = device.torques({0, 0, 125.0}, direction).value();
    const double peak = std::max({std::abs(torques.x), std::abs(torques.y), std::abs(torques.z)});
    return kMotorLimit / (kMotorCountsPerNmm * peak);
  };
  double weakest = std::numeric_limits<double>::infinity();
  for (double polar = 0.0; polar <= kPi; polar += 0.05)
    for (double turn = 0.0; turn < 2 * kPi; turn += 0.05)
      weakest = std::min(weakest, max_newtons({std::sin(polar) * std::cos(turn),
                                               std::sin(polar) * std::sin(turn), std::cos(polar)}));
  EXPECT_NEAR(weakest, 9.2, 0.05);
  EXPECT_NEAR(max_newtons({0, 0, 1}), 24.5, 0.05);
}

}  // namespace
}  // namespace clay::falcon
