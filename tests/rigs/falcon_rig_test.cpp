// A stock Falcon: unmodified libftdi1 and libusb with an emulated 0403:cb48.

#include "claystack/falcon/usb.hpp"
#include "tests/falcon/device/dummy_firmware.hpp"
#include "tests/rigs/falcon_gadget.hpp"
#include "tests/rigs/testbed.hpp"
#include "tests/support/wait_until.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <memory>

namespace clay::rig {
namespace {

using namespace clay::falcon;

constexpr double kEncoderMm = 0.07;  // half a count on each leg, within 40 mm of the centre
constexpr std::int64_t kPatienceUs = 20'000'000;  // for a loaded machine

glm::dvec3 on_circle(std::uint64_t frame) {
  const double turn = 2e-3 * 3.14159265358979 * static_cast<double>(frame);
  return kFalconCentreMm + 20.0 * glm::dvec3(std::cos(turn), std::sin(turn), 0.0);
}

glm::dvec3 force_at(std::uint64_t frame) {
  const double turn = 5e-3 * static_cast<double>(frame);
  return 3.0 * glm::dvec3(std::cos(turn), std::sin(turn), std::cos(2 * turn));
}

glm::dvec3 mm_of(const glm::dvec3& position_mm) { return position_mm - kFalconCentreMm; }

class FalconRig : public testing::Test {
 protected:
  FalconRig() {
    const Bytes firmware = dummy_firmware();
    firmware_path_ = testing::TempDir() + "rig-firmware-" + std::to_string(getpid());
    std::ofstream(firmware_path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(firmware.data()), static_cast<long>(firmware.size()));
    settings_.falcon.firmware_path = firmware_path_;
    settings_.falcon.silence_us = kPatienceUs;
  }
  ~FalconRig() override { unlink(firmware_path_.c_str()); }

  void plug(const FalconModelSettings& model = {}) {
    gadget_ = std::make_unique<FalconGadget>(model, on_circle);
    plug_ = std::make_unique<UsbPlug>(testbed_.get(), *gadget_);
  }

  void plug_ready() {
    FalconModelSettings model;
    model.loaded = model.homed = true;
    plug(model);
  }

  /// Writes until a frame arrives or the device reports a fault; counts lost answers.
  static DeviceSample tick(HapticDevice& device, const glm::dvec3& force_n) {
    device.write(force_n);
    return device.read(kPatienceUs);
  }

  template <class Action>
  auto locked(Action action) {
    const std::scoped_lock held(gadget_->lock);
    return action(gadget_->device);
  }

