// The public component, as used by a program that embeds the servo.

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/servo/servo.hpp"
#include "tests/app/servo/live_bench.hpp"
#include "tests/app/servo/scripted_device.hpp"
#include "tests/support/no_new_threads.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/wait_until.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace clay::servo {
namespace {

template <class Condition>
void wait_for(Condition condition, const std::string& what) {
  test::wait_until(condition, test::kDeadline, what);
}

struct Embedded {
  explicit Embedded(const std::string& session = {}) {
    LiveSettings settings = one_to_one();
    settings.guard.ramp_s = 0.1;
    settings.guard.safe_rest_s = 0.01;
    live.emplace(
        LiveThrow::build(
            {.wheel = wheel, .device = device, .scene = scene, .session_path = session}, settings)
            .value());
  }
  void throw_until_force() {
    live->start(Pace::thread);
    wait_for([&] { return log.last_force_n > 0.0; }, "a force");
  }
  Ending stop() {
    wait_for([&] { return live->command({CommandKind::stop}); }, "room for a command");
    return live->join();
  }

  WireLog log;
  ScriptedDevice device{log};
  SceneSpec scene = rib_scene();
  Wheel wheel = Wheel::build(scene).value();
  std::optional<LiveThrow> live;
};

TEST(LiveThrow, DisplaysAForceUntilStopped) {
  Embedded embedded;
  EXPECT_FALSE(embedded.live->running());
  embedded.throw_until_force();
  EXPECT_TRUE(embedded.live->running());
  wait_for([&] { return embedded.live->status().poses > 0; }, "poses");
  wait_for([&] { return embedded.live->profile().size > 0; }, "a profile");
  EXPECT_EQ(embedded.live->profile().size, embedded.scene.lump.rings);
  EXPECT_EQ(embedded.stop(), Ending::stopped);
  EXPECT_EQ(embedded.log.last_force_n, 0.0);
  EXPECT_EQ(embedded.log.stops, 1u);
  EXPECT_LE(embedded.log.max_force_n, 5.0);
  EXPECT_EQ(embedded.live->status().ending, Ending::stopped);
}

TEST(LiveThrow, RecordedSessionReplaysToThePot) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("a.session");
  Embedded embedded(path);
  embedded.throw_until_force();
  EXPECT_EQ(embedded.stop(), Ending::stopped);
  ASSERT_TRUE(embedded.live->finish_recording());
  const auto session =
      read_file(path).and_then([&](const std::string& text) { return parse_session(text, path); });
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_EQ(session->poses.size(), embedded.live->status().poses);
  Wheel again = Wheel::build(embedded.scene).value();
  for (const Pose& pose : session->poses) again.step(pose);
  EXPECT_TRUE(again.pot() == embedded.wheel.pot());
}

/// Stores the poses and flags that it receives.
class StoredPoses final : public PoseSink {
 public:
  Result<void> append(const PoseBlock& block) override {
    poses.insert(poses.end(), block.poses.begin(), block.poses.end());
    contact.insert(contact.end(), block.contact.begin(), block.contact.end());
    return {};
  }
  Result<void> finish() override { return {}; }

  std::vector<Pose> poses;
  std::vector<bool> contact;
};

