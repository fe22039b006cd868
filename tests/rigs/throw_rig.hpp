#pragma once
// The sample's stroke on an emulated device, and the expected results of a throw.

#include "app/servo/mapping.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"
#include "tests/falcon/device/dummy_firmware.hpp"
#include "tests/rigs/falcon_gadget.hpp"
#include "tests/rigs/hid_gadget.hpp"
#include "tests/rigs/testbed.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/wait_until.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

namespace clay::rig {

using namespace clay::falcon;
using test::claystack;
using test::Program;
using test::Ran;

// Frames with the hand off the clay; after them most of the force has ramped up.
inline constexpr std::uint64_t kLeadFrames = 800;

/// The bowl's stroke, in the frame of Kinematics. Two poses per frame, because emulated frames are
/// slow.
inline Trajectory bowl_stroke() {
  const std::string path = test::sample("paper/bowl.session");
  const Session session = parse_session(read_file(path).value(), path).value();
  const auto mapping = servo::Mapping::build({}).value();
  std::vector<glm::dvec3> positions;
  for (const Pose& pose : session.poses)
    positions.push_back(kFalconCentreMm + mapping.to_device(pose.position_mm));
  return [positions](std::uint64_t frame) {
    const std::uint64_t at = frame > kLeadFrames ? 2 * (frame - kLeadFrames) : 0;
    return positions[std::min<std::uint64_t>(at, positions.size() - 1)];
  };
}

inline FalconModelSettings ready() {
  FalconModelSettings model;
  model.loaded = model.homed = true;
  return model;
}

/// In its scope, programs preload this backend of hidapi.
class Backend {
 public:
#ifdef CLAYSTACK_HIDAPI_LIBUSB
  Backend() { setenv("LD_PRELOAD", (before_ + ":" CLAYSTACK_HIDAPI_LIBUSB).c_str(), 1); }
#else
  Backend() = default;
#endif
  ~Backend() { setenv("LD_PRELOAD", before_.c_str(), 1); }
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;

 private:
  std::string before_ = std::getenv("LD_PRELOAD");  // set by umockdev
};

class ThrowRig : public testing::Test {
 protected:
  std::string bowl_on(const std::string& device, const std::string& more) {
    return "throw " + test::sample("paper/bowl.scene.json") + " --device " + device +
           " --json --record " + folder_.file("s.session") + " -o " +
           folder_.file("live.pot.json") + " " + more;
  }
  Program begin(const std::string& device, const std::string& more) {
    const Backend backend;
    return Program("exec " CLAYSTACK_PROGRAM " " + bowl_on(device, more));
  }
  Ran throw_bowl(const std::string& device, const std::string& more) {
    return begin(device, more).wait();
  }

  /// Waits for a condition during a throw; the end of the throw also ends the wait.
  template <class Condition>
  static void until(Program& program, Condition condition, const std::string& what) {
    test::wait_until([&] { return !program.running() || condition(); }, test::kProgramDeadline,
                     what);
  }
  template <class Gadget>
  static void wait_for_frames(Program& program, Gadget& gadget, std::size_t frames) {
    const auto received = [&] {
      const std::scoped_lock held(gadget.lock);
      return gadget.device.log.size() >= frames;
    };
    until(program, received, "frame " + std::to_string(frames) + " of the device");
  }
  /// Stops the throw with SIGINT.
  static Ran stop(Program& program) {
    program.send(SIGINT);
    return program.wait();
  }

  /// Throws until the device has received `frames` frames, at any speed.
  template <class Gadget>
  Ran throw_frames(Gadget& gadget, std::size_t frames, const std::string& device,
                   const std::string& more) {
    Program program = begin(device, more);
    wait_for_frames(program, gadget, frames);
    return stop(program);
  }

  /// A firmware file for a cold start: it is loaded and echoed, and the grip is homed.
  std::string firmware() {
    const std::string path = folder_.file("firmware.bin");
    const auto bytes = dummy_firmware();
    test::write_text(path, {bytes.begin(), bytes.end()});
    return "--firmware " + path;
  }

  /// At least 5000 frames without homing, and none of them bad.
  static void expect_no_bad_frame(const Ran& run, std::size_t frames) {
    const auto device = run.json().at("frames");
    EXPECT_GE(device.at("taken"), frames);
    EXPECT_EQ(device.at("bytes_discarded"), 0);
    EXPECT_EQ(device.at("without_pose"), 0);
  }

