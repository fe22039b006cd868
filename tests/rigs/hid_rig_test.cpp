// A Falcon behind a bridge and a SpaceMouse: unmodified hidapi with emulated HID devices. The same
// tests run with hidapi's hidraw backend on kernel nodes, and with its libusb backend on USB
// devices (CLAYSTACK_HIDAPI_LIBUSB).

#include "claystack/falcon/usb.hpp"
#include "tests/rigs/hid_gadget.hpp"
#include "tests/rigs/plugged.hpp"
#include "tests/rigs/testbed.hpp"
#include "tests/support/wait_until.hpp"

#include <gtest/gtest.h>
#include <hidapi.h>

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <string>
#include <thread>

namespace clay::rig {
namespace {

using namespace clay::falcon;

constexpr double kEncoderMm = 0.07;
constexpr std::int64_t kPatienceUs = 20'000'000;

glm::dvec3 on_circle(std::uint64_t frame) {
  const double turn = 2e-3 * 3.14159265358979 * static_cast<double>(frame);
  return kFalconCentreMm + 20.0 * glm::dvec3(std::cos(turn), std::sin(turn), 0.0);
}

/// hidapi keeps its state until hid_exit(), but each test has another /dev.
class HidRig : public testing::Test {
 protected:
  ~HidRig() override { hid_exit(); }
  Testbed testbed_;
};

FalconModelSettings loaded() {
  FalconModelSettings settings;
  settings.loaded = true;
  return settings;
}

class BridgeRig : public HidRig {
 protected:
  BridgeRig() { settings_.falcon.silence_us = kPatienceUs; }

  static DeviceSample tick(HapticDevice& device, const glm::dvec3& force_n) {
    device.write(force_n);
    return device.read(kPatienceUs);
  }

  static void home(HapticDevice& device) {
    test::wait_until([&] { return tick(device, {}).state == DeviceState::ready; }, test::kDeadline,
                     "the device to be homed");
  }

  template <class Action>
  auto locked(Action action) {
    const std::scoped_lock held(gadget_.lock);
    return action(gadget_.device);
  }