TEST(LiveThrow, TicksOnAGivenClockAndRecordsContactFlags) {
  double time_s = 0.0;
  auto model = std::make_shared<falcon::FalconModel>(
      VirtualThrow::homed(), [&](const glm::dvec3&, double dt_s) {
        time_s += dt_s;
        return falcon::kFalconCentreMm + press_to(2.0)(time_s);
      });
  auto line = std::make_unique<falcon::LoopbackTransport>(model, falcon::SimClock::stepped);
  LineClock clock(*line);
  const auto arm = falcon::make_falcon(std::move(line), {});
  ASSERT_TRUE(arm->open());
  StoredPoses stored;
  const SceneSpec scene = rib_scene();
  Wheel wheel = Wheel::build(scene).value();
  auto live =
      LiveThrow::build(
          {.wheel = wheel, .device = *arm, .scene = scene, .sink = &stored, .clock = &clock},
          one_to_one())
          .value();
  live.start(Pace::stepped);
  live.advance(clock.now_ns() + 4'000'000'000);
  EXPECT_TRUE(live.running());
  EXPECT_NEAR(live.status().time_s, 4.0, 0.01);
  EXPECT_NE(live.new_profile(), nullptr);
  EXPECT_EQ(live.new_profile(), nullptr) << "no new profile since the last call";
  EXPECT_EQ(live.stop(), Ending::stopped);
  ASSERT_TRUE(live.finish_recording());
  EXPECT_EQ(live.recorded().poses, stored.poses.size());
  EXPECT_EQ(live.recorded().lost, 0u);
  EXPECT_EQ(live.status().poses, stored.poses.size());

  Wheel again = Wheel::build(scene).value();
  std::vector<bool> contact;
  for (const Pose& pose : stored.poses) contact.push_back((again.step(pose).flags & kContact) != 0);
  EXPECT_EQ(contact, stored.contact);
  EXPECT_GT(std::ranges::count(contact, true), 0);
  EXPECT_GT(std::ranges::count(contact, false), 0);
  EXPECT_EQ(again.pot(), wheel.pot());
}

TEST(LiveThrow, ContinuesWithAReconnectedDevice) {
  Embedded embedded;
  embedded.throw_until_force();
  embedded.log.gone = true;
  EXPECT_EQ(embedded.live->join(), Ending::device_lost);
  EXPECT_EQ(embedded.log.last_force_n, 0.0);
  const std::uint64_t poses = embedded.live->status().poses;
  embedded.log.gone = false;
  embedded.live->start(Pace::thread);
  wait_for([&] { return embedded.live->status().poses > poses + 20; }, "more poses");
  EXPECT_EQ(embedded.stop(), Ending::stopped);
}

/// Time passes only while the servo sleeps.
class SteppedClock final : public Clock {
 public:
  std::int64_t now_ns() noexcept override { return ns_; }
  void sleep_until_ns(std::int64_t time_ns) noexcept override { ns_ = std::max(ns_, time_ns); }

 private:
  std::int64_t ns_ = 3'600'000'000'000;
};

// A key that toggles the pause reads the status: it must not read the defaults.
TEST(LiveThrow, ShowsThePauseBeforeTheFirstTickAfterAReconnection) {
  WireLog log;
  ScriptedDevice device(log);
  const SceneSpec scene = rib_scene();
  Wheel wheel = Wheel::build(scene).value();
  SteppedClock clock;
  auto live = LiveThrow::build({.wheel = wheel, .device = device, .scene = scene, .clock = &clock},
                               one_to_one())
                  .value();
  ASSERT_TRUE(live.start(Pace::stepped));
  EXPECT_FALSE(live.status().paused);
  live.advance(clock.now_ns() + 100'000'000);
  ASSERT_TRUE(live.command({CommandKind::pause, 1.0}));
  live.advance(clock.now_ns() + 100'000'000);
  log.gone = true;
  ASSERT_EQ(live.join(), Ending::device_lost);
  const std::uint64_t ticks = live.status().ticks;
  log.gone = false;
  ASSERT_TRUE(live.start(Pace::stepped));
  EXPECT_TRUE(live.status().paused);
  EXPECT_EQ(live.status().ticks, ticks);
  EXPECT_EQ(live.status().ending, Ending::none);
  ASSERT_TRUE(live.command({CommandKind::pause, 0.0}));
  live.advance(clock.now_ns() + 100'000'000);
  EXPECT_FALSE(live.status().paused);
  EXPECT_EQ(live.stop(), Ending::stopped);
}

TEST(LiveThrow, ReportsARecorderThatDoesNotStart) {
  WireLog log;
  ScriptedDevice device(log);
  const SceneSpec scene = rib_scene();
  Wheel wheel = Wheel::build(scene).value();
  StoredPoses stored;
  const test::NoNewThreads none;
  const auto live = LiveThrow::build(
      {.wheel = wheel, .device = device, .scene = scene, .sink = &stored}, one_to_one());
  ASSERT_FALSE(live);
  EXPECT_EQ(live.error().kind, ErrorKind::io);
  EXPECT_TRUE(live.error().message.starts_with("could not start the recorder's thread: "))
      << live.error().message;
}

TEST(LiveThrow, EndForceEndsTheForcePermanently) {
  Embedded embedded;
  embedded.throw_until_force();
  LiveThrow::end_force();
  EXPECT_EQ(embedded.live->join(), Ending::stopped);
  EXPECT_EQ(embedded.log.last_force_n, 0.0);
}

TEST(LiveThrow, RefusesAContactTooStiffForTheArm) {
  WireLog log;
  ScriptedDevice device(log);
  SceneSpec scene = rib_scene();
  scene.force->stiffness_n_per_mm2 = 10.0;
  Wheel wheel = Wheel::build(scene).value();
  const LiveSettings settings = one_to_one();
  const auto refused =
      LiveThrow::build({.wheel = wheel, .device = device, .scene = scene}, settings);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
  EXPECT_EQ(refused.error().message.find("force.stiffness_n_per_mm2: "), 0u);
  const auto factor = soften(scene, settings);
  ASSERT_TRUE(factor);
  EXPECT_LT(*factor, 1.0);
  EXPECT_DOUBLE_EQ(scene.force->stiffness_n_per_mm2, 10.0 * *factor);
  Wheel softer = Wheel::build(scene).value();
  EXPECT_TRUE(LiveThrow::build({.wheel = softer, .device = device, .scene = scene}, settings));
  EXPECT_EQ(soften(scene, settings).value(), 1.0);
}

// A Falcon answers 1000 times a second, even if the servo asks more often.
TEST(LiveThrow, ARateAboveThatOfTheDeviceAcceptsNoStifferContact) {
  const auto accepted = [](double rate_hz, double device_hz = 1000.0) {
    SceneSpec scene = rib_scene();
    scene.force->stiffness_n_per_mm2 = 10.0;
    LiveSettings settings = one_to_one();
    settings.rate_hz = rate_hz;
    settings.arm.rate_hz = device_hz;
    EXPECT_LT(soften(scene, settings).value(), 1.0);
    return scene.force->stiffness_n_per_mm2;
  };
  EXPECT_EQ(accepted(4000.0), accepted(1000.0));
  EXPECT_NEAR(accepted(500.0), accepted(1000.0) / 2.0, 1e-9);
  EXPECT_NEAR(accepted(4000.0, 4000.0), accepted(1000.0) * 4.0, 1e-9);
  SceneSpec scene = rib_scene();
  scene.force->stiffness_n_per_mm2 = 0.05;  // 1 N/mm, half more than an arm at 1 kHz renders
  LiveSettings settings = one_to_one();
  settings.rate_hz = 4000.0;
  const auto refused = check_stiffness(scene, settings);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message.find("or a rate"), std::string::npos)
      << "a higher rate does not help: " << refused.error().message;
  settings.arm.rate_hz = 4000.0;
  EXPECT_TRUE(check_stiffness(scene, settings));
}

