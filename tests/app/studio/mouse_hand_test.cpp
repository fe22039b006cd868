#include "app/studio/mouse_hand.hpp"

#include "app/studio/offscreen_host.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace clay::studio {
namespace {

constexpr std::int64_t kTickNs = 1'000'000;

struct Hand {
  VirtualClock clock;
  MouseDevice device{clock};
  falcon::DeviceSample tick() {
    clock.sleep_until_ns(clock.now_ns() + kTickNs);
    return device.read(0);
  }
};

TEST(MouseHand, StaysAtItsStart) {
  Hand hand;
  hand.device.begin_at({50.0, 20.0, 0.0});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(hand.tick().position_mm, glm::dvec3(50.0, 20.0, 0.0));
}

TEST(MouseHand, RespectsItsSpeedLimit) {
  Hand hand;
  hand.device.begin_at({50.0, 20.0, 0.0});
  hand.tick();
  hand.device.aim({{0.0, 20.0, 0.0}, kPressingMmPerS});
  glm::dvec3 before = hand.tick().position_mm;
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 now = hand.tick().position_mm;
    EXPECT_LE(glm::distance(now, before), 1e-3 * kPressingMmPerS + 1e-12);
    before = now;
  }
}

TEST(MouseHand, ArrivesWithoutOvershoot) {
  Hand hand;
  hand.device.begin_at({50.0, 0.0, 0.0});
  hand.tick();
  hand.device.aim({{40.0, 0.0, 0.0}, kReachingMmPerS});
  double x = 50.0;
  for (int i = 0; i < 400; ++i) {
    const double now = hand.tick().position_mm.x;
    EXPECT_LE(now, x);
    EXPECT_GE(now, 40.0);
    x = now;
  }
  EXPECT_NEAR(x, 40.0, 1e-3);
}

TEST(MouseHand, APausedServoCausesNoJump) {
  Hand hand;
  hand.device.begin_at({50.0, 0.0, 0.0});
  hand.tick();
  hand.device.aim({{0.0, 0.0, 0.0}, kReachingMmPerS});
  hand.clock.sleep_until_ns(hand.clock.now_ns() + 2'000'000'000);
  EXPECT_GE(hand.device.read(0).position_mm.x, 50.0 - 0.01 * kReachingMmPerS - 1e-12);
}

TEST(MouseHand, SamplesAreReadyAndFreshOnce) {
  Hand hand;
  hand.device.begin_at({50.0, 0.0, 0.0});
  const falcon::DeviceSample first = hand.tick();
  EXPECT_EQ(first.state, falcon::DeviceState::ready);
  EXPECT_TRUE(first.fresh);
  EXPECT_FALSE(hand.device.read(0).fresh);  // at the same time
  EXPECT_FALSE(hand.device.info().can_push);
}

}  // namespace
}  // namespace clay::studio
