// The servo loop on a virtual clock, so that every fault is exactly repeatable.

#include "app/servo/words.hpp"
#include "tests/app/servo/live_bench.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace clay::servo {
namespace {

using falcon::GuardState;

constexpr double kLimitN = 5.0;
constexpr double kRisePerTickN = 0.5 * 1.05;  // 500 N/s; frames arrive within 5 % of 1 ms

Pot replayed(const SceneSpec& scene, const std::string& session) {
  Wheel wheel = Wheel::build(scene).value();
  const Session played = parse_session(test::read_text(session), session).value();
  for (const Pose& pose : played.poses) wheel.step(pose);
  return wheel.pot();
}

TEST(LiveLoop, RecordedSessionReplaysToTheSamePot) {
  const test::ScratchFolder folder;
  for (const char* name : {"bowl", "cylinder", "collapse"}) {
    const SceneSpec scene = sample_scene(name);
    const Mapping mapping = Mapping::build({}).value();
    const auto recorder =
        Recorder::create(folder.file("s.session"), scene.name, hash_of(scene)).value();
    const auto path = hand_path(sample_stroke(name), mapping);
    VirtualThrow live(scene, {}, path, recorder.get());
    // The recorder empties its queue in real time, so the number of ticks is limited.
    for (int i = 0; i < 4000 && live.tick() == Ending::none; ++i) {
    }
    ASSERT_TRUE(recorder->finish());
    EXPECT_EQ(recorder->lost(), 0u);
    EXPECT_GT(recorder->taken(), 3700u) << name;
    EXPECT_EQ(live.wheel.pot(), replayed(scene, folder.file("s.session"))) << name;
    EXPECT_NE(live.wheel.pot(), Wheel::build(scene)->pot()) << "nothing was thrown";
    EXPECT_EQ(live.status().volume_error, 0.0);
  }
}

TEST(LiveLoop, ForcePushesTheHandOutOfTheClay) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  double max_force_n = 0.0, before_n = 0.0;
  for (int i = 0; i < 3200; ++i) {
    live.tick();
    const glm::dvec3 sent = live.status().force_n;
    const double n = glm::length(sent);
    ASSERT_LE(n, kLimitN);
    ASSERT_LE(n - before_n, kRisePerTickN) << i;
    ASSERT_GE(sent.x, 0.0);
    // Friction is a fifth of the spring force, in the direction of rotation: -z at x > 0. The tool
    // is off the x axis by at most an encoder step, 0.05 mm in 40.
    ASSERT_NEAR(sent.z, -0.2 * sent.x, 2e-3 * sent.x);
    max_force_n = std::max(max_force_n, n);
    before_n = n;
  }
  // 41 rings of 0.5 mm, 0.02 N/mm2, less than 2 mm deep because the clay yields.
  EXPECT_GT(max_force_n, 0.1);
  EXPECT_LT(max_force_n, 0.02 * 20.5 * 2.0 * std::hypot(1.0, 0.2));
  EXPECT_EQ(live.status().guard, GuardState::engaged);
}

TEST(LiveLoop, DeviceReceivesOnlyTheGuardedForce) {
  // In the clay long before the force has ramped up.
  const HandAt late = press_to(2.0);
  VirtualThrow live(rib_scene(), one_to_one(), [=](double t) { return late(t + 2.0); });
  double max_force_n = 0.0;
  for (int i = 0; i < 1800; ++i) {
    live.tick();
    ASSERT_LT(glm::distance(live.model->force_n(), live.status().force_n), 0.05) << i;
    max_force_n = std::max(max_force_n, glm::length(live.model->force_n()));
    ASSERT_LE(max_force_n, live.status().force_gain * 0.9 + 0.05)
        << "0.02 N/mm2, 20.5 mm, 2 mm; friction";
  }
  EXPECT_GT(max_force_n, 0.1);
}

// In at a fifth of the force, out at the full force: the hand gets more energy than it gave. The
// controller must include the ramp to damp this energy.
TEST(LiveLoop, PassivityControllerCountsARampDuringContact) {
  SceneSpec scene = rib_scene();
  scene.removal.rate_per_s = 1e-9;
  scene.force->friction = 0.0;
  const auto damped_ticks_entering_at = [&](double in_s) {
    const HandAt in_and_out = [=](double t) {
      const double part = std::clamp(std::min(t - in_s, in_s + 3.0 - t) / 0.4, 0.0, 1.0);
      return glm::dvec3(2.0 - 7.0 * part, 0.0, 0.0);
    };
    VirtualThrow live(scene, one_to_one(), in_and_out);
    live.run(in_s + 4.0);
    EXPECT_EQ(live.loop->events().safe[static_cast<std::size_t>(falcon::SafeCause::not_passive)],
              0u);
    return live.loop->events().damped;
  };
  EXPECT_GT(damped_ticks_entering_at(0.3), 0u);
  EXPECT_EQ(damped_ticks_entering_at(2.5), 0u)
      << "after the ramp the spring returns only what it took";
}

