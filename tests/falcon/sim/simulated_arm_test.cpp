#include "claystack/falcon/sim.hpp"

#include "tests/falcon/random_values.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

namespace clay::falcon {
namespace {

ArmSettings undelayed(double rate_hz, double mass_kg, double damping) {
  ArmSettings arm;
  arm.loop = {rate_hz, mass_kg, damping, 0};
  return arm;
}

SimulatedArm built(const ArmSettings& arm, const HandSettings& hand = {},
                   const glm::dvec3& start = {}) {
  return SimulatedArm::build(arm, hand, start).value();
}

HandSettings guiding(double stiffness, double damping, double push = 0.0) {
  HandSettings hand;
  hand.stiffness_n_per_mm.x = stiffness;
  hand.damping_ns_per_mm.x = damping;
  hand.push_n.x = push;
  return hand;
}

RC_GTEST_PROP(SimulatedArm, MatchesADampedMassAtEveryRate, ()) {
  const double rate = within(100, 8000), mass_kg = within(0.1, 0.5), m = 1e-3 * mass_kg;
  const double b = within(1e-4, 0.02), force = within(-8.0, 8.0);
  SimulatedArm arm = built(undelayed(rate, mass_kg, b));
  for (int k = 1; k <= 50; ++k) {
    arm.advance({0.0, force, 0.0});
    const double t = k / rate, terminal = force / b, gone = -std::expm1(-b * t / m);
    RC_ASSERT(std::abs(arm.velocity_mm_s().y - terminal * gone) <= 1e-13 * std::abs(terminal));
    const double path = terminal * (t - m / b * gone);
    RC_ASSERT(std::abs(arm.position_mm().y - path) <= 1e-13 * std::abs(terminal) * t);
  }
  RC_ASSERT(arm.position_mm().x == 0.0 && arm.position_mm().z == 0.0);
}

TEST(SimulatedArm, WithoutDampingMovesWithTheSquareOfTime) {
  SimulatedArm arm = built(undelayed(1000, 0.25, 0.0));
  for (int k = 0; k < 100; ++k) arm.advance({0, 0, -2.0});
  EXPECT_NEAR(arm.position_mm().z, -0.5 * 8000.0 * 0.01, 1e-12);
  EXPECT_NEAR(arm.kinetic_energy_mj(), 2.0 * 40.0, 1e-12);
  EXPECT_NEAR(arm.energy().displayed, 2.0 * 40.0, 1e-12);
  EXPECT_EQ(arm.energy().damped, 0.0);
}

struct Reference {
  double x = 0.0, v = 0.0, s = 0.0, damped = 0.0, hand = 0.0;
};

/// The same equation by the fourth-order Runge-Kutta method with many small steps.
Reference stepped(Reference r, const ArmSettings& arm, const HandSettings& hand, double force,
                  double speed) {
  constexpr int kSteps = 400;
  const double dt = arm.loop.period_s() / kSteps, m = 1e-3 * arm.loop.mass_kg,
               b = arm.loop.damping_ns_per_mm;
  const auto pull = [&](double x, double v, double s) {
    return hand.push_n.x + hand.stiffness_n_per_mm.x * (s - x) +
           hand.damping_ns_per_mm.x * (speed - v);
  };
  struct Rate {
    double x, v, damped, hand;
  };
  const auto rate = [&](const Reference& at, double s) {
    const double h = pull(at.x, at.v, s);
    return Rate{at.v, (force - b * at.v + h) / m, b * at.v * at.v, h * at.v};
  };
  const auto moved = [](Reference at, const Rate& d, double t) {
    at.x += t * d.x, at.v += t * d.v, at.damped += t * d.damped, at.hand += t * d.hand;
    return at;
  };
  for (int k = 0; k < kSteps; ++k) {
    const Rate k1 = rate(r, r.s), k2 = rate(moved(r, k1, dt / 2), r.s + speed * dt / 2);
    const Rate k3 = rate(moved(r, k2, dt / 2), r.s + speed * dt / 2);
    const Rate k4 = rate(moved(r, k3, dt), r.s + speed * dt);
    r = moved(moved(moved(moved(r, k1, dt / 6), k2, dt / 3), k3, dt / 3), k4, dt / 6);
    r.s += speed * dt;
  }
  return r;
}

RC_GTEST_PROP(SimulatedArm, AgreesWithSmallStepsWhenAHandGuidesIt, ()) {
  const double rate = within(100, 8000);
  const ArmSettings arm = undelayed(rate, within(0.1, 0.5), within(0.0, 0.01));
  const HandSettings hand = guiding(within(0.0, 2.0), within(0.0, 0.02), within(-2.0, 2.0));
  SimulatedArm exact = built(arm, hand);
  Reference reference;
  for (int k = 0; k < 5; ++k) {
    const double force = within(-5.0, 5.0), speed = within(-500.0, 500.0);
    reference = stepped(reference, arm, hand, force, speed);
    exact.advance({force, 0, 0}, {reference.s, 0, 0});
    RC_ASSERT(std::abs(exact.position_mm().x - reference.x) <= 1e-7);
    RC_ASSERT(std::abs(exact.velocity_mm_s().x - reference.v) <= 1e-5);
    RC_ASSERT(std::abs(exact.energy().damped - reference.damped) <= 1e-6);
    RC_ASSERT(std::abs(exact.energy().hand - reference.hand) <= 1e-6);
  }
}

RC_GTEST_PROP(SimulatedArm, OnePeriodEqualsManyShorterOnes, ()) {
  const double m = within(0.1, 0.5), b = within(0.0, 0.02), force = within(-5.0, 5.0);
  const HandSettings hand = guiding(within(0.0, 2.0), within(0.0, 0.02));
  SimulatedArm slow = built(undelayed(100, m, b), hand), fast = built(undelayed(8000, m, b), hand);
  for (int k = 1; k <= 10; ++k) {
    slow.advance({force, 0, 0}, {1.0 * k, 0, 0});
    for (int j = 1; j <= 80; ++j) fast.advance({force, 0, 0}, {k - 1 + j / 80.0, 0, 0});
    RC_ASSERT(std::abs(slow.position_mm().x - fast.position_mm().x) <= 1e-10);
    RC_ASSERT(std::abs(slow.energy().damped - fast.energy().damped) <= 1e-9);
  }
}

RC_GTEST_PROP(SimulatedArm, WorkOfAPushEqualsForceTimesDistance, ()) {
  HandSettings hand;
  hand.push_n = {within(-2, 2), within(-2, 2), within(-2, 2)};
  ArmSettings settings = undelayed(1000, within(0.1, 0.5), within(0.0, 0.01));
  settings.friction_n = within(0.0, 0.3);
  SimulatedArm arm = built(settings, hand);
  for (int k = 0; k < 100; ++k) arm.advance({within(-5, 5), within(-5, 5), within(-5, 5)});
  RC_ASSERT(std::abs(arm.energy().hand - glm::dot(hand.push_n, arm.position_mm())) <= 1e-9);
}

TEST(SimulatedArm, ForceArrivesAfterItsDelayForOnePeriod) {
  for (int delay = 0; delay <= 8; ++delay) {
    ArmSettings settings = undelayed(1000, 0.5, 0.0);
    settings.loop.delay_ticks = delay;
    SimulatedArm arm = built(settings);
    for (int k = 0; k <= 10; ++k) {
      arm.advance({k == 0 ? 1.0 : 0.0, 0, 0});
      EXPECT_NEAR(arm.velocity_mm_s().x, k >= delay ? 2.0 : 0.0, 1e-13) << delay << " " << k;
    }
  }
}

TEST(SimulatedArm, EncodersReadTheNearestStep) {
  ArmSettings settings = undelayed(1000, 0.1, 0.001);
  settings.step_mm = 0.05;
  SimulatedArm arm = built(settings, {}, {0.124, -0.126, 0});
  EXPECT_NEAR(arm.reading_mm().x, 0.1, 1e-15);
  EXPECT_NEAR(arm.reading_mm().y, -0.15, 1e-15);
  EXPECT_EQ(arm.position_mm().x, 0.124);
  settings.step_mm = 0.0;
  EXPECT_EQ(built(settings, {}, {0.124, 0, 0}).reading_mm().x, 0.124);
}

TEST(Friction, HoldsAgainstASmallerPull) {
  ArmSettings settings = undelayed(1000, 0.2, 0.0);
  settings.friction_n = 0.5;
  SimulatedArm arm = built(settings);
  for (int k = 0; k < 100; ++k) arm.advance({0.5, -0.49, 0.6});
  EXPECT_EQ(arm.position_mm().x, 0.0);
  EXPECT_EQ(arm.position_mm().y, 0.0);
  EXPECT_NEAR(arm.position_mm().z, 0.5 * (0.6 - 0.5) / 0.2e-3 * 0.01, 1e-11);
  EXPECT_NEAR(arm.energy().rubbed, 0.5 * arm.position_mm().z, 1e-12);
}

TEST(Friction, StopsASlideWithinTheTickAndHoldsIt) {
  // A push of 1 N for 10 ms: 50 mm/s minus friction; it then slides m v^2 / 2f.
  ArmSettings settings = undelayed(100, 0.2, 0.0);
  settings.friction_n = 0.4;
  SimulatedArm arm = built(settings);
  arm.advance({1.0, 0, 0});
  const double v = 0.6 / 0.2e-3 * 0.01, x = 0.5 * v * 0.01;
  EXPECT_NEAR(arm.velocity_mm_s().x, v, 1e-13);
  for (int k = 0; k < 10; ++k) arm.advance({0, 0, 0});
  EXPECT_EQ(arm.velocity_mm_s().x, 0.0);
  EXPECT_NEAR(arm.position_mm().x, x + 0.5 * 0.2e-3 * v * v / 0.4, 1e-12);
  EXPECT_NEAR(arm.energy().rubbed, arm.energy().displayed, 1e-13);
}

TEST(Friction, ReleasesWhenTheHandPullsHarder) {
  ArmSettings settings = undelayed(1000, 0.2, 0.001);
  settings.friction_n = 0.5;
  SimulatedArm arm = built(settings, guiding(0.1, 0.0));  // releases at 5 mm
  for (int k = 1; k <= 60; ++k) {
    arm.advance({0, 0, 0}, {0.1 * k, 0, 0});
    EXPECT_EQ(arm.position_mm().x > 0.0, k > 50) << k;
  }
}

TEST(SimulatedArm, CarryMovesTheArmAndCountsTheWork) {
  ArmSettings settings = undelayed(1000, 0.2, 0.003);
  SimulatedArm arm = built(settings);
  arm.carry({1.5, 0, 0}, {1.0, 0, 0});
  EXPECT_EQ(arm.position_mm().x, 1.0);
  EXPECT_NEAR(arm.energy().displayed, 1.5, 1e-15);
  EXPECT_NEAR(arm.energy().damped, 0.003 * 1000.0 * 1.0, 1e-14);  // b v x, at 1 m/s
  EXPECT_NEAR(arm.energy().hand, 0.5 * 0.2e-3 * 1e6 - 1.5 + 3.0, 1e-13);
}

TEST(SimulatedArm, TreatsANonFiniteForceAsZero) {
  SimulatedArm arm = built(undelayed(1000, 0.1, 0.001));
  arm.advance({std::nan(""), 1.0, 0});
  arm.advance({0, std::numeric_limits<double>::infinity(), 0});
  EXPECT_EQ(arm.position_mm(), glm::dvec3(0.0));
}

TEST(SimulatedArm, ErrorsNameTheSetting) {
  const auto refused = [](const ArmSettings& arm, const HandSettings& hand = {},
                          glm::dvec3 start = {}) {
    const auto built = SimulatedArm::build(arm, hand, start);
    return built ? std::string() : std::string(built.error().setting);
  };
  const double nan = std::nan("");
  const ArmSettings good = undelayed(1000, 0.1, 0.001);
  EXPECT_EQ(refused(good), "");
  EXPECT_EQ(refused(undelayed(9, 0.1, 0.001)), "rate_hz");
  EXPECT_EQ(refused(undelayed(nan, 0.1, 0.001)), "rate_hz");
  EXPECT_EQ(refused(undelayed(1000, 0.0, 0.001)), "mass_kg");
  EXPECT_EQ(refused(undelayed(1000, 0.1, -1.0)), "damping_ns_per_mm");
  ArmSettings arm = good;
  arm.loop.delay_ticks = 9;
  EXPECT_EQ(refused(arm), "delay_ticks");
  arm = good, arm.friction_n = -0.1;
  EXPECT_EQ(refused(arm), "friction_n");
  arm = good, arm.step_mm = nan;
  EXPECT_EQ(refused(arm), "step_mm");
  EXPECT_EQ(refused(good, guiding(-1, 0)), "stiffness_n_per_mm");
  EXPECT_EQ(refused(good, guiding(0, nan)), "damping_ns_per_mm");
  EXPECT_EQ(refused(good, guiding(0, 0, 101)), "push_n");
  EXPECT_EQ(refused(good, {}, {0, nan, 0}), "start_mm");
}

}  // namespace
}  // namespace clay::falcon
