// The window on a virtual screen, with an arm that is connected while it runs and disconnected
// during a stroke: unmodified libftdi1 and libusb with an emulated Falcon, and real mouse events.
// arm_under_xvfb.sh acts as the user; this file moves the arm.

#include "app/servo/mapping.hpp"
#include "tests/rigs/falcon_gadget.hpp"
#include "tests/rigs/testbed.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/wait_until.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace clay::rig {
namespace {

using namespace clay::falcon;

// On the wheel [mm]. The lump has 49.1 mm radius; the tool is a ball of 10 mm radius.
constexpr double kOffClayMm = 62.0, kInClayMm = 54.0, kDeepMm = 35.0, kHeightMm = 15.0;
constexpr double kMovingMm = 0.4;  // per frame
constexpr std::size_t kEnoughFrames = 100;

/// Stays at a place, or presses until it is placed. Called under the gadget's lock.
class Hand {
 public:
  void place_at(double x_mm) {
    pressing_ = false;
    x_mm_ = goal_mm_ = x_mm;
  }
  void press_to(double x_mm) {
    if (!pressing_) frames_without_force_ = 0;
    pressing_ = true;
    press_to_mm_ = x_mm;
  }
  /// The position in the next frame. `pushed`: the last frame had a force.
  glm::dvec3 next(bool pushed) {
    if (pressing_) find_the_force(pushed);
    x_mm_ += std::clamp(goal_mm_ - x_mm_, -kMovingMm, kMovingMm);
    return kFalconCentreMm + mapping_.to_device({x_mm_, kHeightMm, 0.0});
  }

 private:
  /// On a loaded machine late frames end the force again and again. It returns only after a rest
  /// off the clay, so the hand alternates between both until it is pushed.
  void find_the_force(bool pushed) {
    constexpr int kToContact = 60, kRest = 120;  // frames; the guard's safe state needs 100
    frames_without_force_ = pushed ? 0 : frames_without_force_ + 1;
    const bool rests = frames_without_force_ % (kToContact + kRest) >= kToContact;
    goal_mm_ = rests ? kOffClayMm : press_to_mm_;
  }