TEST(LiveLoop, AllocatesNothing) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  live.run(0.1);
  const std::size_t before = allocation_count();
  live.run(3.0);
  EXPECT_EQ(allocation_count(), before);
  EXPECT_GT(live.status().poses, 2500u);
}

TEST(LiveLoop, ForceHasTheStiffnessOfTheMapping) {
  // The clay does not yield, so the force is that of the spring alone.
  SceneSpec scene = rib_scene();
  scene.removal.rate_per_s = 1e-9;
  scene.force->friction = 0.0;
  for (const auto& [scale, gain] : {std::pair{1.0, 0.0}, {2.0, 0.0}, {2.0, 0.7}, {0.5, 0.5}}) {
    LiveSettings settings = one_to_one();
    settings.mapping.scale = scale;
    settings.mapping.force_gain = gain;
    double sent_n[2] = {};
    for (const double depth : {0.5, 1.0}) {
      VirtualThrow live(scene, settings, press_to(depth));
      live.run(3.5);
      sent_n[depth > 0.6 ? 1 : 0] = live.status().force_n.x;
    }
    const double stiffness = (sent_n[1] - sent_n[0]) / 0.5;
    const double rings = 41.0, mapped = gain == 0.0 ? 1.0 : gain * scale;
    // An encoder step, 0.05 mm, is a tenth of 0.5 mm.
    EXPECT_NEAR(stiffness, mapped * 0.02 * 0.5 * rings, 0.15 * stiffness) << scale << " " << gain;
  }
}

/// Starts in the clay, then moves the hand up along the wall.
void move_up(VirtualThrow& live) {
  live.run(3.2);
  ASSERT_GT(glm::length(live.status().force_n), 0.1);
  const double from_s = live.time_s;
  live.hand = [=](double t) { return glm::dvec3(-2.0, 20.0 * (t - from_s), 0.0); };
}

TEST(LiveLoop, ClutchDecouplesTheToolFromTheHand) {
  VirtualThrow coupled(rib_scene(), one_to_one(), press_to(2.0));
  move_up(coupled);
  const Pot before = coupled.wheel.pot();
  coupled.run(1.0);
  ASSERT_NE(coupled.wheel.pot(), before) << "without the clutch, the same movement moves clay";

  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  move_up(live);
  const glm::dvec3 tool = live.status().tool_mm;
  live.model->press(kFalconButtons.clutch);
  live.tick(), live.tick();  // the frame with the button is in transit
  const Pot clutched = live.wheel.pot();
  live.run(1.0);
  EXPECT_TRUE(live.status().clutched);
  EXPECT_EQ(glm::length(live.status().force_n), 0.0);
  EXPECT_EQ(live.wheel.pot(), clutched);
  live.model->press(0);
  live.tick(), live.tick();
  EXPECT_FALSE(live.status().clutched);
  EXPECT_LT(glm::distance(live.status().tool_mm, tool), 0.2) << "moved by at most two ticks";
  EXPECT_EQ(glm::length(live.status().force_n), 0.0) << "the ramp starts again";
  EXPECT_NE(live.status().guard, GuardState::engaged);
}

// The hand has no place yet when the button is released, or none that the guard would accept.
TEST(LiveLoop, ReleasedClutchKeepsOnlyATrustedPlace) {
  const Mapping mapping = Mapping::build(one_to_one().mapping).value();
  const auto at_the_hand = [&](const VirtualThrow& live) {
    return glm::distance(live.status().tool_mm, mapping.to_clay(live.hand(live.time_s)));
  };
  VirtualThrow early(rib_scene(), one_to_one(), press_to(2.0));
  early.model->press(kFalconButtons.clutch);
  early.run(0.5);
  ASSERT_TRUE(early.status().clutched);
  early.model->press(0);
  early.run(0.2);
  EXPECT_LT(at_the_hand(early), 0.2) << "the tool was nowhere before";

  VirtualThrow lost(rib_scene(), one_to_one(), press_to(2.0));
  lost.run(1.0);
  const glm::dvec3 tool = lost.status().tool_mm;
  lost.model->press(kFalconButtons.clutch);
  lost.run(0.1);
  lost.hand = [](double) { return glm::dvec3(30.0, 20.0, 0.0); };
  lost.fault(falcon::WireFault::homing_lost);
  lost.run(0.01);
  ASSERT_EQ(lost.status().device, falcon::DeviceState::needs_homing);
  lost.model->press(0);
  lost.run(3.0);
  ASSERT_EQ(lost.status().device, falcon::DeviceState::ready);
  EXPECT_LT(glm::distance(lost.status().tool_mm, tool), 0.2);
}

