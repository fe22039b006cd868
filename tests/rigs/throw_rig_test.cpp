// `claystack throw --device` as users run it: unmodified libftdi1, libusb and hidapi, and a hand
// that plays the sample's stroke on the emulated device. The same tests run with hidapi's hidraw
// backend, as the program is linked, and with its libusb backend preloaded (CLAYSTACK_HIDAPI_LIBUSB
// is the library).

#include "tests/rigs/throw_rig.hpp"

#include "tests/rigs/plugged.hpp"

namespace clay::rig {
namespace {

#ifndef CLAYSTACK_HIDAPI_LIBUSB  // these do not use hidapi

TEST_F(ThrowRig, StockFalconThrowsTheSampleWithoutFirmwareLoaded) {
  FalconGadget gadget({}, bowl_stroke());
  const UsbPlug plug(testbed_.get(), gadget);
  const auto run = throw_frames(gadget, kFrames + kHomingFrames, "falcon", firmware());
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = run.json();
  EXPECT_EQ(json.at("ended"), "stopped");
  EXPECT_EQ(json.at("volume_error_quanta"), 0);
  EXPECT_EQ(thrown(), replayed());
  const std::scoped_lock held(gadget.lock);
  SCOPED_TRACE(run.json().dump());
  expect_no_bad_frame(run, kFrames);
  EXPECT_EQ(gadget.device.model.firmware(), dummy_firmware());
  expect_displayed_force(run, gadget.device.log);
}

TEST_F(ThrowRig, StopsWaitingForHoming) {
  FalconModelSettings model;
  model.loaded = true;
  model.homing_frames = 1 << 30;
  FalconGadget gadget(model, bowl_stroke());
  const UsbPlug plug(testbed_.get(), gadget);
  const auto run = throw_bowl("falcon", "--seconds 0.2 --patience 1");
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.err.find("usb:1-1: nothing was thrown; home it: pull the grip"), std::string::npos)
      << run.err;
  EXPECT_EQ(run.json().at("poses"), 0);
  const std::scoped_lock held(gadget.lock);
  for (const FrameLog& frame : gadget.device.log) ASSERT_EQ(frame.motors, LegCounts{});
}

TEST_F(ThrowRig, AcceptsNoDamagedFrame) {
  FalconModelSettings model = ready();
  constexpr std::uint64_t kLost = 1900;
  model.faults = {{WireFault::lost_byte, 1300},   {WireFault::extra_byte, 1400},
                  {WireFault::half_frame, 1500},  {WireFault::bad_nibble, 1600},
                  {WireFault::no_frame, 1700},    {WireFault::stale_frame, 1800},
                  {WireFault::homing_lost, kLost}};
  FalconGadget gadget(model, bowl_stroke());
  const UsbPlug plug(testbed_.get(), gadget);
  const auto run = throw_frames(gadget, 2500, "falcon", "");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(thrown(), replayed());
  const std::scoped_lock held(gadget.lock);
  const auto& log = gadget.device.log;
  EXPECT_GE(run.json().at("frames").at("taken").get<std::size_t>() + 2 * model.faults.size(),
            log.size());
  EXPECT_GT(run.json().at("frames").at("bytes_discarded"), 0);
  expect_true_positions(log);
  // The force must be zero after ten ticks; homing takes sixty frames.
  for (std::uint64_t frame = kLost + 10; frame < kLost + 50; ++frame)
    ASSERT_EQ(log.at(frame).motors, LegCounts{}) << frame;
}

#endif

TEST_F(ThrowRig, BridgedFalconThrowsTheSamePot) {
  FalconModelSettings model;
  model.loaded = true;  // a bridge loads the firmware
  BridgeGadget gadget(model, bowl_stroke());
  const Plugged plugged(testbed_.get(), gadget);
  const auto run = throw_frames(gadget, kFrames + kHomingFrames, "bridge", "");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(thrown(), replayed());
  const std::scoped_lock held(gadget.lock);
  SCOPED_TRACE(run.json().dump());
  expect_no_bad_frame(run, kFrames);
  expect_displayed_force(run, gadget.device.log);
  EXPECT_EQ(gadget.bad_reports, 0u);
}

TEST_F(ThrowRig, UnpluggedBridgeKeepsPotAndSession) {
  FalconModelSettings model = ready();
  model.faults = {{WireFault::unplugged, 1300}};
  BridgeGadget gadget(model, bowl_stroke());
  const Plugged plugged(testbed_.get(), gadget);
  const auto run = throw_bowl("bridge", "");
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.err.find("unplugged; plug it in again"), std::string::npos) << run.err;
  EXPECT_EQ(run.json().at("ended"), "device_lost");
  EXPECT_EQ(thrown(), replayed());
}