TEST(LiveThrow, EndsAtOnceWithADeviceThatIsNotOpen) {
  falcon::FalconModelSettings unloaded;  // it has power and no firmware
  auto model = std::make_shared<falcon::FalconModel>(
      unloaded, [](const glm::dvec3&, double) { return falcon::kFalconCentreMm; });
  const auto arm = falcon::make_falcon(
      std::make_unique<falcon::LoopbackTransport>(model, falcon::SimClock::stepped), {});
  ASSERT_FALSE(arm->open());
  const SceneSpec scene = rib_scene();
  Wheel wheel = Wheel::build(scene).value();
  SteppedClock clock;
  auto live = LiveThrow::build({.wheel = wheel, .device = *arm, .scene = scene, .clock = &clock},
                               one_to_one())
                  .value();
  ASSERT_TRUE(live.start(Pace::stepped));
  live.advance(clock.now_ns() + 100'000'000);
  EXPECT_FALSE(live.running());
  EXPECT_EQ(live.status().ending, Ending::device_lost);
  EXPECT_EQ(arm->problem().fault, falcon::DeviceFault::no_firmware);
}

TEST(LiveThrow, ErrorsNameTheSettingOrSession) {
  WireLog log;
  ScriptedDevice device(log);
  const SceneSpec scene = rib_scene();
  Wheel wheel = Wheel::build(scene).value();
  const auto message = [&](auto change, const std::string& session = {}) {
    LiveSettings settings = one_to_one();
    change(settings);
    const auto live = LiveThrow::build(
        {.wheel = wheel, .device = device, .scene = scene, .session_path = session}, settings);
    return live ? std::string() : live.error().message;
  };
  EXPECT_EQ(message([](LiveSettings&) {}), "");
  EXPECT_EQ(message([](LiveSettings& s) { s.rate_hz = 1.0; }).find("rate_hz: "), 0u);
  EXPECT_EQ(message([](LiveSettings& s) { s.mapping.scale = 0.0; }).find("scale: "), 0u);
  EXPECT_EQ(message([](LiveSettings& s) { s.guard.force_limit_n = 9.0; }).find("force_limit_n: "),
            0u);
  EXPECT_NE(message([](LiveSettings&) {}, "/nowhere/a.session").find("/nowhere/a.session"),
            std::string::npos);
}

}  // namespace
}  // namespace clay::servo
