#include "app/servo/clock.hpp"
#include "claystack/falcon/guard.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>

namespace clay::servo {
namespace {

constexpr std::int64_t kPeriodNs = 1'000'000;

/// Wakes late by `late`.
class LateClock final : public Clock {
 public:
  std::int64_t now_ns() noexcept override { return now; }
  void sleep_until_ns(std::int64_t time_ns) noexcept override {
    now = std::max(now, time_ns) + late;
  }
  std::int64_t now = 0, late = 0;
};

RC_GTEST_PROP(Pacer, DelaysDoNotAccumulate, ()) {
  LateClock clock;
  Pacer pacer(kPeriodNs);
  pacer.start(0);
  for (std::int64_t tick = 0; tick < 100; ++tick) {
    clock.late = *rc::gen::inRange<std::int64_t>(0, kPeriodNs / 2);
    RC_ASSERT(pacer.wait(clock) == clock.late);
    RC_ASSERT(clock.now == kPeriodNs / 2 + tick * kPeriodNs + clock.late);
    pacer.sampled(clock.now);
  }
}

TEST(Pacer, DoesNotRepeatMissedTicks) {
  LateClock clock;
  Pacer pacer(kPeriodNs);
  pacer.start(0);
  (void)pacer.wait(clock);
  pacer.sampled(clock.now);
  clock.now += 20 * kPeriodNs;
  EXPECT_EQ(pacer.wait(clock), 19 * kPeriodNs);
  pacer.sampled(clock.now);
  for (int tick = 0; tick < 5; ++tick) {
    const std::int64_t before = clock.now;
    EXPECT_EQ(pacer.wait(clock), 0);
    EXPECT_GE(clock.now - before, kPeriodNs / 2);
    pacer.sampled(clock.now);
  }
}

TEST(MonotonicClock, NeverWakesEarlyAndReportsItsDelay) {
  MonotonicClock clock;
  for (int i = 0; i < 200; ++i) {
    const std::int64_t due_ns = clock.now_ns() + 300'000;
    const std::int64_t overslept_ns = clock.wake_at_ns(due_ns);
    const std::int64_t woke_ns = clock.now_ns();
    ASSERT_GE(woke_ns, due_ns);
    ASSERT_GE(overslept_ns, 0);
    // It sleeps until at most kLongestLookNs early and then polls; the delay counts from there.
    ASSERT_LE(overslept_ns, woke_ns - due_ns + MonotonicClock::kLongestLookNs);
  }
  const std::int64_t past_ns = clock.now_ns() - 1;
  EXPECT_EQ(clock.wake_at_ns(past_ns), 0);
}

/// The time from the last frame of a device that falls silent to the first zero force [us].
std::int64_t silence_us(double rate_hz) {
  constexpr std::int64_t kAnswerNs = 1'000'000;
  auto guard = falcon::ForceGuard::build({.period_s = 1.0 / rate_hz, .ramp_s = 0.1}).value();
  LateClock clock;
  Pacer pacer(static_cast<std::int64_t>(1e9 / rate_hz));
  pacer.start(0);
  std::int64_t last_ns = 0, asked_ns = 0;
  for (int tick = 0; tick < 10'000; ++tick) {
    (void)pacer.wait(clock);
    const bool fresh = tick < 5000;
    const std::int64_t until_ns = clock.now + 1000 * pacer.patience_us(clock.now);
    clock.now = std::max(clock.now, fresh ? asked_ns + kAnswerNs : until_ns);
    if (fresh) last_ns = clock.now;
    pacer.sampled(clock.now);
    (void)guard.admit(clock.now_us(), {last_ns / 1000, {}, fresh, true});
    const double wanted_n = tick < 10 ? 0.0 : 3.0;
    const double force_n =
        guard.force(clock.now_us(), {{wanted_n, 0.0, 0.0}, clock.now_us(), true}).force_n.x;
    asked_ns = clock.now;
    EXPECT_TRUE(tick != 4999 || force_n == 3.0) << "no force to end";
    if (!fresh && force_n == 0.0) break;
  }
  return (clock.now - last_ns) / 1000;
}

// Without frames the ticks are 1.5 periods apart, and a force stands between them.
TEST(Pacer, NoForceStands10MsAfterTheLastFrameAtAnyRate) {
  for (const double rate_hz : {400.0, 500.0, 1000.0, 3000.0, 4000.0})
    EXPECT_LE(silence_us(rate_hz), 10'000) << rate_hz << " Hz";
}

TEST(Pacer, FollowsASlowerDevice) {
  LateClock clock;
  Pacer pacer(kPeriodNs);
  pacer.start(0);
  const std::int64_t answer_ns = 1'040'000;
  for (int tick = 0; tick < 100; ++tick) {
    const std::int64_t requested_ns = clock.now;
    (void)pacer.wait(clock);
    EXPECT_LE(clock.now, requested_ns + answer_ns) << "later than the answer";
    EXPECT_GE(1000 * pacer.patience_us(clock.now), requested_ns + answer_ns - clock.now)
        << "it waits until the answer";
    clock.now = requested_ns + answer_ns;
    pacer.sampled(clock.now);
  }
}

}  // namespace
}  // namespace clay::servo