#ifndef CLAYSTACK_HIDAPI_LIBUSB

TEST_F(ThrowRig, UnpluggedFalconKeepsPotAndSession) {
  FalconModelSettings model = ready();
  model.faults = {{WireFault::unplugged, 1300}};
  FalconGadget gadget(model, bowl_stroke());
  const UsbPlug plug(testbed_.get(), gadget);
  const auto run = throw_bowl("falcon", "");
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.err.find("usb:1-1: unplugged; plug it in again"), std::string::npos) << run.err;
  const auto json = run.json();
  EXPECT_EQ(json.at("ended"), "device_lost");
  EXPECT_GT(json.at("poses"), 100);
  EXPECT_EQ(thrown(), replayed());
}

TEST_F(ThrowRig, StalledFalconKeepsPotAndSession) {
  FalconGadget gadget(ready(), bowl_stroke());
  UsbPlug plug(testbed_.get(), gadget);
  Program program = begin("falcon", "");
  wait_for_frames(program, gadget, 1300);
  const std::size_t before = [&] {
    const std::scoped_lock held(gadget.lock);
    plug.manners.stalled_writes = 5;  // it recovers while the program ends
    return gadget.device.log.size();
  }();
  const auto run = program.wait();
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.err.find("usb:1-1: no frame for 500 ms"), std::string::npos) << run.err;
  EXPECT_EQ(run.json().at("ended"), "device_lost");
  EXPECT_EQ(thrown(), replayed());
  const std::scoped_lock held(gadget.lock);
  ASSERT_GT(gadget.device.log.size(), before);
  for (std::size_t frame = before; frame < gadget.device.log.size(); ++frame)
    EXPECT_EQ(gadget.device.log[frame].motors, LegCounts{}) << frame - before;
}

TEST_F(ThrowRig, WaitsForReconnectionIfRequested) {
  FalconModelSettings model = ready();
  model.faults = {{WireFault::unplugged, 500}};
  FalconGadget gadget(model, bowl_stroke());
  const UsbPlug plug(testbed_.get(), gadget);
  Program program = begin("falcon", "--wait");
  // Replugs only after the throw has noticed the loss.
  until(
      program, [&] { return program.err().find("waiting for it") != std::string::npos; },
      "the throw to notice the loss of the device");
  const std::size_t before = [&] {
    const std::scoped_lock held(gadget.lock);
    gadget.device.model.replug();  // its firmware stays loaded, because it has its own power supply
    return gadget.device.log.size();
  }();
  wait_for_frames(program, gadget, before + 500);
  const auto run = stop(program);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("unplugged; plug it in again; waiting for it"), std::string::npos)
      << run.err;
  EXPECT_EQ(run.json().at("ended"), "stopped");
  EXPECT_EQ(thrown(), replayed());
}

#endif

TEST_F(ThrowRig, SpaceMouseMovesTheToolWithoutForce) {
  SpaceMouseGadget gadget;
  Plugged plugged(testbed_.get(), gadget);
  // The cap stays deflected to the left until the tool is in the lump of 49 mm radius, or the throw
  // ends.
  const auto pressed = [&] {
    {
      const std::scoped_lock held(gadget.lock);
      if (gadget.reports.empty()) gadget.reports.push_back({1, 0xA2, 0xFE, 0, 0, 0, 0});
      plugged.pump();
    }
    return tool_mm() < 45.0;
  };
  Program program = begin("spacemouse", "--height 15");
  until(program, pressed, "the tool to reach the clay");
  const auto run = stop(program);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json().at("volume_error_quanta"), 0);
  EXPECT_EQ(thrown(), replayed());
  EXPECT_LT(tool_mm(), 45.0);
}

}  // namespace
}  // namespace clay::rig
