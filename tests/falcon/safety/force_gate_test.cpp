#include "claystack/falcon/guard.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <thread>
#include <vector>

namespace clay::falcon {
namespace {

constexpr int kZero = 0, kForce = 1;

/// A servo that writes forces, one step at a time.
struct Servo {
  enum class Step { enter, write, leave, write_zero } step = Step::enter;

  void advance(ForceGate& gate, std::vector<int>& wire) {
    switch (step) {
      case Step::enter:
        if (gate.enter()) step = Step::write;
        return;
      case Step::write:
        wire.push_back(kForce);
        step = Step::leave;
        return;
      case Step::leave:
        step = gate.leave() ? Step::enter : Step::write_zero;
        return;
      case Step::write_zero:
        wire.push_back(kZero);
        step = Step::enter;
    }
  }
};

/// Ends the force: shuts the gate, then writes zero.
struct Stopper {
  int step = 0;
  void advance(ForceGate& gate, std::vector<int>& wire) {
    if (step == 0) gate.shut_for_good();
    if (step == 1) wire.push_back(kZero);
    ++step;
  }
};

// Every order of 12 steps of a servo and two stoppers; a step is one atomic action or packet.
TEST(ForceGate, EndsInZeroInEveryOrderOfSteps) {
  constexpr int kSteps = 12;
  int stopped = 0;
  for (int order = 0; order < 531'441; ++order) {  // 3^12
    ForceGate gate;
    Servo servo;
    Stopper stoppers[2];
    std::vector<int> wire;
    for (int step = 0, rest = order; step < kSteps; ++step, rest /= 3)
      rest % 3 == 0 ? servo.advance(gate, wire) : stoppers[rest % 3 - 1].advance(gate, wire);
    if (stoppers[0].step < 2) continue;
    ++stopped;
    // The servo continues until it has left the gate.
    for (int i = 0; i < 4; ++i) servo.advance(gate, wire);
    ASSERT_EQ(wire.back(), kZero) << order;
    ASSERT_FALSE(gate.enter());
    ASSERT_FALSE(gate.open());
  }
  EXPECT_GT(stopped, 400'000);
}

TEST(ForceGate, HasOneOwnerAtATime) {
  ForceGate gate;
  EXPECT_TRUE(gate.enter());
  EXPECT_FALSE(gate.enter());
  EXPECT_TRUE(gate.leave());
  EXPECT_TRUE(gate.enter());
}

TEST(ForceGate, OpensAgainAfterTheWatchdog) {
  ForceGate gate;
  ASSERT_TRUE(gate.enter());
  gate.shut();
  EXPECT_TRUE(gate.is_shut());
  EXPECT_FALSE(gate.open()) << "opened while a thread is inside";
  EXPECT_FALSE(gate.leave());
  EXPECT_FALSE(gate.enter());
  EXPECT_TRUE(gate.open());
  EXPECT_TRUE(gate.enter());
  EXPECT_TRUE(gate.leave());
  gate.shut_for_good();
  EXPECT_FALSE(gate.open());
}

TEST(ForceGate, AdmitsOneOfTwoThreadsAtATime) {
  ForceGate gate;
  std::atomic<int> inside{0}, together{0}, passed{0};
  const auto command = [&] {
    for (int i = 0; i < 20'000; ++i) {
      if (!gate.enter()) continue;
      if (inside.fetch_add(1) != 0) ++together;
      inside.fetch_sub(1);
      ++passed;
      (void)gate.leave();
    }
  };
  std::thread one(command), other(command);
  one.join();
  other.join();
  EXPECT_EQ(together, 0);
  EXPECT_GT(passed, 0);
}

/// A device that stores one packet; a signal handler may write it.
struct Wire {
  std::atomic<int> last{kForce};
  static void write_zero(void* wire) noexcept { static_cast<Wire*>(wire)->last.store(kZero); }
};

TEST(EmergencyStop, IsTheLastPacketToTheDevice) {
  for (int round = 0; round < 200; ++round) {
    ForceGate gate;
    Wire wire;
    EmergencyStop last_zero;
    last_zero.arm(gate, &Wire::write_zero, &wire);
    std::atomic<bool> running{false};
    std::thread servo([&] {
      for (int i = 0; i < 1000; ++i) {
        if (!gate.enter()) break;
        wire.last.store(kForce);
        running.store(true);
        if (!gate.leave()) wire.last.store(kZero);
      }
    });
    while (!running.load()) std::this_thread::yield();
    last_zero.fire();
    servo.join();
    ASSERT_EQ(wire.last, kZero);
    ASSERT_FALSE(gate.enter());
  }
}

TEST(EmergencyStop, WaitsOnlySoLongForAPacket) {
  ForceGate gate;
  Wire wire;
  EmergencyStop last_zero;
  last_zero.arm(gate, &Wire::write_zero, &wire);
  ASSERT_TRUE(gate.enter());
  const std::int64_t before_us = monotonic_us();
  last_zero.fire();
  EXPECT_GE(monotonic_us() - before_us, EmergencyStop::kPacketUs);
  EXPECT_EQ(wire.last, kZero);
}

EmergencyStop signalled;
void on_signal(int) { signalled.fire(); }

TEST(EmergencyStop, IsWrittenFromASignalDuringAPacket) {
  ForceGate gate;
  Wire wire;
  signalled.arm(gate, &Wire::write_zero, &wire);
  const auto before = std::signal(SIGTERM, on_signal);
  ASSERT_TRUE(gate.enter());
  std::raise(SIGTERM);
  EXPECT_EQ(wire.last, kZero);
  wire.last = kForce;  // the packet in flight
  EXPECT_FALSE(gate.leave());
  EXPECT_FALSE(gate.enter());
  signalled.arm(gate, nullptr, nullptr);
  wire.last = kForce;
  std::raise(SIGTERM);
  EXPECT_EQ(wire.last, kForce) << "disarmed";
  std::signal(SIGTERM, before);
}

TEST(Watchdog, ActsAfterTenMilliseconds) {
  EXPECT_FALSE(Watchdog::must_zero(1'000'000, 1'000'000));
  EXPECT_FALSE(Watchdog::must_zero(1'000'000, 1'009'999));
  EXPECT_TRUE(Watchdog::must_zero(1'000'000, 1'010'000));
  EXPECT_TRUE(Watchdog::must_zero(INT64_MIN, INT64_MAX));
  EXPECT_FALSE(Watchdog::must_zero(1'000'100, 1'000'000)) << "a beat newer than the clock reading";
  EXPECT_TRUE(Watchdog::must_zero(1'010'000, 1'000'000)) << "a wrong clock";
  EXPECT_TRUE(Watchdog::must_zero(INT64_MAX, INT64_MIN));
}

TEST(Watchdog, ChecksInTime) {
  for (const std::int64_t beat : {INT64_MIN, std::int64_t{0}, std::int64_t{123}}) {
    EXPECT_TRUE(Watchdog::must_zero(beat, Watchdog::next_look_us(beat)));
    EXPECT_FALSE(Watchdog::must_zero(beat, Watchdog::next_look_us(beat) - 1));
  }
  EXPECT_EQ(Watchdog::next_look_us(INT64_MAX), INT64_MAX);
}

}  // namespace
}  // namespace clay::falcon