  servo::Mapping mapping_ = servo::Mapping::build({}).value();
  double x_mm_ = kOffClayMm, goal_mm_ = kOffClayMm, press_to_mm_ = kOffClayMm;
  int frames_without_force_ = 0;
  bool pressing_ = false;
};

FalconModelSettings ready() {
  FalconModelSettings model;
  model.loaded = model.homed = true;
  return model;
}

/// A frame with zero motor commands and any lights: '<' and four letters for each motor.
bool is_no_force(const Bytes& frame) {
  constexpr std::size_t kMotorBytes = 13;
  const auto zero = encode({});
  return frame.size() == kFrameBytes &&
         std::equal(zero.begin(), zero.begin() + kMotorBytes, frame.begin());
}

class StudioRig : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(test::shell("command -v Xvfb && command -v xdotool").status, 0)
        << "needs Xvfb and xdotool (tests/run.sh installs them)";
    auto scene = nlohmann::json::parse(test::read_text(test::sample("paper/bowl.scene.json")));
    // Clay that hardly yields and is stiff: the force lasts, and the motors display it early in the
    // ramp, which a loaded machine interrupts again and again.
    scene["removal"]["rate_per_s"] = 0.01;
    scene["force"]["stiffness_n_per_mm2"] = 0.1;
    test::write_text(folder_.file("bowl.scene.json"), scene.dump());
  }

  void plug() { plugs_.push_back(std::make_unique<UsbPlug>(testbed_.get(), gadget_)); }
  template <class Action>
  auto locked(Action action) {
    const std::scoped_lock held(gadget_.lock);
    return action();
  }
  [[nodiscard]] bool requested(const char* what) const {
    return std::filesystem::exists(folder_.file(what));
  }
  void answer(const char* what) { test::write_text(folder_.file(what), ""); }
  /// Throws with the script's errors if the script ends first.
  template <class Condition>
  void until(Condition condition, const std::string& what) {
    const auto done = [&] {
      if (!user_->running()) throw std::runtime_error(what + ": " + user_->err());
      return condition();
    };
    test::wait_until(done, test::kProgramDeadline, what);
  }
  void until_requested(const char* what) {
    until([&] { return requested(what); }, std::string("a request of the script: ") + what);
  }
  void press_to(double x_mm) {
    locked([&] { hand_.press_to(x_mm); });
  }

  /// True if the last frame had a force. Called under the gadget's lock.
  [[nodiscard]] bool pushed() const {
    const auto& log = gadget_.device.log;
    return !log.empty() && log.back().motors != LegCounts{};
  }
  [[nodiscard]] std::size_t frames() {
    return locked([&] { return gadget_.device.log.size(); });
  }
  /// Number of frames with non-zero force, starting at `from`.
  [[nodiscard]] std::size_t frames_with_force(std::size_t from) {
    return locked([&] {
      const auto& log = gadget_.device.log;
      return static_cast<std::size_t>(
          std::count_if(log.begin() + static_cast<std::ptrdiff_t>(from), log.end(),
                        [](const FrameLog& f) { return f.motors != LegCounts{}; }));
    });
  }

  void connect_and_throw() {
    until_requested("plug");
    plug();
    until_requested("press");
    EXPECT_EQ(frames_with_force(0), 0u) << "off the clay";
    press_to(kInClayMm);
    until([&] { return frames_with_force(0) > kEnoughFrames; }, "force on the hand");
    answer("force_displayed");
  }
  /// Disconnects the arm while the motors push.
  void unplug_under_force() {
    const auto unplugged = [&] {
      return locked([&] {
        if (pushed()) gadget_.device.model.unplug();
        return pushed();
      });
    };
    until_requested("pull");
    until(unplugged, "a frame with force");
    plugs_.back()->pull();
  }
  /// Reconnects with the grip in the clay, where the force stays zero. Then leaves it and presses
  /// again.
  void reconnect_in_the_clay() {
    until_requested("reconnect");
    const std::size_t before = frames();
    EXPECT_EQ(before, lost_at_) << "frames reached a disconnected arm";
    locked([&] {
      hand_.place_at(kDeepMm);
      gadget_.device.model.replug();
    });
    plug();
    until([&] { return frames() > before; }, "a frame of the reconnected arm");
    answer("opened");
    until([&] { return frames() > before + 10 * kEnoughFrames; }, "frames without force");
    EXPECT_EQ(frames_with_force(before), 0u);
    answer("no_force");
    until_requested("retract");
    press_to(kDeepMm - 5.0);  // beyond the clay already displaced
    until([&] { return frames_with_force(before) > kEnoughFrames; },
          "force on the hand after the reconnection");
    answer("force_displayed_again");
  }

  test::ScratchFolder folder_;
  Testbed testbed_;
  Hand hand_;
  FalconGadget gadget_{ready(), [this](std::uint64_t) { return hand_.next(pushed()); }};
  std::vector<std::unique_ptr<UsbPlug>> plugs_;
  std::size_t lost_at_ = 0;
  std::optional<test::Program> user_;
};

TEST_F(StudioRig, SwitchesBetweenAReconnectedArmAndTheMouse) {
  user_.emplace("sh " CLAYSTACK_RIGS "/arm_under_xvfb.sh " CLAYSTACK_PROGRAM " " +
                folder_.path().string());
  connect_and_throw();
  unplug_under_force();
  lost_at_ = frames();
  reconnect_in_the_clay();
  const auto ran = user_->wait();
  ASSERT_EQ(ran.status, 0) << ran.err << ran.out;
  EXPECT_EQ(locked([&] { return gadget_.device.model.motors(); }), LegCounts{})
      << "the last command";
  // The packet that detects the loss was made before; all following packets have zero force.
  for (std::size_t i = 1; i < gadget_.refused.size(); ++i)
    EXPECT_TRUE(is_no_force(gadget_.refused[i])) << i << ": " << hexadecimal(gadget_.refused[i]);

  const auto listed = test::claystack("throw " + folder_.file("journal.work") + " --list --json");
  ASSERT_EQ(listed.status, 0) << listed.err;
  const auto nodes = listed.json().at("nodes");
  // Arm, mouse, mouse, arm; a throw by the arm may be several strokes.
  ASSERT_GE(nodes.size(), 5u) << nodes << ran.out;
  for (std::size_t i = 1; i < 5; ++i) EXPECT_TRUE(nodes[i].at("changed")) << nodes;
}

}  // namespace
}  // namespace clay::rig