TEST(LiveLoop, PauseDoesNotRestoreAZeroedForce) {
  for (const bool zero_first : {true, false}) {
    VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
    live.run(3.2);
    const auto send = [&](CommandKind kind, double value) {
      ASSERT_TRUE(live.commands.push({kind, value}));
      live.run(0.05);
    };
    if (zero_first) send(CommandKind::zero, 0.0);
    send(CommandKind::pause, 1.0);
    if (!zero_first) send(CommandKind::zero, 0.0);
    const Pot before = live.wheel.pot();
    send(CommandKind::pause, 0.0);
    live.run(0.5);
    EXPECT_EQ(live.status().cause, falcon::SafeCause::paused) << zero_first;
    EXPECT_EQ(live.wheel.pot(), before);
    live.model->press(kFalconButtons.clutch);
    live.run(0.1);
    live.model->press(0);
    live.run(0.1);
    EXPECT_EQ(live.status().cause, falcon::SafeCause::none) << "the clutch restores it";
  }
}

TEST(LiveLoop, ForceEngagesOutsideTheClayOnly) {
  for (const double friction : {0.0, 0.2}) {
    SceneSpec scene = rib_scene();
    scene.removal.rate_per_s = 1e-9;
    scene.force->friction = friction;
    VirtualThrow live(scene, one_to_one(), [](double) { return glm::dvec3(-3.0, 0.0, 0.0); });
    live.run(3.0);
    ASSERT_GT(glm::length(live.status().clay_n), 1.0);
    EXPECT_EQ(live.status().guard, GuardState::waiting) << friction;
    EXPECT_NE(words_of(live.status(), "r").find("lift the tool"), std::string::npos);
    live.hand = [from_s = live.time_s](double t) { return press_to(3.0)(t - from_s); };
    live.run(3.2);
    EXPECT_EQ(live.status().guard, GuardState::engaged) << friction;
    EXPECT_GT(glm::length(live.status().force_n), 1.0);
  }
}

// The watchdog may end the force at any moment of a tick. No older force may follow.
TEST(LiveLoop, AForceFromBeforeAShutIsNeverSentAfterIt) {
  int shuts = 0;
  for (int at = 1;; ++at) {
    VirtualThrow live(rib_scene(), one_to_one(), press_to(4.0));
    live.run(3.2);
    ASSERT_GT(glm::length(live.status().force_n), 2.0 * kRisePerTickN);
    int reading = 0;
    live.clock.on_reading = [&] {
      if (++reading == at) live.gate.shut();
    };
    live.tick();
    if (reading < at) break;
    ++shuts;
    if (live.gate.is_shut()) continue;  // shut later in the tick than the force was sent
    EXPECT_LE(glm::length(live.status().force_n), kRisePerTickN) << "at reading " << at;
  }
  EXPECT_GE(shuts, 4);
}

TEST(LiveLoop, PausesAndEndsByCommand) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  live.run(3.2);
  ASSERT_TRUE(live.commands.push({CommandKind::pause, 1.0}));
  live.tick();
  EXPECT_EQ(glm::length(live.status().force_n), 0.0) << "in the same tick";
  const Pot paused = live.wheel.pot();
  live.run(0.2);
  EXPECT_EQ(live.status().guard, GuardState::safe) << "also where a stage forgets the pause";
  EXPECT_EQ(live.status().cause, falcon::SafeCause::paused);
  EXPECT_EQ(live.loop->events().safe[static_cast<std::size_t>(falcon::SafeCause::paused)], 1u)
      << "a pause is one event, however long it lasts";
  EXPECT_EQ(live.wheel.pot(), paused);
  ASSERT_TRUE(live.commands.push({CommandKind::pause, 0.0}));
  live.run(0.2);
  EXPECT_NE(live.wheel.pot(), paused);
  ASSERT_TRUE(live.commands.push({CommandKind::stop, 0.0}));
  EXPECT_EQ(live.tick(), Ending::stopped);
}