  Testbed testbed_;
  std::unique_ptr<FalconGadget> gadget_;
  std::unique_ptr<UsbPlug> plug_;
  std::string firmware_path_;
  DeviceSettings settings_;
};

TEST_F(FalconRig, LoadsFirmwareHomesAndRuns5000GoodFrames) {
  plug();
  auto opened = open_device("falcon", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  HapticDevice& device = **opened;
  EXPECT_EQ(device.info().place, "usb:1-1");
  EXPECT_EQ(locked([](auto& d) { return d.model.firmware(); }), dummy_firmware());
  EXPECT_EQ(gadget_->bauds.back(), 1'500'000);
  EXPECT_EQ(gadget_->latency_ms, 1);
  EXPECT_EQ(gadget_->control_errors, 0u);

  DeviceSample sample;
  const auto homed = [&] {
    sample = tick(device, {1, 1, 1});
    EXPECT_TRUE(sample.fresh);
    EXPECT_EQ(locked([](auto& d) { return d.log.back().motors; }), LegCounts{});
    return sample.state == DeviceState::ready;
  };
  test::wait_until(homed, test::kDeadline, "the device to be homed");
  const std::uint64_t first = locked([](auto& d) { return d.log.size(); });
  for (std::uint64_t frame = first; frame < first + 5000; ++frame) {
    sample = tick(device, force_at(frame));
    ASSERT_TRUE(sample.fresh) << frame;
    ASSERT_LT(glm::distance(sample.position_mm, mm_of(on_circle(frame))), kEncoderMm) << frame;
    // The force belongs to the position of the previous frame: 0.13 mm away.
    const glm::dvec3 displayed_n = locked([](auto& d) { return d.log.back().force_n; });
    ASSERT_LT(glm::distance(displayed_n, force_at(frame)), 0.05) << frame;
  }
  EXPECT_EQ(locked([](auto& d) { return d.log.size(); }), first + 5000);
  EXPECT_EQ(device.counters().bytes_discarded, 0u);
  EXPECT_EQ(device.counters().without_pose, 0u);
  EXPECT_EQ(device.counters().writes_dropped, 0u);
}

TEST_F(FalconRig, LastPacketIsZeroForce) {
  plug_ready();
  auto opened = open_device("auto", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  for (int i = 0; i < 20; ++i) tick(**opened, {4, 0, 0});
  ASSERT_NE(locked([](auto& d) { return d.model.motors(); }), LegCounts{});
  (*opened)->write({4, 0, 0});
  (*opened)->stop();  // as from a signal handler
  EXPECT_EQ(locked([](auto& d) { return d.model.motors(); }), LegCounts{});
  (*opened)->write({4, 0, 0});
  opened->reset();
  EXPECT_EQ(locked([](auto& d) { return d.model.motors(); }), LegCounts{});
}

TEST_F(FalconRig, StalledLineGetsZeroForceWhenItRecovers) {
  plug_ready();
  for (const int writes : {1, 2, 10, 30}) {
    auto opened = open_device("auto", settings_);
    ASSERT_TRUE(opened) << opened.error().message;
    for (int i = 0; i < 20; ++i) tick(**opened, {4, 0, 0});
    const std::size_t before = locked([&](auto& d) {
      plug_->manners.stalled_writes = writes;
      return d.log.size();
    });
    for (int i = 0; i < 3; ++i) (*opened)->write({4, 0, 0});
    (*opened)->stop();
    opened->reset();  // closes: while it does, the line recovers
    locked([&](auto& d) {
      EXPECT_EQ(plug_->manners.stalled_writes, 0);
      ASSERT_GT(d.log.size(), before) << writes;
      EXPECT_EQ(d.log.back().motors, LegCounts{}) << "the last command";
    });
  }
}

TEST_F(FalconRig, LineThatStallsForGoodGetsNoOldForce) {
  plug_ready();
  auto opened = open_device("auto", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  for (int i = 0; i < 20; ++i) tick(**opened, {4, 0, 0});
  const std::size_t before = locked([&](auto& d) {
    plug_->manners.stalled_writes = kStalledForGood;
    return d.log.size();
  });
  for (int i = 0; i < 3; ++i) (*opened)->write({4, 0, 0});
  (*opened)->stop();
  opened->reset();
  const auto sent_no_force = [&] {
    return locked([&](auto& d) {
      return std::all_of(d.log.begin() + static_cast<long>(before), d.log.end(),
                         [](const auto& frame) { return frame.motors == LegCounts{}; });
    });
  };
  locked([&](auto&) { plug_->recover(); });
  ASSERT_TRUE(sent_no_force());
  EXPECT_TRUE(open_device("auto", settings_));
  EXPECT_TRUE(sent_no_force());
}

TEST_F(FalconRig, LosesAtMostTwoFramesPerWireFault) {
  plug_ready();
  auto opened = open_device("falcon", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  HapticDevice& device = **opened;
  const WireFault faults[] = {WireFault::lost_byte,  WireFault::extra_byte, WireFault::half_frame,
                              WireFault::bad_nibble, WireFault::no_frame,   WireFault::stale_frame};
  tick(device, {});
  for (const WireFault fault : faults) {
    for (int round = 0; round < 10; ++round) {
      const std::uint64_t before = device.counters().frames;
      const std::uint64_t sent_before = locked([&](auto& d) {
        d.model.plan({fault, d.model.frames() + 2});
        return d.log.size();
      });
      for (int i = 0; i < 8; ++i) {
        device.write({1, 0, 0});
        // Long enough for every frame that is not lost.
        const DeviceSample sample = device.read(50'000);
        ASSERT_EQ(sample.state, DeviceState::ready);
        if (!sample.fresh) continue;
        const std::uint64_t made = locked([](auto& d) { return d.log.size(); });
        const double newest = glm::distance(sample.position_mm, mm_of(on_circle(made - 1)));
        const double older = glm::distance(sample.position_mm, mm_of(on_circle(made - 2)));
        ASSERT_LT(std::min(newest, older), kEncoderMm) << static_cast<int>(fault);
      }
      const std::uint64_t sent = locked([](auto& d) { return d.log.size(); }) - sent_before;
      EXPECT_EQ(sent, 8u);
      EXPECT_GE(device.counters().frames - before + 2, sent) << static_cast<int>(fault);
    }
  }
}

TEST_F(FalconRig, ReportsLostHomingAndSendsNoForceUntilHomed) {
  plug_ready();
  auto opened = open_device("falcon", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  for (int i = 0; i < 10; ++i) tick(**opened, {2, 0, 0});
  locked([](auto& d) { d.model.plan({WireFault::homing_lost, 0}); });
  DeviceSample sample = tick(**opened, {2, 0, 0});
  EXPECT_EQ(sample.state, DeviceState::needs_homing);
  const auto homed_again = [&] {
    sample = tick(**opened, {2, 0, 0});
    EXPECT_EQ(locked([](auto& d) { return d.model.motors(); }), LegCounts{});
    return sample.state != DeviceState::needs_homing;
  };
  test::wait_until(homed_again, test::kDeadline, "the device to be homed again");
  EXPECT_EQ(sample.state, DeviceState::ready);
}

TEST_F(FalconRig, ReportsUnpluggingAndReconnects) {
  plug_ready();
  auto opened = open_device("falcon", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  HapticDevice& device = **opened;
  for (int i = 0; i < 100; ++i) tick(device, {2, 0, 0});
  for (int i = 0; i < 3; ++i) {
    locked([](auto& d) { d.model.plan({WireFault::unplugged, 0}); });
    const DeviceSample sample = tick(device, {2, 0, 0});
    EXPECT_EQ(sample.state, DeviceState::fault);
    EXPECT_FALSE(sample.fresh);
    EXPECT_EQ(device.problem().fault, DeviceFault::unplugged);
    EXPECT_EQ(device.problem().message, "usb:1-1: unplugged; plug it in again");
    device.write({2, 0, 0});
    device.stop();
    EXPECT_FALSE(device.open());
    EXPECT_EQ(device.problem().fault, DeviceFault::unplugged);
    locked([](auto& d) { d.model.replug(); });
    const auto again = device.open();
    ASSERT_TRUE(again) << again.error().message;
    test::wait_until([&] { return tick(device, {}).state == DeviceState::ready; }, test::kDeadline,
                     "the device to be ready again");
  }
}

/// A Falcon that is unplugged at the n-th call of `unplugged()`, during any action of the host.
class VanishingFalcon final : public FalconGadget {
 public:
  VanishingFalcon(const FalconModelSettings& model, int looks)
      : FalconGadget(model, on_circle), looks_(looks) {}
  bool unplugged() const override { return gone() || --looks_ == 0; }
  [[nodiscard]] bool gone() const { return looks_ == 0; }

 private:
  mutable int looks_;
};

// In each phase of the start, the firmware included, and of operation.
TEST_F(FalconRig, ReportsALossAtAnyTime) {
  FalconModelSettings running;
  running.loaded = running.homed = true;
  struct Start {
    FalconModelSettings model;
    int stride;
  };
  for (const auto& [model, stride] : {Start{running, 5}, Start{{}, 61}}) {
    bool lost = true;
    for (int looks = 1; lost; looks += stride) {
      VanishingFalcon gadget(model, looks);
      UsbPlug plug(testbed_.get(), gadget);
      const auto is_gone = [&] {
        const std::scoped_lock held(gadget.lock);
        return gadget.gone();
      };
      DeviceError error{DeviceFault::unplugged, ""};
      if (auto opened = open_device("falcon", settings_)) {
        const auto run = [&] {
          for (int i = 0; i < 50 && tick(**opened, {1, 0, 0}).state != DeviceState::fault; ++i) {
          }
        };
        run();
        lost = is_gone();
        if (lost) run();  // it may have gone after the last tick
        error = (*opened)->problem();
        (*opened)->stop();
      } else {
        error = opened.error();
        lost = is_gone();
      }
      if (lost) {
        EXPECT_EQ(error.fault, DeviceFault::unplugged) << looks << ": " << error.message;
      }
      plug.pull();
    }
  }
}

TEST_F(FalconRig, RetriesAWrongEchoThenReportsIt) {
  FalconModelSettings model;
  model.faults = {{WireFault::echo_error, 500}};
  plug(model);
  EXPECT_TRUE(open_device("falcon", settings_)) << "one fault must not prevent the upload";
  locked([](auto& d) {
    d.model.unplug();
    d.model.replug();
    // Enough for the remaining bytes of the piece in ten attempts.
    for (int i = 0; i < 1000; ++i) d.model.plan({WireFault::echo_error, 500});
  });
  const auto opened = open_device("falcon", settings_);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().fault, DeviceFault::echo_error);
  EXPECT_NE(opened.error().what.find("byte 496"), std::string::npos) << opened.error().what;
  EXPECT_NE(opened.error().what.find("tried 10 times"), std::string::npos);
}

TEST_F(FalconRig, DistinguishesMissingPowerFromMissingFirmware) {
  FalconModelSettings model;
  model.power = false;
  plug(model);
  for (const std::string& path : {firmware_path_, std::string()}) {
    settings_.falcon.firmware_path = path;
    const auto unpowered = open_device("falcon", settings_);
    ASSERT_FALSE(unpowered);
    EXPECT_EQ(unpowered.error().fault, DeviceFault::no_answer);
    EXPECT_NE(unpowered.error().remedy.find("power supply"), std::string::npos);
  }
  locked([](auto& d) { d.model.switch_power(true); });
  const auto without_firmware = open_device("falcon", settings_);
  ASSERT_FALSE(without_firmware);
  EXPECT_EQ(without_firmware.error().fault, DeviceFault::no_firmware);
  settings_.falcon.firmware_path = firmware_path_;
  EXPECT_TRUE(open_device("falcon", settings_));
}

TEST_F(FalconRig, DetachesAKernelDriverButRefusesADeviceInUse) {
  plug_ready();
  plug_->manners.kernel_driver = true;
  auto listed = list_devices();
  ASSERT_TRUE(listed);
  ASSERT_EQ(listed->size(), 1u);
  EXPECT_TRUE((*listed)[0].usable);
  ASSERT_TRUE((*listed)[0].problem);
  EXPECT_EQ((*listed)[0].problem->fault, DeviceFault::driver_bound);
  const auto first = open_device("falcon", settings_);
  ASSERT_TRUE(first);
  EXPECT_FALSE(plug_->manners.kernel_driver);

  listed = list_devices();
  ASSERT_TRUE(listed);
  EXPECT_FALSE((*listed)[0].usable);
  EXPECT_EQ((*listed)[0].problem->fault, DeviceFault::busy);
  const auto second = open_device("auto", settings_);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().fault, DeviceFault::busy);
}

TEST_F(FalconRig, ListsWithoutSendingAByte) {
  plug();
  const auto listed = list_devices();
  ASSERT_TRUE(listed);
  ASSERT_EQ(listed->size(), 1u);
  EXPECT_EQ((*listed)[0].name, "Novint Falcon");
  EXPECT_EQ((*listed)[0].place, "usb:1-1");
  EXPECT_FALSE((*listed)[0].problem);
  EXPECT_TRUE(gadget_->bauds.empty());
}

TEST_F(FalconRig, FindsNothingWithoutDevices) {
  const auto listed = list_devices();
  ASSERT_TRUE(listed);
  EXPECT_TRUE(listed->empty());
  for (const char* which : {"auto", "falcon", "bridge", "spacemouse", "usb:1-1", "simulated"}) {
    const auto opened = open_device(which);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().fault, DeviceFault::not_found);
  }
}

}  // namespace
}  // namespace clay::rig
