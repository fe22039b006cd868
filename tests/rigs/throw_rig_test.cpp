// `claystack throw --device` as a user runs it: unmodified libftdi1, libusb and hidapi, and a hand
// that plays the sample's stroke on the emulated device.

#include "../app/run_program.hpp"
#include "claystack/engine/atomic_file.hpp"
#include "claystack/engine/session_file.hpp"
#include "falcon_gadget.hpp"
#include "hid_gadget.hpp"
#include "live/mapping.hpp"
#include "testbed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace clay::rig {
namespace {

using namespace clay::falcon;
using test::claystack;
using test::Ran;

// Frames that the hand stands off the clay, until the force is earned: two seconds, and more.
constexpr std::uint64_t kLeadFrames = 2500;

/// The bowl's stroke, a pose a frame, in the frame of kinematics.hpp.
Trajectory bowl_stroke() {
  const std::string path = test::sample("bowl.session");
  const Session session = parse_session(read_file(path).value(), path).value();
  const auto mapping = live::Mapping::build({}).value();
  std::vector<glm::dvec3> places;
  for (const Pose& pose : session.poses)
    places.push_back(Kinematics::kCentreM + 1e-3 * mapping.to_device(pose.position_mm));
  return [places](std::uint64_t frame) {
    const std::uint64_t at = frame > kLeadFrames ? frame - kLeadFrames : 0;
    return places[std::min<std::uint64_t>(at, places.size() - 1)];
  };
}

FalconModelSettings ready() {
  FalconModelSettings model;
  model.loaded = model.homed = true;
  return model;
}

class ThrowRig : public testing::Test {
 protected:
  Ran throw_bowl(const std::string& device, const std::string& more) {
    return claystack("throw " + test::sample("bowl.scene.json") + " --device " + device +
                     " --json --record " + folder_.file("s.session") + " -o " +
                     folder_.file("live.pot.json") + " " + more);
  }

  /// The pot as the recorded session leaves it: without any device.
  std::string replayed() {
    const auto run =
        claystack("throw -q " + test::sample("bowl.scene.json") + " -s " +
                  folder_.file("s.session") + " -o " + folder_.file("replay.pot.json"));
    EXPECT_EQ(run.status, 0) << run.err;
    return test::read_text(folder_.file("replay.pot.json"));
  }
  std::string thrown() { return test::read_text(folder_.file("live.pot.json")); }

  /// What the hand went through: the poses that were recorded are places of the stroke.
  void expect_stroke(const Trajectory& hand, const std::vector<FrameLog>& log) {
    const std::string path = folder_.file("s.session");
    const Session session = parse_session(test::read_text(path), path).value();
    ASSERT_GT(session.poses.size(), 1000u);
    const auto mapping = live::Mapping::build({}).value();
    double farthest_mm = 0.0;
    std::uint64_t frame = 0;
    for (const Pose& pose : session.poses) {
      // Frames may be dropped, and come in order: the nearest of the next few.
      double nearest_mm = 1e9;
      std::uint64_t nearest = frame;
      for (std::uint64_t next = frame; next < std::min(frame + 200, log.size()); ++next) {
        const double away_mm = glm::distance(
            pose.position_mm, mapping.to_clay(1e3 * (hand(next) - Kinematics::kCentreM)));
        if (away_mm < nearest_mm) nearest_mm = away_mm, nearest = next;
      }
      farthest_mm = std::max(farthest_mm, nearest_mm);
      frame = nearest;
    }
    EXPECT_LT(farthest_mm, 0.15) << "an encoder's step, 1.6 times";
  }

  /// The stroke begins on the axis, from above: the clay pushes the hand up, never down.
  static void expect_push(const std::vector<FrameLog>& log) {
    double up_ns = 0.0, most_n = 0.0;
    for (const FrameLog& frame : log) {
      up_ns += 1e-3 * frame.force_n.y;
      most_n = std::max(most_n, glm::length(frame.force_n));
      ASSERT_GE(frame.force_n.y, -0.05) << "half a motor step";
    }
    EXPECT_GT(up_ns, 0.05);
    EXPECT_GT(most_n, 0.5);
    EXPECT_LT(most_n, 5.1) << "the limit, and the motors' steps";
    EXPECT_EQ(log.back().motors, LegCounts{}) << "the last word";
  }

