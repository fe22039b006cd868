// Wire faults during a throw, on a virtual clock, so that every fault is exactly repeatable.

#include "tests/app/servo/live_bench.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <glm/geometric.hpp>

namespace clay::servo {
namespace {

using falcon::GuardState;
using falcon::WireFault;

/// Afterwards the device sends no frame for 40 ticks, and the last one has arrived.
void press_and_lose_frames(VirtualThrow& live) {
  live.run(3.2);
  ASSERT_GT(glm::length(live.status().force_n), 0.1);
  live.fault(WireFault::no_frame, 40);
  live.tick();  // the answer in transit
}

TEST(LiveWire, WithoutFramesTheClayRestsAndTheForceEndsIn10Ms) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  press_and_lose_frames(live);
  const Pot before = live.wheel.pot();
  const std::int64_t last_us = live.clock.now_us();
  double n = glm::length(live.status().force_n);
  for (int i = 0; i < 20; ++i) {
    live.tick();
    ASSERT_EQ(live.wheel.pot(), before);
    ASSERT_LE(glm::length(live.status().force_n), n);
    n = glm::length(live.status().force_n);
    ASSERT_TRUE(n == 0.0 || live.clock.now_us() - last_us < 10'000) << n;
  }
  EXPECT_EQ(n, 0.0);
  const ServoTiming& timing = live.loop->timing();
  EXPECT_GE(timing.stale, 19u) << "ticks without a new frame";
  EXPECT_LT(timing.stale, timing.ticks);
  live.run(3.0);
  EXPECT_NE(live.wheel.pot(), before) << "the throw continues afterwards";
}

// The device holds a force until it receives the next one.
TEST(LiveWire, TheDeviceHasNoForce10MsAfterTheLastFrame) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  press_and_lose_frames(live);
  const std::int64_t last_us = live.clock.now_us();
  while (glm::length(live.status().force_n) > 0.0 && live.clock.now_us() - last_us < 50'000)
    live.tick();
  EXPECT_LE(live.clock.now_us() - last_us, 10'000);
}

TEST(LiveWire, JumpIntoTheClayRemovesNothing) {
  VirtualThrow live(rib_scene(), one_to_one(), [](double t) {
    return glm::dvec3(t > 2.0 && t < 2.0015 ? -20.0 : 2.0, 0.0, 0.0);
  });
  live.run(2.5);
  EXPECT_GE(live.loop->events().flags[std::countr_zero(unsigned{falcon::kGuardJump})], 1u)
      << "no jump was detected";
  EXPECT_EQ(live.wheel.pot(), Wheel::build(rib_scene())->pot());
}

TEST(LiveWire, LostHomingZeroesTheForceInTheSameTick) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  live.run(3.2);
  const auto times_not_ready = [&] {
    return live.loop->events().flags[std::countr_zero(unsigned{falcon::kGuardNotReady})];
  };
  const auto times_before = times_not_ready();
  live.fault(WireFault::homing_lost);
  while (live.status().device == falcon::DeviceState::ready) live.tick();
  const Pot before = live.wheel.pot();
  for (; live.status().device != falcon::DeviceState::ready; live.tick()) {
    ASSERT_EQ(glm::length(live.status().force_n), 0.0);
    ASSERT_EQ(live.model->motors(), falcon::LegCounts{});
    ASSERT_EQ(live.wheel.pot(), before);
  }
  EXPECT_EQ(times_not_ready(), times_before + 1);
  EXPECT_NE(live.status().guard, GuardState::engaged);
}

TEST(LiveWire, UnpluggingEndsTheThrow) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  live.run(3.0);
  live.fault(WireFault::unplugged);
  EXPECT_EQ(live.run(1.0), Ending::device_lost);
  EXPECT_EQ(live.device.problem().fault, falcon::DeviceFault::unplugged);
  EXPECT_NEAR(live.status().time_s, 3.0, 0.01);
  EXPECT_EQ(live.wheel.ledger().volume_error(live.wheel.stack().recount()), 0);
}

}  // namespace
}  // namespace clay::servo
