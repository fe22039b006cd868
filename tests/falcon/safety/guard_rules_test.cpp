#include "falcon/safety/guard_rules.hpp"
#include "core/limit_norm.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace clay::falcon {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_100;

constexpr double kMax = std::numeric_limits<double>::max();
constexpr double kMin = std::numeric_limits<double>::denorm_min();

double any_number() {
  const double mantissa = *rc::gen::inRange(-1'000'000, 1'000'001) / 1e6;
  return std::ldexp(mantissa, *rc::gen::inRange(-1070, 1025));
}

double near_five() { return *rc::gen::inRange(-1'000'000, 1'000'001) * 6e-6; }

Exact square(const glm::dvec3& v) {
  const auto exact = [](double x) { return Exact(x) * Exact(x); };
  return exact(v.x) + exact(v.y) + exact(v.z);
}

Exact dot(const glm::dvec3& a, const glm::dvec3& b) {
  return Exact(a.x) * b.x + Exact(a.y) * b.y + Exact(a.z) * b.z;
}

RC_GTEST_PROP(LimitNorm, RespectsTheLimitExactlyAndKeepsTheDirection, ()) {
  const bool near = *rc::gen::arbitrary<bool>();
  const auto part = [near] { return near ? near_five() : any_number(); };
  const glm::dvec3 v(part(), part(), part());
  RC_PRE(is_finite(v));
  const glm::dvec3 limited = limit_norm(v, 5.0);
  RC_ASSERT(square(limited) <= 25);
  if (square(v) <= 24.999) RC_ASSERT(limited == v);
  if (square(v) > 25) {
    RC_ASSERT(square(limited) >= 25 * (1 - Exact(std::ldexp(1.0, -47))));
    const Exact along = dot(limited, v);
    // cos^2 of the angle between them, 1 to rounding
    RC_ASSERT(along > 0);
    RC_ASSERT(along * along >= square(limited) * square(v) * (1 - Exact(1e-30)));
  }
}

TEST(LimitNorm, LimitsTheLargestNumbers) {
  for (const glm::dvec3& v : {glm::dvec3(kMax), glm::dvec3(-kMax, 0, kMin)}) {
    EXPECT_LE(square(limit_norm(v, 5.0)), 25);
    EXPECT_GE(square(limit_norm(v, 5.0)), 24.9999999);
  }
  EXPECT_EQ(limit_norm(glm::dvec3(0.0), 5.0), glm::dvec3(0.0));
  EXPECT_EQ(limit_norm(glm::dvec3(kMin), 5.0), glm::dvec3(kMin));
}

// The 3-4-5 triangles give exact answers.
TEST(LimitRise, FallsWithoutLimit) {
  const glm::dvec3 before(3.0, 4.0, 0.0);
  EXPECT_EQ(limit_rise(glm::dvec3(0.0), before, 0.0), glm::dvec3(0.0));
  EXPECT_EQ(limit_rise(0.5 * before, before, 0.0), 0.5 * before);
  EXPECT_EQ(limit_rise(before, before, 0.0), before);
}

TEST(LimitRise, GrowsAndTurnsByTheRise) {
  const glm::dvec3 before(3.0, 0.0, 0.0);
  EXPECT_EQ(limit_rise({5.0, 0.0, 0.0}, before, 0.5), glm::dvec3(3.5, 0.0, 0.0));
  EXPECT_EQ(limit_rise({3.0, 4.0, 0.0}, before, 0.5), glm::dvec3(3.0, 0.5, 0.0));
  EXPECT_EQ(limit_rise({2.0, 4.0, 0.0}, before, 0.5), glm::dvec3(2.0, 0.5, 0.0));
  EXPECT_EQ(limit_rise({-5.0, 0.0, 0.0}, before, 0.5), glm::dvec3(-0.5, 0.0, 0.0));
  EXPECT_EQ(limit_rise({0.0, 0.0, 5.0}, before, 0.5), glm::dvec3(0.0, 0.0, 0.5));
  EXPECT_EQ(limit_rise({0.0, 0.0, 0.25}, before, 0.5), glm::dvec3(0.0, 0.0, 0.25));
  EXPECT_EQ(limit_rise({5.0, 0.0, 0.0}, glm::dvec3(0.0), 0.5), glm::dvec3(0.5, 0.0, 0.0));
}

TEST(Fade, IsALineBetweenItsEnds) {
  EXPECT_EQ(fade(0.0, 5.0, 10.0), 1.0);
  EXPECT_EQ(fade(5.0, 5.0, 10.0), 1.0);
  EXPECT_EQ(fade(7.5, 5.0, 10.0), 0.5);
  EXPECT_EQ(fade(10.0, 5.0, 10.0), 0.0);
  EXPECT_EQ(fade(1e9, 5.0, 10.0), 0.0);
}

TEST(Elapsed, NeverOverflows) {
  EXPECT_EQ(elapsed_s(1'000, 3'500), 0.0025);
  EXPECT_EQ(elapsed_s(3'500, 1'000), 0.0);
  EXPECT_EQ(elapsed_s(INT64_MIN, INT64_MAX), 1000.0);
  EXPECT_EQ(elapsed_s(INT64_MAX, INT64_MIN), 0.0);
}

