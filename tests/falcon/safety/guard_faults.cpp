#include "tests/falcon/safety/guard_faults.hpp"

#include "falcon/device/frame.hpp"

#include <cmath>
#include <limits>
#include <optional>

namespace clay::falcon {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr std::int64_t kHourUs = 3'600'000'000;
const glm::dvec3 kPush(0.0, 2.4, 1.8);  // 3 N
const Tick kPushing{.wanted_n = kPush};
const Tick kAtRest{};

void after(Trial& trial, const Tick& fault, double seconds) {
  trial.run(seconds, fault);
  trial.run(0.05, kPushing);
}

/// After a fade, a late tick or an invalid value the force recovers within half a second.
void expect_recovery(Trial& trial) {
  trial.expect_state(GuardState::ramping);
  trial.run(0.5, kPushing);
  trial.expect_force(kPush);
  trial.expect_state(GuardState::engaged);
}

/// The force stays zero until a rearm; then it takes a small force and a ramp.
void expect_latched(Trial& trial) {
  trial.expect_state(GuardState::safe);
  trial.run(0.3, kAtRest);
  trial.run(0.3, kPushing);
  trial.expect_state(GuardState::safe);
  trial.rearm();
  trial.engage(kPush);
}

/// The force returns without a rearm, after a small force and a ramp.
void expect_restart(Trial& trial) {
  trial.expect_force(glm::dvec3(0.0));
  trial.engage(kPush);
}

void position_not_finite(Trial& trial) {
  trial.engage(kPush);
  for (const double bad : {kNan, kInf, -kInf}) {
    Tick fault = kPushing;
    fault.jump_mm.y = bad;
    after(trial, fault, 0.002);
    expect_recovery(trial);
    trial.run(0.003, fault);
    after(trial, kPushing, 0.01);
    expect_latched(trial);
  }
}

void force_not_finite(Trial& trial) {
  trial.engage(kPush);
  for (const double bad : {kNan, kInf, -kInf}) {
    Tick fault = kPushing;
    fault.wanted_n.x = bad;
    after(trial, fault, 0.002);
    expect_recovery(trial);
    after(trial, fault, 0.003);
    expect_latched(trial);
  }
}

void force_spikes(Trial& trial) {
  trial.engage(kPush);
  for (const double times : {10.0, 1000.0, 1e300}) {
    const Tick spike{.wanted_n = times * kPush};
    after(trial, spike, 0.001);
    trial.expect_force(kPush);
    trial.run(0.05, spike);
    trial.expect_force(kPush * (5.0 / 3.0));
    after(trial, {.wanted_n = -spike.wanted_n}, 0.003);
    trial.expect_force(kPush);
  }
}

void start_inside_the_clay(Trial& trial) {
  for (int again = 0; again < 2; ++again) {
    trial.run(0.5, kPushing);
    trial.expect_state(GuardState::waiting);
    trial.run(0.004, {.wanted_n = kPush / 20.0});
    trial.run(0.5, kPushing);
    trial.expect_state(GuardState::waiting);
    trial.run(0.004, {.wanted_n = kPush / 20.0});
    trial.run(0.004, {.wanted_n = kPush / 20.0, .frame = false});
    trial.run(0.5, kPushing);
    trial.expect_state(GuardState::waiting);
    trial.engage(kPush);
    trial.tick({.wanted_n = kPush, .command = Tick::Command::pause});
    trial.run(0.3, kAtRest);
    trial.run(0.3, kPushing);
    trial.expect_state(GuardState::safe);
    trial.rearm();
  }
}

void homing_lost(Trial& trial) {
  trial.run(0.5, {.wanted_n = kPush, .ready = false});
  trial.expect_state(GuardState::idle);
  trial.engage(kPush);
  trial.tick({.wanted_n = kPush, .ready = false});
  // Homing moves the origin; that is not a jump.
  const Tick elsewhere{.wanted_n = kPush, .jump_mm = {30.0, 0.0, 0.0}};
  trial.tick(elsewhere);
  trial.expect(trial.log().back().admission.may_deform, "the first frame after homing is accepted");
  trial.run(0.5, elsewhere);
  trial.expect_state(GuardState::waiting);
  trial.tick({.ready = false});
  expect_restart(trial);
}

void unplugged(Trial& trial) {
  trial.engage(kPush);
  trial.run(0.5, {.wanted_n = kPush, .frame = false, .ready = false});
  trial.run(0.5, {.wanted_n = kPush, .ready = false, .jump_mm = {30.0, 0.0, 0.0}});
  trial.run(0.1, kPushing);
  expect_restart(trial);
}

void frames_stale(Trial& trial) {
  trial.engage(kPush);
  const Tick none{.wanted_n = kPush, .frame = false};
  trial.run(0.004, none);
  trial.expect_force(kPush);
  trial.run(0.004, none);
  trial.expect_force(kPush / 7.0);  // 8 ms; the fade runs from 1 at 5 ms to 0 at 8.5 ms
  trial.expect_state(GuardState::fading);
  after(trial, none, 0.02);
  expect_recovery(trial);
  after(trial, {.wanted_n = kPush, .frame_age_us = 12'000}, 0.03);
  expect_recovery(trial);
  after(trial, none, 0.06);
  expect_restart(trial);
}

/// Frames that keep coming late, as from a bridge with a slow interval.
void frames_slow(Trial& trial) {
  for (const int interval_ms : {6, 8, 10, 16}) {
    trial.engage(kPush);
    for (int i = 0; i < 2000; ++i) trial.tick({.wanted_n = kPush, .frame = i % interval_ms == 0});
    trial.run(0.5, kPushing);
    trial.expect_force(kPush);
  }
}

void hand_frozen(Trial& trial) {
  trial.engage(kPush);
  for (int i = 0; i < 1000; ++i) {
    trial.tick({.wanted_n = kPush, .frozen = true});
    trial.expect_force(kPush);
    trial.expect(trial.log().back().admission.may_deform, "a hand at rest may deform the clay");
  }
}

void position_jumps(Trial& trial) {
  trial.engage(kPush);
  const Tick elsewhere{.wanted_n = kPush, .jump_mm = {0.0, 15.0, 0.0}};
  after(trial, elsewhere, 0.001);
  trial.expect_force(kPush);
  trial.run(0.002, elsewhere);
  trial.expect_state(GuardState::safe);
  trial.run(0.3, elsewhere);
  expect_restart(trial);
  // Two wrong positions.
  trial.tick(elsewhere);
  trial.tick({.wanted_n = kPush, .jump_mm = {0.0, -15.0, 0.0}});
  trial.expect_state(GuardState::safe);
  after(trial, kPushing, 0.3);
  expect_restart(trial);
}

/// Every 50 ticks a byte is lost or inserted; the codec decides which ticks have a frame.
void bytes_lost(Trial& trial) {
  trial.engage(kPush);
  FrameReader reader;
  const FrameBytes sent = encode({.motors = {100, 200, 300}});
  int missed = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<std::uint8_t> bytes(sent.begin(), sent.end());
    if (i % 100 == 25) bytes.erase(bytes.begin() + i % 16);
    if (i % 100 == 75) bytes.insert(bytes.begin() + i % 16, 'A');
    std::span<const std::uint8_t> rest(bytes);
    const std::optional<StateFrame> frame = reader.next(rest);
    if (!frame) ++missed;
    trial.tick({.wanted_n = kPush, .frame = frame.has_value()});
    trial.expect_force(kPush);
  }
  trial.expect(missed > 0 && missed <= 40, "more than two frames lost per fault");
}

void servo_late(Trial& trial) {
  trial.engage(kPush);
  for (const std::int64_t late_us : {2'000, 5'000, 9'000, 20'000, 45'000}) {
    trial.tick({.wanted_n = kPush, .gap_us = late_us});
    trial.run(0.05, kPushing);
    if (late_us >= 10'000) expect_recovery(trial);
    trial.expect_force(kPush);
  }
  // Again and again: a force that came back between them would shake the hand.
  for (int i = 0; i < 20; ++i) {
    trial.tick({.wanted_n = kPush, .gap_us = 12'000});
    trial.run(0.03, kPushing);
  }
  expect_recovery(trial);
  trial.tick({.wanted_n = kPush, .gap_us = 100'000});
  trial.expect_state(GuardState::safe);
  trial.run(0.3, kPushing);
  expect_restart(trial);
}

void clay_starved(Trial& trial) {
  trial.engage(kPush);
  const Tick starved{.wanted_n = kPush, .clay_new = false};
  trial.run(0.1, starved);
  trial.expect_force(kPush);
  trial.run(0.025, starved);
  trial.expect_force(0.5 * kPush);
  trial.run(1.0, starved);
  trial.run(0.1, kPushing);
  expect_restart(trial);
}

void clock_wrong(Trial& trial) {
  trial.engage(kPush);
  for (const std::int64_t jump : {-kHourUs, std::int64_t{-500}, std::int64_t{-3'000}}) {
    after(trial, {.wanted_n = kPush, .clock_jump_us = jump}, 0.001);
    trial.expect_force(kPush);
  }
  after(trial, {.wanted_n = 2.0 * kPush, .clock_stopped = true}, 0.004);
  trial.expect_force(kPush);
  after(trial, {.wanted_n = kPush, .clock_stopped = true, .frame = false}, 0.1);
  expect_recovery(trial);
  for (const std::int64_t jump : {kHourUs, INT64_MAX, INT64_MAX}) {
    trial.tick({.wanted_n = kPush, .clock_jump_us = jump});
    trial.run(0.3, kPushing);
    trial.engage(kPush);
  }
}

void loop_unstable(Trial& trial) {
  trial.engage(kPush);
  after(trial, {.wanted_n = kPush, .passive = false}, 0.001);
  expect_latched(trial);
}

void stopped(Trial& trial) {
  trial.engage(kPush);
  trial.tick({.wanted_n = kPush, .command = Tick::Command::stop});
  trial.run(0.3, kAtRest);
  trial.run(0.3, kPushing);
  trial.rearm();
  trial.run(0.3, kAtRest);
  trial.run(0.3, kPushing);
  trial.expect_state(GuardState::safe);
}

void motors_hot(Trial& trial) {
  const Tick hard{.wanted_n = 1.5 * kPush};
  trial.engage(hard.wanted_n);
  trial.run(7.0, hard);
  trial.expect_force(hard.wanted_n);
  trial.run(5.0, hard);
  trial.expect_state(GuardState::waiting);
  trial.engage(kPush);
}

}  // namespace

std::span<const GuardFault> guard_faults() {
  static constexpr GuardFault kFaults[] = {
      {1, "position not finite", position_not_finite},
      {2, "force not finite", force_not_finite},
      {3, "force spikes", force_spikes},
      {4, "start inside the clay", start_inside_the_clay},
      {5, "homing lost", homing_lost},
      {6, "unplugged", unplugged},
      {7, "frames stale", frames_stale},
      {8, "hand frozen", hand_frozen},
      {9, "position jumps", position_jumps},
      {10, "bytes lost", bytes_lost},
      {11, "servo late", servo_late},
      {12, "clay starved", clay_starved},
      {13, "clock wrong", clock_wrong},
      {14, "loop unstable", loop_unstable},
      {15, "stopped", stopped},
      {17, "motors hot", motors_hot},
      {19, "frames slow", frames_slow},
  };
  return kFaults;
}

}  // namespace clay::falcon