  test::ScratchFolder folder_;
  Testbed testbed_;
};

TEST_F(ThrowRig, AStockFalconThrowsTheSample) {
  const Trajectory hand = bowl_stroke();
  FalconGadget gadget(ready(), hand);
  const UsbPlug plug(testbed_.get(), gadget);
  const auto run = throw_bowl("falcon", "--seconds 5");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = run.json();
  EXPECT_EQ(json.at("ended"), "time_up");
  EXPECT_EQ(json.at("volume_error_quanta"), 0);
  EXPECT_EQ(thrown(), replayed());
  const std::scoped_lock held(gadget.lock);
  expect_stroke(hand, gadget.device.log);
  expect_push(gadget.device.log);
}

TEST_F(ThrowRig, AFalconBehindABridgeThrowsTheSame) {
  const Trajectory hand = bowl_stroke();
  BridgeGadget gadget(ready(), hand);
  const HidrawNode node(testbed_.get(), gadget, 2);
  const auto run = throw_bowl("bridge", "--seconds 5");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(thrown(), replayed());
  const std::scoped_lock held(gadget.lock);
  expect_stroke(hand, gadget.device.log);
  expect_push(gadget.device.log);
  EXPECT_EQ(gadget.bad_reports, 0u);
}

TEST_F(ThrowRig, UnpluggedInMidStrokeKeepsPotAndSession) {
  FalconModelSettings model = ready();
  model.faults = {{WireFault::unplugged, 3200}};
  FalconGadget gadget(model, bowl_stroke());
  const UsbPlug plug(testbed_.get(), gadget);
  const auto run = throw_bowl("falcon", "--seconds 60");
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.err.find("usb:1-1: unplugged; plug it in again"), std::string::npos) << run.err;
  const auto json = run.json();
  EXPECT_EQ(json.at("ended"), "device_lost");
  EXPECT_GT(json.at("poses"), 1000);
  EXPECT_EQ(thrown(), replayed());
}

TEST_F(ThrowRig, WaitsForTheDeviceToComeBackWhenAsked) {
  FalconModelSettings model = ready();
  model.faults = {{WireFault::unplugged, 500}};
  FalconGadget gadget(model, bowl_stroke());
  const UsbPlug plug(testbed_.get(), gadget);
  // Plugged in again as soon as it is gone; its firmware is still there, as with a supply of its
  // own.
  std::thread hand([&] {
    for (bool gone = false; !gone; std::this_thread::sleep_for(std::chrono::milliseconds(20))) {
      const std::scoped_lock held(gadget.lock);
      gone = gadget.device.model.unplugged();
      if (gone) gadget.device.model.replug();
    }
  });
  const auto run = throw_bowl("falcon", "--wait --seconds 3");
  hand.join();
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("unplugged; plug it in again; waiting for it"), std::string::npos);
  EXPECT_EQ(run.json().at("ended"), "time_up");
  EXPECT_EQ(thrown(), replayed());
}

TEST_F(ThrowRig, ASpaceMouseMovesTheToolAndFeelsNothing) {
  SpaceMouseGadget gadget;
  // Pushed left and let go: into the clay, from where the workspace's middle lies.
  for (int i = 0; i < 400; ++i)
    gadget.reports.push_back({1, 0xA2, 0xFE, 0, 0, 0, 0});  // x: -350 of 350
  const HidrawNode node(testbed_.get(), gadget, 3);
  const auto run = throw_bowl("spacemouse", "--seconds 3 --height 15");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json().at("volume_error_quanta"), 0);
  EXPECT_EQ(thrown(), replayed());
  const std::string path = folder_.file("s.session");
  const Session session = parse_session(test::read_text(path), path).value();
  EXPECT_LT(session.poses.back().position_mm.x, session.poses.front().position_mm.x - 1.0);
}

}  // namespace
}  // namespace clay::rig
