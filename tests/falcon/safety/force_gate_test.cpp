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

/// A servo that writes forces, one step of it at a time.
struct Servo {
  enum class Step { enter, write, leave, mend } step = Step::enter;

  void go(ForceGate& gate, std::vector<int>& wire) {
    switch (step) {
      case Step::enter:
        if (gate.enter()) step = Step::write;
        return;
      case Step::write:
        wire.push_back(kForce);
        step = Step::leave;
        return;
      case Step::leave:
        step = gate.leave() ? Step::enter : Step::mend;
        return;
      case Step::mend:
        wire.push_back(kZero);
        step = Step::enter;
    }
  }
};

/// Who ends the force: shuts, then writes zero.
struct Ender {
  int step = 0;
  void go(ForceGate& gate, std::vector<int>& wire) {
    if (step == 0) gate.shut_for_good();
    if (step == 1) wire.push_back(kZero);
    ++step;
  }
};

// Every order of 12 steps of a servo and two enders, each step one atomic operation or one packet.
TEST(ForceGate, EndsInZeroInEveryOrderOfSteps) {
  constexpr int kSteps = 12;
  int ended = 0;
  for (int order = 0; order < 531'441; ++order) {  // 3^12
    ForceGate gate;
    Servo servo;
    Ender enders[2];
    std::vector<int> wire;
    for (int step = 0, rest = order; step < kSteps; ++step, rest /= 3)
      rest % 3 == 0 ? servo.go(gate, wire) : enders[rest % 3 - 1].go(gate, wire);
    if (enders[0].step < 2) continue;
    ++ended;
    // The servo goes on until it is outside again; then it is over.
    for (int i = 0; i < 4; ++i) servo.go(gate, wire);
    ASSERT_EQ(wire.back(), kZero) << order;
    ASSERT_FALSE(gate.enter());
    ASSERT_FALSE(gate.open());
  }
  EXPECT_GT(ended, 400'000);
}

TEST(ForceGate, HasOneOwner) {
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
  EXPECT_FALSE(gate.open()) << "not from inside";
  EXPECT_FALSE(gate.leave());
  EXPECT_FALSE(gate.enter());
  EXPECT_TRUE(gate.open());
  EXPECT_TRUE(gate.enter());
  EXPECT_TRUE(gate.leave());
  gate.shut_for_good();
  EXPECT_FALSE(gate.open());
}

TEST(ForceGate, LetsOnlyOneOfManyThreadsCommand) {
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

/// A device of one packet, as a signal handler may write it.
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
  wire.last = kForce;  // the packet that was under way
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
  EXPECT_FALSE(Watchdog::must_zero(1'000'100, 1'000'000)) << "a beat that came meanwhile";
  EXPECT_TRUE(Watchdog::must_zero(1'010'000, 1'000'000)) << "a clock that is wrong";
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
