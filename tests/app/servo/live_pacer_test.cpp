#include "app/servo/clock.hpp"

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
