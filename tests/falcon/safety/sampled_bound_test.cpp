#include "claystack/falcon/passivity.hpp"

#include "tests/falcon/random_values.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace clay::falcon {
namespace {

SampledLoop any_loop(int delay) {
  return {std::pow(10.0, within(2.0, 3.9)), within(0.1, 0.5), within(2e-4, 0.02), delay};
}

RC_GTEST_PROP(PassiveDamping, WithoutDelayEqualsColgateAndSchenkel, ()) {
  const SampledLoop loop = any_loop(0);
  const VirtualWall wall{within(0.0, 10.0), within(-0.01, 0.01)};
  const double expected =
      0.5 * wall.stiffness_n_per_mm / loop.rate_hz + std::abs(wall.damping_ns_per_mm);
  RC_ASSERT(std::abs(passive_damping(loop, wall) - expected) <= 1e-9 * expected);
}

RC_GTEST_PROP(PassiveDamping, AtAnAngleEqualsTheIntegrandOfTheTheorem, ()) {
  // T/2 Re{(1 - e^-jwT) H(e^jwT)} / (1 - cos wT), H = (K + B (z - 1)/(T z)) z^-n.
  const SampledLoop loop = any_loop(*rc::gen::inRange(0, 9));
  const VirtualWall wall{within(0.0, 10.0), within(-0.01, 0.01)};
  const double angle = within(0.01, std::numbers::pi), period = loop.period_s();
  const std::complex<double> back = std::polar(1.0, -angle);
  const auto h = (wall.stiffness_n_per_mm + wall.damping_ns_per_mm * (1.0 - back) / period) *
                 std::pow(back, loop.delay_ticks);
  const double expected = 0.5 * period * ((1.0 - back) * h).real() / (1.0 - std::cos(angle));
  const double found = passive_damping_at(loop, wall, angle);
  RC_ASSERT(std::abs(found - expected) <= 1e-7 * (1e-3 + std::abs(expected)));
  RC_ASSERT(found <= passive_damping(loop, wall) + 1e-15);
}

RC_GTEST_PROP(PassiveDamping, IsTheMaximumOverAllAngles, ()) {
  const SampledLoop loop = any_loop(*rc::gen::inRange(0, 9));
  const VirtualWall wall{within(0.0, 10.0), within(-0.01, 0.01)};
  double most = -1e300;
  for (int k = 0; k <= 20000; ++k)
    most = std::max(most, passive_damping_at(loop, wall, std::numbers::pi * k / 20000));
  RC_ASSERT(std::abs(passive_damping(loop, wall) - most) <= 1e-5 * (1e-3 + std::abs(most)));
}

RC_GTEST_PROP(PassiveStiffness, NeedsAllTheDamping, ()) {
  const SampledLoop loop = any_loop(*rc::gen::inRange(0, 9));
  const double needed = passive_damping(loop, {passive_stiffness(loop), 0.0});
  RC_ASSERT(std::abs(needed - loop.damping_ns_per_mm) <= 1e-12 * needed);
}

/// Coefficients from held force to position (zero-order hold).
struct Held {
  double p, c1, c0;
};
Held held(const SampledLoop& loop) {
  const long double b = loop.damping_ns_per_mm, m = 1e-3L * loop.mass_kg, t = 1.0L / loop.rate_hz;
  const long double p = std::exp(-b * t / m), gone = -std::expm1(-b * t / m);
  return {static_cast<double>(p), static_cast<double>((t - m / b * gone) / b),
          static_cast<double>((m / b * gone - t * p) / b)};
}

RC_GTEST_PROP(StableStiffness, WithoutDelayMakesTheProductOfTheRootsOne, ()) {
  const SampledLoop loop = any_loop(0);
  const Held arm = held(loop);  // (z - 1)(z - p) + K (c1 z + c0): p + K c0 = 1
  const double expected = (1.0 - arm.p) / arm.c0;
  const double other = 2.0 * (1.0 + arm.p) / (arm.c1 - arm.c0);  // a root at -1
  const double border = arm.c1 > arm.c0 ? std::min(expected, other) : expected;
  RC_ASSERT(std::abs(stable_stiffness(loop) - border) <= 1e-6 * border);
}

RC_GTEST_PROP(StableStiffness, WithATickOfDelaySolvesJurysQuadratic, ()) {
  // z^3 - (1 + p) z^2 + (p + K c1) z + K c0: 1 - a0^2 = a1 - a0 a2.
  const SampledLoop loop = any_loop(1);
  const Held arm = held(loop);
  const double half = 0.5 * (arm.c1 + arm.c0 * (1.0 + arm.p)) / (arm.c0 * arm.c0);
  const double last = (1.0 - arm.p) / (arm.c0 * arm.c0);
  const double expected = last / (half + std::sqrt(half * half + last));
  RC_ASSERT(std::abs(stable_stiffness(loop) - expected) <= 1e-6 * expected);
}

RC_GTEST_PROP(StableStiffness, IsAtLeastThePassiveStiffness, ()) {
  const SampledLoop loop = any_loop(*rc::gen::inRange(0, 9));
  RC_ASSERT(stable_stiffness(loop) >= passive_stiffness(loop));
  RC_ASSERT(is_stable(loop, {within(1e-3, 0.999) * passive_stiffness(loop), 0.0}));
  RC_ASSERT(!is_stable(loop, {1.001 * stable_stiffness(loop), 0.0}));
}

TEST(StableStiffness, MatchesTheExampleOfTheDocs) {
  // 0.1 kg, 0.002 N s/mm, 1 kHz, one tick of delay; computed by hand from the quadratic.
  EXPECT_NEAR(stable_stiffness({1000, 0.1, 0.002, 1}), 1.3407, 5e-5);
}

TEST(StableStiffness, IsZeroWithoutDamping) {
  for (int delay = 0; delay <= 3; ++delay)
    EXPECT_LT(stable_stiffness({1000, 0.1, 0.0, delay}), 1e-9) << delay;
}

TEST(StableDamping, MatchesTheDifferenceEquationOfAFreeMass) {
  // v' = v - a (v + v_before)/2: a < 2.
  // With one tick of delay, z^3 - z^2 + a (z + 1)/2: a < 2 sqrt(2) - 2.
  const double m = 1e-4, rate = 1000;
  EXPECT_NEAR(stable_damping({rate, 0.1, 1e-7, 0}, 1e-6), 2.0 * m * rate, 1e-5);
  EXPECT_NEAR(stable_damping({rate, 0.1, 1e-7, 1}, 1e-6), (std::sqrt(8.0) - 2.0) * m * rate, 1e-5);
}

TEST(CheckStiffness, RefusesAboveHalfOfThePassiveLimitAndNamesBothRemedies) {
  const SampledLoop loop{1000, 0.1, 0.002, 1};  // passive: 2 b / 3 T = 1.3333 N/mm
  EXPECT_TRUE(check_stiffness(loop, 0.0));
  EXPECT_TRUE(check_stiffness(loop, 0.6666));
  const auto refused = check_stiffness(loop, 1.0);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().found_n_per_mm, 1.0);
  EXPECT_NEAR(refused.error().highest_n_per_mm, 0.666667, 1e-6);
  EXPECT_NEAR(refused.error().lowest_rate_hz, 1500.0, 1e-9);
  EXPECT_TRUE(check_stiffness(loop, refused.error().highest_n_per_mm));
  SampledLoop faster = loop;
  faster.rate_hz = refused.error().lowest_rate_hz * (1.0 + 1e-12);
  EXPECT_TRUE(check_stiffness(faster, 1.0));
  SampledLoop no_delay = loop;
  no_delay.delay_ticks = 0;  // half of 2 b / T
  EXPECT_TRUE(check_stiffness(no_delay, 2.0));
  EXPECT_FALSE(check_stiffness(no_delay, 2.0001));
}