TEST(TickClock, RoundsGrowthDownAndFadingUp) {
  TickClock clock;
  const auto tick = [&](std::int64_t now_us) {
    const TickTime time = clock.advance(now_us, 0.001);
    return glm::dvec3(time.real_s, time.growing_s, time.fading_s);
  };
  EXPECT_EQ(tick(5'000'000), glm::dvec3(0.0, 0.0, 0.0002));
  EXPECT_EQ(tick(5'000'500), glm::dvec3(0.0005, 0.0005, 0.0005));
  EXPECT_EQ(tick(5'020'500), glm::dvec3(0.02, 0.001, 0.02));
  EXPECT_EQ(tick(5'020'500), glm::dvec3(0.0, 0.0, 0.0002));
  EXPECT_EQ(tick(1'000'000), glm::dvec3(0.0, 0.0, 0.0002));
  EXPECT_EQ(tick(1'000'100), glm::dvec3(0.0001, 0.0001, 0.0002));
}

TEST(Age, IsTheMaximumOfStampAndTicks) {
  Age age;
  EXPECT_FALSE(age.any());
  age.see(1'000'000, 1'002'000);
  EXPECT_EQ(age.at(1'002'000), 0.002);
  EXPECT_EQ(age.at(1'003'000), 0.003);
  age.pass(0.004);
  EXPECT_EQ(age.at(1'003'000), 0.006);
  EXPECT_EQ(age.at(500'000), 0.006);
  age.see(1'000'000, 1'000'000);  // the same stamp is not a new sample
  EXPECT_EQ(age.at(1'003'000), 0.006);
  age.see(900'000, 800'000);
  EXPECT_EQ(age.at(800'000), 0.0);
}

TEST(JumpFilter, FollowsAFastHand) {
  using enum JumpFilter::Verdict;
  JumpFilter filter;
  glm::dvec3 hand(0.0);
  EXPECT_EQ(filter.take(hand, 2.0), plausible);
  for (int i = 0; i < 100; ++i) {
    hand.x += 1.99;
    EXPECT_EQ(filter.take(hand, 2.0), plausible);
  }
}

TEST(JumpFilter, DropsOneFrameAndAcceptsTheNext) {
  using enum JumpFilter::Verdict;
  JumpFilter filter;
  EXPECT_EQ(filter.take({0, 0, 0}, 2.0), plausible);
  EXPECT_EQ(filter.take({0, 2.01, 0}, 2.0), dropped);
  EXPECT_EQ(filter.take({1, 0, 0}, 2.0), plausible);
  EXPECT_EQ(filter.take({1, 0, 50}, 2.0), dropped);
  EXPECT_EQ(filter.take({2, 0, 0}, 4.0), plausible);
}

TEST(JumpFilter, ReportsAPersistentJump) {
  using enum JumpFilter::Verdict;
  JumpFilter filter;
  // 3 mm is within the 4 mm that two ticks allow, but it repeats the dropped position.
  EXPECT_EQ(filter.take({0, 0, 0}, 2.0), plausible);
  EXPECT_EQ(filter.take({3, 0, 0}, 2.0), dropped);
  EXPECT_EQ(filter.take({3, 0, 0}, 4.0), stays);
  EXPECT_EQ(filter.take({3, 0, 0}, 2.0), plausible);
  EXPECT_EQ(filter.take({30, 0, 0}, 2.0), dropped);
  EXPECT_EQ(filter.take({-30, 0, 0}, 4.0), stays);
  EXPECT_EQ(filter.take({-30, 0, 0}, 2.0), plausible);
  EXPECT_EQ(filter.take({1e308, -1e308, 1e308}, 2.0), dropped);
}

TEST(Engagement, WaitsForConsecutiveSmallForces) {
  Engagement engagement;
  for (int i = 0; i < 4; ++i) engagement.want(0.1, 0.2, 5);
  engagement.want(0.2, 0.2, 5);  // not below the threshold
  for (int i = 0; i < 4; ++i) engagement.want(0.1, 0.2, 5);
  EXPECT_EQ(engagement.phase(), Engagement::Phase::waiting);
  engagement.grow(1.0, 2.0);
  EXPECT_EQ(engagement.gain(), 0.0);
  engagement.want(0.1, 0.2, 5);
  EXPECT_EQ(engagement.phase(), Engagement::Phase::ramping);
  engagement.grow(0.5, 2.0);
  EXPECT_EQ(engagement.gain(), 0.25);
  engagement.want(4.0, 0.2, 5);
  EXPECT_EQ(engagement.gain(), 0.25);
  engagement.grow(2.0, 2.0);
  EXPECT_EQ(engagement.gain(), 1.0);
  EXPECT_EQ(engagement.phase(), Engagement::Phase::engaged);
}

TEST(HeatLimit, CoolsAsFastAsItWarms) {
  const TickTime second{1.0, 1.0, 1.0};
  HeatLimit heat;
  for (int i = 0; i < 9; ++i) heat.hold(4.5, 4.0, second, 10.0);
  for (int i = 0; i < 4; ++i) heat.hold(4.0, 4.0, second, 10.0);
  for (int i = 0; i < 4; ++i) heat.hold(4.5, 4.0, second, 10.0);
  EXPECT_FALSE(heat.fading());
  heat.hold(4.5, 4.0, second, 10.0);
  EXPECT_TRUE(heat.fading());
  EXPECT_FALSE(heat.fade_out(0.25, 1.0));
  EXPECT_EQ(heat.gain(), 0.75);
  EXPECT_TRUE(heat.fade_out(0.75, 1.0));
  EXPECT_FALSE(heat.fading());
}

}  // namespace
}  // namespace clay::falcon