TEST(LiveLoop, RefusesAPoseWhoseTimeDoesNotAdvance) {
  for (const std::int64_t period_us : {0, 4000}) {  // below it, poses are only probed
    Wheel wheel = Wheel::build(rib_scene()).value();
    LiveClay clay(wheel, nullptr, period_us);
    const Pose first{2000, {44.0, 30.0, 0.0}, false, 0.0};
    EXPECT_EQ(clay.meet(first).flags & kRefused, 0u);
    Pose earlier = first;
    earlier.time_us = 1000;
    for (const Pose& pose : {first, earlier}) {
      const StepReport report = clay.meet(pose);
      EXPECT_NE(report.flags & kRefused, 0u) << pose.time_us << " us, period " << period_us;
      EXPECT_EQ(glm::length(report.force_n()), 0.0);
    }
    EXPECT_EQ(clay.poses(), 1u);
  }
}

TEST(LiveLoop, MeasuresTheAgeOfAForceFromItsSample) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  live.run(3.0);
  const auto& age = live.loop->timing().age;
  EXPECT_GT(age.count(), 1000u);
  EXPECT_LT(age.most_ns(), 10'000'000) << "no sample was older than 10 ms";
}

TEST(LiveLoop, ZeroesAndRestoresTheForceByCommand) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  live.run(3.2);
  ASSERT_GT(glm::length(live.status().force_n), 0.1);
  ASSERT_TRUE(live.commands.push({CommandKind::zero, 0.0}));
  live.tick();
  EXPECT_EQ(glm::length(live.status().force_n), 0.0) << "in the same tick";
  const Pot before = live.wheel.pot();
  live.run(3.0);
  EXPECT_EQ(glm::length(live.status().force_n), 0.0) << "until a rearm";
  EXPECT_EQ(live.status().cause, falcon::SafeCause::paused);
  EXPECT_EQ(live.wheel.pot(), before);
  ASSERT_TRUE(live.commands.push({CommandKind::rearm, 0.0}));
  live.tick();
  EXPECT_NE(live.status().guard, GuardState::safe);
  // Off the clay, then in again.
  live.hand = [from_s = live.time_s](double t) { return press_to(4.0)(t - from_s); };
  live.run(3.2);
  EXPECT_GT(glm::length(live.status().force_n), 0.1);
  // The later command wins.
  ASSERT_TRUE(live.commands.push({CommandKind::rearm, 0.0}));
  ASSERT_TRUE(live.commands.push({CommandKind::zero, 0.0}));
  live.tick();
  EXPECT_EQ(live.status().guard, GuardState::safe);
}

void unplug_and_reopen(VirtualThrow& live) {
  live.fault(falcon::WireFault::unplugged);
  ASSERT_EQ(live.run(1.0), Ending::device_lost);
  live.model->replug();
  ASSERT_TRUE(live.device.open());
  live.loop->start();
}

/// Off the clay until the force could have ramped up, then in.
Ending press_again(VirtualThrow& live) {
  live.hand = [from_s = live.time_s](double t) { return press_to(4.0)(t - from_s); };
  return live.run(3.2);
}

// The user may have unplugged the arm because of a fault: only the user ends a pause or a zeroed
// force that the user began.
TEST(LiveLoop, KeepsPauseAndZeroedForceWhenTheDeviceIsReopened) {
  for (const auto& [hold, release] :
       {std::pair{Command{CommandKind::zero, 0.0}, Command{CommandKind::rearm, 0.0}},
        std::pair{Command{CommandKind::pause, 1.0}, Command{CommandKind::pause, 0.0}}}) {
    VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
    live.run(3.2);
    ASSERT_GT(glm::length(live.status().force_n), 0.1);
    ASSERT_TRUE(live.commands.push(hold));
    live.tick();
    unplug_and_reopen(live);
    ASSERT_EQ(press_again(live), Ending::none);
    EXPECT_EQ(live.status().guard, GuardState::safe);
    EXPECT_EQ(glm::length(live.status().force_n), 0.0);
    ASSERT_TRUE(live.commands.push(release));
    ASSERT_EQ(press_again(live), Ending::none);
    EXPECT_GT(glm::length(live.status().force_n), 0.1);
  }
}