TEST(CheckStiffness, RefusesInvalidStiffness) {
  EXPECT_FALSE(check_stiffness({}, std::nan("")));
  EXPECT_FALSE(check_stiffness({}, -1.0));
  const auto undamped = check_stiffness({1000, 0.1, 0.0, 1}, 1.0);
  ASSERT_FALSE(undamped);
  EXPECT_TRUE(std::isinf(undamped.error().lowest_rate_hz));
}

TEST(SampledLoop, AcceptsSettingsUpToTheirLimitsAndNoOthers) {
  const auto accepts = [](const SampledLoop& loop) { return check(loop).has_value(); };
  EXPECT_TRUE(accepts({10.0, 1e-3, 0.0, 0}) && accepts({1e5, 100.0, 1.0, 8}));
  EXPECT_FALSE(accepts({9.99, 0.1, 0.002, 0}) || accepts({1.001e5, 0.1, 0.002, 0}));
  EXPECT_FALSE(accepts({1000, 0.99e-3, 0.002, 0}) || accepts({1000, 100.1, 0.002, 0}));
  EXPECT_FALSE(accepts({1000, 0.1, -1e-9, 0}) || accepts({1000, 0.1, 1.001, 0}));
  EXPECT_FALSE(accepts({1000, 0.1, 0.002, -1}) || accepts({1000, 0.1, 0.002, 9}));
}

}  // namespace
}  // namespace clay::falcon