  BridgeGadget gadget_{loaded(), on_circle};
  Plugged plugged_{testbed_.get(), gadget_};
  DeviceSettings settings_;
};

TEST_F(BridgeRig, HomesAndRuns5000GoodFrames) {
  auto opened = open_device("bridge", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  HapticDevice& device = **opened;
  const auto homed = [&] {
    const bool ready = tick(device, {1, 0, 0}).state == DeviceState::ready;
    EXPECT_EQ(locked([](auto& d) { return d.log.back().motors; }), LegCounts{});
    return ready;
  };
  test::wait_until(homed, test::kDeadline, "the device to be homed");
  const std::uint64_t first = locked([](auto& d) { return d.log.size(); });
  const glm::dvec3 force(1, -2, 3);
  for (std::uint64_t frame = first; frame < first + 5000; ++frame) {
    const DeviceSample sample = tick(device, force);
    ASSERT_TRUE(sample.fresh) << frame;
    const glm::dvec3 true_mm = on_circle(frame) - kFalconCentreMm;
    ASSERT_LT(glm::distance(sample.position_mm, true_mm), kEncoderMm) << frame;
    ASSERT_LT(glm::distance(locked([](auto& d) { return d.log.back().force_n; }), force), 0.05);
  }
  EXPECT_EQ(device.counters().bytes_discarded, 0u);
  EXPECT_EQ(gadget_.bad_reports, 0u);
  EXPECT_EQ(gadget_.bytes, kFrameBytes * locked([](auto& d) { return d.log.size(); }));
  device.write(force);
  device.stop();
  tick(device, force);
  EXPECT_EQ(locked([](auto& d) { return d.model.motors(); }), LegCounts{});
}

TEST_F(BridgeRig, LosesAtMostTwoFramesPerWireFault) {
  auto opened = open_device("auto", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  HapticDevice& device = **opened;
  home(device);
  for (const WireFault fault : {WireFault::lost_byte, WireFault::extra_byte, WireFault::half_frame,
                                WireFault::bad_nibble, WireFault::no_frame}) {
    const std::uint64_t before = device.counters().frames;
    locked([&](auto& d) { d.model.plan({fault, d.model.frames() + 2}); });
    for (int i = 0; i < 8; ++i) {
      device.write({1, 0, 0});
      const DeviceSample sample = device.read(200'000);
      ASSERT_EQ(sample.state, DeviceState::ready);
      if (!sample.fresh) continue;
      const glm::dvec3 newest =
          locked([](auto& d) { return d.log.back().position_mm; }) - kFalconCentreMm;
      ASSERT_LT(glm::distance(sample.position_mm, newest), 0.126 + kEncoderMm);
    }
    EXPECT_GE(device.counters().frames - before, 8u - 2u) << static_cast<int>(fault);
  }
}

TEST_F(BridgeRig, IgnoresForeignReports) {
  auto opened = open_device("bridge", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  {
    const std::scoped_lock held(gadget_.lock);
    gadget_.reports.push_back(Bytes(64, 0xFF));
    gadget_.reports.push_back(Bytes(64, 0x00));
    gadget_.reports.push_back(Bytes{0x20, '<', 'A'});
    plugged_.pump();
  }
  EXPECT_TRUE(tick(**opened, {}).fresh);
  EXPECT_EQ((*opened)->counters().bytes_discarded, 0u);
}

TEST_F(BridgeRig, ReportsUnpluggingAndReconnects) {
  auto opened = open_device("bridge", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  HapticDevice& device = **opened;
  for (int i = 0; i < 50; ++i) tick(device, {1, 0, 0});
  locked([](auto& d) { d.model.plan({WireFault::unplugged, 0}); });
  DeviceSample sample = tick(device, {1, 0, 0});
  EXPECT_EQ(sample.state, DeviceState::fault);
  EXPECT_FALSE(sample.fresh);
  EXPECT_EQ(device.problem().fault, DeviceFault::unplugged);
  device.write({1, 0, 0});
  device.stop();
  plugged_.show(false);
  EXPECT_FALSE(device.open());
  plugged_.show(true);
  locked([](auto& d) { d.model.replug(); });
  const auto again = device.open();
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(tick(device, {}).state, DeviceState::needs_homing);
}

#ifndef CLAYSTACK_HIDAPI_LIBUSB
/// Another interface of a bridge, with the same product string: it takes no frames.
class KeyboardOfABridge final : public HidGadget {
 public:
  KeyboardOfABridge() {
    identity_ = BridgeGadget(loaded(), on_circle, 1).identity();
    // Generic desktop, keyboard: one byte in, one byte out.
    identity_.report_descriptor = {0x05, 0x01, 0x09, 0x06, 0xA1, 0x01, 0x75, 0x08, 0x95,
                                   0x01, 0x81, 0x02, 0x75, 0x08, 0x91, 0x02, 0xC0};
  }
  void out(std::span<const std::uint8_t>) override { ++reports_out; }
  bool unplugged() const override { return false; }

  int reports_out = 0;
};

TEST_F(BridgeRig, LeavesOtherInterfacesOfTheBridgeAlone) {
  KeyboardOfABridge keyboard;
  const HidrawNode node(testbed_.get(), keyboard, 1);
  const auto listed = list_devices();
  ASSERT_TRUE(listed);
  ASSERT_EQ(listed->size(), 1u);
  EXPECT_EQ(listed->front().place, "/dev/hidraw2");
  ASSERT_TRUE(open_device("auto", settings_));
  EXPECT_EQ(keyboard.reports_out, 0);
}

// The kernel gives the number of a node that has gone to the next device.
TEST_F(HidRig, FindsTheSameDeviceAtAnotherNodeAndNoOtherAtItsOwn) {
  BridgeGadget bridge(loaded(), on_circle);
  HidrawNode node(testbed_.get(), bridge, 5);
  DeviceSettings settings;
  settings.falcon.silence_us = kPatienceUs;
  auto opened = open_device("bridge", settings);
  ASSERT_TRUE(opened) << opened.error().message;
  HapticDevice& device = **opened;
  device.write({});
  EXPECT_TRUE(device.read(kPatienceUs).fresh);
  device.stop();
  const std::size_t frames = bridge.device.log.size();
  node.become(SpaceMouseGadget().identity());
  const auto refused = device.open();
  ASSERT_FALSE(refused) << "a SpaceMouse has its node";
  EXPECT_EQ(refused.error().fault, DeviceFault::unplugged) << refused.error().message;
  EXPECT_EQ(bridge.device.log.size(), frames) << "nothing was written to the stranger";
  BridgeGadget moved(loaded(), on_circle, 4);
  const HidrawNode there(testbed_.get(), moved, 6);
  const auto again = device.open();
  ASSERT_TRUE(again) << again.error().message;
  device.write({});
  EXPECT_TRUE(device.read(kPatienceUs).fresh);
}
#endif

std::set<std::string> threads() {
  std::set<std::string> all;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task"))
    all.insert(task.path());
  return all;
}

TEST_F(BridgeRig, LibraryThreadsReceiveNoSignal) {
  const auto before = threads();
  auto opened = open_device("bridge", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  for (const std::string& task : threads()) {
    if (before.contains(task)) continue;
    std::ifstream status(task + "/status");
    std::string word;
    while (status >> word && word != "SigBlk:") {
    }
    std::uint64_t blocked = 0;
    status >> std::hex >> blocked;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE})
      EXPECT_NE(blocked >> (signal - 1) & 1, 0u) << task << " " << signal;
  }
}

HapticDevice* interrupted_device = nullptr;
std::atomic<int> stops{0};

/// A signal handler that stops the device repeatedly, interrupting the writing thread anywhere. If
/// the writer deadlocks, the deadline in the signalling thread ends the program.
TEST_F(BridgeRig, LastPacketNeverWaitsForTheInterruptedThread) {
  auto opened = open_device("bridge", settings_);
  ASSERT_TRUE(opened) << opened.error().message;
  interrupted_device = opened->get();
  home(*interrupted_device);
  const auto before = std::signal(SIGUSR1, [](int) {
    interrupted_device->zero();
    ++stops;
  });
  std::atomic<bool> done{false};
  std::thread signaller([&, writer = pthread_self()] {
    using Clock = std::chrono::steady_clock;
    auto sent = Clock::now(), next = sent;
    int seen = stops;
    // After a stop the writer gets as much time as the stop took, so the speed of the machine does
    // not matter.
    const auto ended = [&] {
      const auto now = Clock::now();
      if (stops != seen) {
        seen = stops;
        next = now + (now - sent);
      }
      if (now >= next && !done) {
        sent = now;
        next = Clock::time_point::max();
        pthread_kill(writer, SIGUSR1);
      }
      return done.load();
    };
    test::wait_until(ended, test::kDeadline, "300 frames and 300 stops");
  });
  for (int i = 0; i < 300 || stops < 300; ++i) {
    interrupted_device->write({1, 0, 0});
    interrupted_device->read(200'000);
  }
  done = true;
  signaller.join();
  std::signal(SIGUSR1, before);
  interrupted_device->stop();
  tick(*interrupted_device, {1, 0, 0});
  EXPECT_EQ(locked([](auto& d) { return d.model.motors(); }), LegCounts{});
}

TEST_F(BridgeRig, ReportsASilentFalconBehindTheBridge) {
  locked([](auto& d) { d.model.set_baud(9600); });  // the bridge did not set the line
  const auto opened = open_device("bridge", settings_);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().fault, DeviceFault::no_answer);
  EXPECT_NE(opened.error().remedy.find("bridge"), std::string::npos);
}

class SpaceMouseRig : public HidRig {
 protected:
  void send(const Bytes& report) {
    const std::scoped_lock held(gadget_.lock);
    gadget_.reports.push_back(report);
    plugged_.pump();
  }
  /// Like a deflected cap: sends the next report once the last has been read.
  void keep_sending(const Bytes& report) {
    const std::scoped_lock held(gadget_.lock);
    if (gadget_.reports.empty()) gadget_.reports.push_back(report);
    plugged_.pump();
  }
  bool light() {
    const std::scoped_lock held(gadget_.lock);
    return gadget_.light;
  }

  SpaceMouseGadget gadget_;
  Plugged plugged_{testbed_.get(), gadget_};
};

TEST_F(SpaceMouseRig, ReportsPositionsAndSwitchesItsLight) {
  DeviceSettings settings;
  settings.space_mouse.silence_us = 1'000'000;
  auto opened = open_device("spacemouse", settings);
  ASSERT_TRUE(opened) << opened.error().message;
  HapticDevice& device = **opened;
  EXPECT_EQ(device.info().name, "SpaceMouse Compact");
  EXPECT_FALSE(device.info().can_push);
  EXPECT_EQ(device.read(0).position_mm, glm::dvec3(0.0));
  send({1, 0x5E, 0x01, 0, 0, 0, 0});                    // x full to the right
  send({1, 0x5E, 0x01, 0, 0, 0, 0, 9, 9, 9, 9, 9, 9});  // the same from a wireless model
  send({2, 1, 0, 1, 0, 1, 0});
  send({3, 0x02, 0x00});
  DeviceSample sample;
  const auto moved = [&] {
    sample = device.read(0);
    EXPECT_EQ(sample.state, DeviceState::ready);
    EXPECT_TRUE(sample.fresh);
    keep_sending({1, 0x5E, 0x01, 0, 0, 0, 0});
    return sample.buttons != 0 && sample.position_mm.x >= 1.0;
  };
  test::wait_until(moved, test::kDeadline, "a button, and 1 mm to the right");
  EXPECT_EQ(sample.buttons, 2u);
  EXPECT_EQ(sample.position_mm.y, 0.0);
  EXPECT_EQ(sample.position_mm.z, 0.0);
  EXPECT_TRUE(light());
  opened->reset();
  EXPECT_FALSE(light());
}

TEST_F(SpaceMouseRig, StopsWhenSilentAndReportsUnplugging) {
  auto opened = open_device("auto");
  ASSERT_TRUE(opened) << opened.error().message;
  HapticDevice& device = **opened;
  const auto moved = [&] {
    keep_sending({1, 0x5E, 0x01, 0, 0, 0, 0});
    return device.read(0).position_mm.x > 0.0;
  };
  test::wait_until(moved, test::kDeadline, "the cap to move the position");
  const auto rests = [&] {
    const double x_mm = device.read(0).position_mm.x;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return device.read(0).position_mm.x == x_mm;
  };
  test::wait_until(rests, test::kDeadline, "the position to rest");
  const double x_mm = device.read(0).position_mm.x;
  EXPECT_LT(x_mm, device.info().half_workspace_mm.x)
      << "not stopped by the border of the workspace";
  for (int i = 0; i < 100; ++i) EXPECT_EQ(device.read(0).position_mm.x, x_mm);
  {
    const std::scoped_lock held(gadget_.lock);
    gadget_.gone = true;
    plugged_.pump();
  }
  test::wait_until([&] { return device.read(0).state != DeviceState::ready; }, test::kDeadline,
                   "the loss of the device");
  EXPECT_EQ(device.problem().fault, DeviceFault::unplugged);
}

}  // namespace
}  // namespace clay::rig