TEST(LiveLoop, KeepsAnUnstableForceOffWhenTheDeviceIsReopened) {
  SceneSpec scene = rib_scene();
  scene.force->stiffness_n_per_mm2 = 0.5;
  // The hand rattles at 150 Hz in stiff clay.
  const HandAt rattle = [press = press_to(1.0)](double t) {
    return press(t) - glm::dvec3(t < 3.0 ? 0.0 : 0.5 * std::sin(300.0 * M_PI * t), 0.0, 0.0);
  };
  LiveSettings settings = one_to_one();
  settings.arm.damping_ns_per_mm = 0.02;  // takes the stiffness
  VirtualThrow live(scene, settings, rattle);
  live.run(8.0);
  ASSERT_EQ(live.status().cause, falcon::SafeCause::not_passive);
  unplug_and_reopen(live);
  ASSERT_EQ(press_again(live), Ending::none);
  EXPECT_EQ(live.status().cause, falcon::SafeCause::not_passive);
  EXPECT_EQ(glm::length(live.status().force_n), 0.0);
  ASSERT_TRUE(live.commands.push({CommandKind::rearm, 0.0}));
  ASSERT_EQ(press_again(live), Ending::none);
  EXPECT_GT(glm::length(live.status().force_n), 0.1);
}

TEST(LiveLoop, StopsWaitingForHomingIfSecondsAreSet) {
  falcon::FalconModelSettings unhomed = VirtualThrow::homed();
  unhomed.homed = false;
  unhomed.homing_frames = 1 << 30;
  LiveSettings settings = one_to_one();
  settings.seconds = 2.0;
  VirtualThrow live(rib_scene(), settings, press_to(2.0), nullptr, unhomed);
  EXPECT_EQ(live.run(59.9), Ending::none) << "homing by hand takes time";
  EXPECT_EQ(live.run(1.0), Ending::time_up);
  EXPECT_EQ(live.status().poses, 0u);
  EXPECT_EQ(live.status().device, falcon::DeviceState::needs_homing);

  settings.seconds = 0.0;
  VirtualThrow unlimited(rib_scene(), settings, press_to(2.0), nullptr, unhomed);
  EXPECT_EQ(unlimited.run(200.0), Ending::none);

  settings.seconds = 90.0;
  VirtualThrow longer(rib_scene(), settings, press_to(2.0), nullptr, unhomed);
  EXPECT_EQ(longer.run(89.9), Ending::none) << "not before the requested time";
  EXPECT_EQ(longer.run(1.0), Ending::time_up);
}

TEST(LiveLoop, SecondsCountDuringAPause) {
  LiveSettings settings = one_to_one();
  settings.seconds = 2.0;
  VirtualThrow live(rib_scene(), settings, press_to(2.0));
  live.run(0.5);
  ASSERT_TRUE(live.commands.push({CommandKind::pause, 1.0}));
  EXPECT_EQ(live.run(1.4), Ending::none);
  EXPECT_EQ(live.run(0.2), Ending::time_up);
}

TEST(LiveLoop, ReducedClayRateKeepsTheForceRate) {
  LiveSettings settings = one_to_one();
  settings.clay_rate_hz = 50.0;
  const test::ScratchFolder folder;
  const auto recorder = Recorder::create(folder.file("s.session"), "rib", 0).value();
  // 16 mm/s: at most three ticks per encoder step.
  VirtualThrow live(rib_scene(), settings, press_to(6.0), recorder.get());
  live.run(2.65);
  int changed = 0, deformed = 0;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 force = live.status().force_n;
    const std::uint64_t poses = live.status().poses;
    live.tick();
    const bool moved = live.status().poses != poses;
    deformed += moved;
    changed += !moved && live.status().force_n != force;
  }
  EXPECT_NEAR(deformed, 300 / 20, 1);
  EXPECT_GT(changed, 100) << "the force follows the hand between steps of the clay";
  ASSERT_TRUE(recorder->finish());
  const auto poses = parse_session(test::read_text(folder.file("s.session")), "s").value().poses;
  EXPECT_EQ(poses.size(), live.status().poses);
  for (std::size_t i = 1; i < poses.size(); ++i)
    EXPECT_GE(poses[i].time_us - poses[i - 1].time_us, 10'000);
  EXPECT_EQ(live.wheel.pot(), replayed(rib_scene(), folder.file("s.session")));
}

