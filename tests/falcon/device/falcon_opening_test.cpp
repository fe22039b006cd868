// From power-up and a firmware file to a ready device.

#include "tests/falcon/device/falcon_bench.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace clay::falcon {
namespace {

TEST(FalconOpening, GoesFromPowerUpToReady) {
  const FirmwareFile firmware;
  FalconSettings settings;
  settings.firmware_path = firmware.path();
  FalconBench bench({}, settings);
  EXPECT_EQ(bench.device->read(0).state, DeviceState::closed);
  ASSERT_TRUE(bench.device->open());
  EXPECT_EQ(bench.model->firmware(), dummy_firmware());
  DeviceSample sample = bench.tick({1, 0, 0});
  EXPECT_EQ(sample.state, DeviceState::needs_homing);
  for (int i = 0; i < 200 && sample.state == DeviceState::needs_homing; ++i) {
    sample = bench.tick({1, 0, 0});
    EXPECT_EQ(bench.model->motors(), LegCounts{}) << "a force before the device is homed";
  }
  EXPECT_EQ(sample.state, DeviceState::ready);
  bench.tick({1, 0, 0});
  EXPECT_NE(bench.model->motors(), LegCounts{});
}

TEST(FalconOpening, KeepsLoadedFirmware) {
  FalconBench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  EXPECT_TRUE(bench.model->firmware().empty()) << "uploaded although it was already running";
  EXPECT_EQ(bench.tick().state, DeviceState::ready);
}

TEST(FalconOpening, ReportsMissingFirmware) {
  FalconBench bench;
  const auto opened = bench.device->open();
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().fault, DeviceFault::no_firmware);
  EXPECT_NE(opened.error().remedy.find("--firmware"), std::string::npos);
  EXPECT_EQ(bench.device->read(0).state, DeviceState::needs_firmware);
  EXPECT_EQ(bench.device->problem().fault, DeviceFault::no_firmware);
}

TEST(FalconOpening, DistinguishesMissingPowerFromMissingFirmware) {
  FalconModelSettings unpowered;
  unpowered.power = false;
  FalconBench bench(unpowered);
  const auto opened = bench.device->open();
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().fault, DeviceFault::no_answer);
  EXPECT_NE(opened.error().remedy.find("power supply"), std::string::npos);
}

TEST(FalconOpening, RefusesABadFileBeforeSendingIt) {
  FalconSettings settings;
  settings.firmware_path = "/dev/null";
  FalconBench bench({}, settings);
  const auto opened = bench.device->open();
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().fault, DeviceFault::bad_firmware);
  EXPECT_TRUE(bench.model->firmware().empty());
}

TEST(FalconOpening, RefusesInvalidSettings) {
  const double nan = std::nan("");
  const auto refusal = [](auto change) {
    FalconSettings settings;
    change(settings);
    FalconBench bench(ready_model(), settings);
    const auto opened = bench.device->open();
    if (opened) return std::string("opened");
    EXPECT_EQ(opened.error().fault, DeviceFault::bad_setting);
    EXPECT_EQ(bench.model->frames(), 0u);
    return opened.error().message;
  };
  const std::string force = "falcon: force_limit_n: expected a value from 0 to 8.9, found ";
  EXPECT_EQ(refusal([](auto& s) { s.force_limit_n = 9.0; }), force + "9");
  EXPECT_EQ(refusal([&](auto& s) { s.force_limit_n = nan; }), force + "nan");
  const std::string counts =
      "falcon: motor_counts_per_nmm: expected a value from 0.001 to 1000, found ";
  EXPECT_EQ(refusal([](auto& s) { s.motor_counts_per_nmm = 0.0; }), counts + "0");
  EXPECT_EQ(refusal([&](auto& s) { s.motor_counts_per_nmm = nan; }), counts + "nan");
  const std::string silence = "falcon: silence_us: expected a value from 10000 to 60000000, found ";
  EXPECT_EQ(refusal([](auto& s) { s.silence_us = 9'999; }), silence + "9999");
  EXPECT_EQ(refusal([](auto& s) { s.silence_us = 60'000'001; }), silence + "60000001");
  const std::string centre =
      "falcon: centre_mm: expected a point that the arms of this geometry reach, found ";
  EXPECT_EQ(refusal([](auto& s) { s.centre_mm = {0, 0, 500.0}; }), centre + "(0, 0, 500)");
  EXPECT_EQ(refusal([&](auto& s) { s.centre_mm = {nan, 0, 0}; }), centre + "(nan, 0, 0)");
}

}  // namespace
}  // namespace clay::falcon