  /// The pot of the recorded session, without any device.
  std::string replayed() {
    const auto run =
        claystack("throw -q " + test::sample("paper/bowl.scene.json") + " -s " +
                  folder_.file("s.session") + " -o " + folder_.file("replay.pot.json"));
    EXPECT_EQ(run.status, 0) << run.err;
    return test::read_text(folder_.file("replay.pot.json"));
  }
  std::string thrown() { return test::read_text(folder_.file("live.pot.json")); }

  /// The last recorded distance of the tool from the axis [mm].
  double tool_mm() {
    std::string path = folder_.file("s.session.recording");  // until it is complete
    if (!std::filesystem::exists(path)) path = folder_.file("s.session");
    const auto session = parse_session(test::read_text(path), path);
    if (!session || session->poses.empty()) return std::numeric_limits<double>::infinity();
    return session->poses.back().position_mm.x;
  }

  /// Each recorded pose is a position of the hand, within half an encoder step on each leg.
  void expect_true_positions(const std::vector<FrameLog>& log) {
    const std::string path = folder_.file("s.session");
    const Session session = parse_session(test::read_text(path), path).value();
    ASSERT_GT(session.poses.size(), 100u);
    const auto mapping = servo::Mapping::build({}).value();
    for (const Pose& pose : session.poses) {
      const glm::dvec3 position_mm = kFalconCentreMm + mapping.to_device(pose.position_mm);
      const auto at = std::ranges::min_element(log, {}, [&](const FrameLog& frame) {
        return glm::distance(frame.position_mm, position_mm);
      });
      ASSERT_LT(glm::distance(at->position_mm, position_mm), 0.07) << pose.time_us;
    }
  }

  /// Each recorded pose is a position of the hand, and the motor torque in the next frame points in
  /// the direction of the replayed clay's force. If a loaded machine delayed the servo, the guard
  /// and the measured rate decide the magnitude.
  void expect_displayed_force(const Ran& run, const std::vector<FrameLog>& log) {
    const std::string scene_path = test::sample("paper/bowl.scene.json");
    Wheel wheel =
        Wheel::build(parse_scene(test::read_text(scene_path), scene_path).value()).value();
    const std::string path = folder_.file("s.session");
    const Session session = parse_session(test::read_text(path), path).value();
    ASSERT_GT(session.poses.size(), 100u);
    const auto mapping = servo::Mapping::build({}).value();
    constexpr double kClearN = 0.05;  // some steps of the motors, so that they show the direction
    double farthest_mm = 0.0, along = 0.0, lengths = 0.0, displayed_ns = 0.0, clay_ns = 0.0;
    for (const Pose& pose : session.poses) {
      const glm::dvec3 position_mm = kFalconCentreMm + mapping.to_device(pose.position_mm);
      const auto at = std::ranges::min_element(log, {}, [&](const FrameLog& frame) {
        return glm::distance(frame.position_mm, position_mm);
      });
      farthest_mm = std::max(farthest_mm, glm::distance(at->position_mm, position_mm));
      const glm::dvec3 clay_n = wheel.step(pose).force_n();
      if (at + 1 == log.end()) continue;
      const glm::dvec3& displayed_n = (at + 1)->force_n;
      if (glm::length(displayed_n) > kClearN) {
        along += glm::dot(displayed_n, clay_n);
        lengths += glm::length(displayed_n) * glm::length(clay_n);
      }
      displayed_ns += 1e-3 * glm::length(displayed_n);
      clay_ns += 1e-3 * glm::length(mapping.force_to_device(clay_n));
    }
    EXPECT_LT(farthest_mm, 0.07) << "half an encoder's step on each leg";
    EXPECT_GT(clay_ns, 0.0);
    EXPECT_GE(along, 0.95 * lengths);
    double max_force_n = 0.0;
    for (const FrameLog& frame : log)
      max_force_n = std::max(max_force_n, glm::length(frame.force_n));
    const auto servo = run.json().at("servo");
    constexpr double kFastHz = 500.0;  // below, the stiffness accepted at this rate is low
    if (servo.at("rate_hz") > kFastHz && !servo.at("guard").at("safe").contains("overrun")) {
      EXPECT_GT(displayed_ns, 0.2 * clay_ns) << "the full force, except during the ramp";
      EXPECT_GT(max_force_n, 0.1);
      EXPECT_GT(lengths, 0.0) << "some force is above kClearN";
    }
    EXPECT_LT(max_force_n, 5.1) << "the limit plus motor rounding";
    EXPECT_EQ(log.back().motors, LegCounts{}) << "the last command";
  }

  test::ScratchFolder folder_;
  Testbed testbed_;
};

inline constexpr std::size_t kFrames = 5000;
inline constexpr std::size_t kHomingFrames = 3 * 20 + kLeadFrames;

}  // namespace clay::rig