TEST(LiveLoop, EndsAfterTheRequestedSecondsAndOnACollapse) {
  LiveSettings settings = one_to_one();
  settings.seconds = 1.0;
  VirtualThrow short_throw(rib_scene(), settings, press_to(2.0));
  EXPECT_EQ(short_throw.run(5.0), Ending::time_up);
  EXPECT_NEAR(short_throw.status().time_s, 1.0, 0.002);

  SceneSpec scene = sample_scene("collapse");
  const auto path = hand_path(sample_stroke("collapse"), Mapping::build({}).value());
  VirtualThrow collapsing(scene, {}, path);
  EXPECT_EQ(collapsing.run(60.0), Ending::collapsed);
  EXPECT_TRUE(collapsing.wheel.pot().collapse.has_value());
  EXPECT_EQ(glm::length(collapsing.status().force_n), 0.0);
}

TEST(Words, ReportAForceThatIsOffBeforeTheRingLimit) {
  LiveStatus status;
  status.device = falcon::DeviceState::ready;
  status.guard = GuardState::engaged;
  status.ring_limit = true;
  EXPECT_NE(words_of(status, "r").find("lump.max_rings"), std::string::npos);
  status.guard = GuardState::safe;
  status.cause = falcon::SafeCause::not_passive;
  EXPECT_TRUE(waits_for_rearm(status));
  EXPECT_NE(words_of(status, "r").find("press r"), std::string::npos) << words_of(status, "r");
}

/// Every second answer is missing. A tick without a frame takes 1.5 periods, so frames come at 400
/// Hz.
TEST(LiveLoop, ReportsSlowSamples) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  live.run(3.5);
  EXPECT_EQ(live.status().slow_hz, 0.0);
  EXPECT_EQ(words_of(live.status(), "r"), "throwing");
  for (int i = 0; i < 500; ++i) {
    live.fault(falcon::WireFault::no_frame);
    live.run(0.0025);
  }
  EXPECT_NEAR(live.status().slow_hz, 400.0, 0.15 * 400.0);
  EXPECT_NE(words_of(live.status(), "r").find(" Hz"), std::string::npos);
  live.run(0.5);
  EXPECT_EQ(live.status().slow_hz, 0.0);
}

/// A bridge may answer after 4 ms, with several frames on their way: the force is late by four
/// ticks, and the accepted stiffness is b / (2 * 4 + 1) T, with the T of the readings. The time is
/// measured at each opening.
TEST(LiveLoop, DeviceThatAnswersLateFeelsSofter) {
  SceneSpec scene = rib_scene();
  scene.removal.rate_per_s = 1e-9;
  scene.force->friction = 0.0;
  scene.force->stiffness_n_per_mm2 = 1.0;
  const LiveSettings settings = one_to_one();
  ASSERT_TRUE(soften(scene, settings));
  VirtualThrow live(scene, settings, press_to(1.0));
  const auto pressed = [&](std::int64_t answer_us) {
    live.line->answer_after(answer_us);
    EXPECT_TRUE(live.device.open());
    live.loop->start();
    live.hand = [from_s = live.time_s](double t) { return press_to(1.0)(t - from_s); };
    live.run(4.0);
    return live.status();
  };
  const LiveStatus soon = pressed(1000), late = pressed(4000);
  EXPECT_NEAR(pressed(1000).force_n.x, soon.force_n.x, 1e-3);
  // An encoder step, 0.05 mm, is a twentieth of the depth.
  EXPECT_NEAR(soon.force_n.x, 0.002 * 1000.0 / 3.0, 0.1 * soon.force_n.x);
  EXPECT_EQ(soon.answer_ms, 0.0);
  EXPECT_NEAR(late.force_n.x, 0.002 * late.slow_hz / 9.0, 0.1 * late.force_n.x);
  EXPECT_EQ(late.answer_ms, 4.0);
  EXPECT_NE(words_of(late, "r").find("answers after 4.0 ms"), std::string::npos);
}

TEST(LiveLoop, ProvidesTheOutlineOfTheClay) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  live.run(3.5);
  ASSERT_TRUE(live.commands.push({CommandKind::stop, 0.0}));
  live.tick();  // the last tick is always shown
  const LiveProfile& profile = live.view.profile.newest();
  const auto rings = live.wheel.stack().rings();
  ASSERT_EQ(profile.size, rings.size());
  for (std::size_t i = 0; i < rings.size(); ++i)
    EXPECT_FLOAT_EQ(profile.rows[i].outer_mm, static_cast<float>(rings[i].outer_mm()));
  EXPECT_LT(profile.rows[60].outer_mm, 40.0f) << "pressed in at mid-height";
}

}  // namespace
}  // namespace clay::servo
