#include "claystack/falcon/sim.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace clay::falcon {
namespace {

constexpr std::int64_t kTickUs = 1'000;

SimulatedSettings in_virtual_time() {
  SimulatedSettings settings = simulated_and_loaded();
  settings.clock = SimClock::stepped;
  return settings;
}

DeviceSample homed(HapticDevice& device) {
  DeviceSample sample;
  for (int i = 0; i < 500 && sample.state != DeviceState::ready; ++i) {
    device.write({});
    sample = device.read(kTickUs);
  }
  return sample;
}

TEST(SimulatedFalcon, RefusesNoHomingFramesAndNoPath) {
  SimulatedSettings settings = in_virtual_time();
  settings.model.homing_frames = 0;
  auto refused = make_simulated_falcon(settings);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().fault, DeviceFault::bad_setting);
  EXPECT_NE(refused.error().what.find("homing_frames"), std::string::npos);
  settings = in_virtual_time();
  settings.path = {};
  refused = make_simulated_falcon(settings);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().fault, DeviceFault::bad_setting);
}

TEST(SimulatedFalcon, IsHomedAndFollowsTheHand) {
  auto simulated = make_simulated_falcon(in_virtual_time());
  ASSERT_TRUE(simulated);
  HapticDevice& device = *simulated->device;
  EXPECT_EQ(device.info().name, "Simulated Falcon");
  ASSERT_TRUE(device.open());
  EXPECT_EQ(homed(device).state, DeviceState::ready);
  for (int i = 0; i < 4000; ++i) {
    device.write({});
    const DeviceSample sample = device.read(kTickUs);
    ASSERT_TRUE(sample.fresh);
    // The hand's spring of 300 N/m lags: 2 N s/m at 31 mm/s, and 0.25 kg on a circle.
    EXPECT_NEAR(glm::length(sample.position_mm), 20.0, 0.5) << i;
  }
}

TEST(SimulatedFalcon, DeflectsByForceOverHandStiffness) {
  SimulatedSettings settings = in_virtual_time();
  settings.path = [](double) { return glm::dvec3(0.0); };
  auto simulated = make_simulated_falcon(settings);
  ASSERT_TRUE(simulated);
  HapticDevice& device = *simulated->device;
  ASSERT_TRUE(device.open());
  homed(device);
  DeviceSample sample;
  for (int i = 0; i < 3000; ++i) {
    device.write({3, 0, 0});
    sample = device.read(kTickUs);
  }
  // 3 N / 300 N/m = 10 mm; motors and encoders step by less than 0.1 mm.
  EXPECT_LT(glm::distance(sample.position_mm, {10, 0, 0}), 0.1);
}

TEST(SimulatedFalcon, KeepsItsTimeWhenFramesAreLate) {
  SimulatedSettings settings = in_virtual_time();
  settings.path = [](double time_s) { return glm::dvec3(10.0 * time_s, 0, 0); };  // 10 mm/s
  auto simulated = make_simulated_falcon(settings);
  ASSERT_TRUE(simulated);
  HapticDevice& device = *simulated->device;
  ASSERT_TRUE(device.open());
  const DeviceSample before = homed(device);
  DeviceSample sample;
  for (int i = 0; i < 300; ++i) {  // three ticks of the arm per frame
    device.write({});
    while (!(sample = device.read(3 * kTickUs)).fresh) {
    }
    // The answer takes 1 ms; then 2 ms more pass.
    (void)device.read(2 * kTickUs);
  }
  const double seconds = 1e-6 * static_cast<double>(sample.time_us - before.time_us);
  EXPECT_GT(seconds, 0.85);
  EXPECT_NEAR(sample.position_mm.x - before.position_mm.x, 10.0 * seconds, 0.15);
}

TEST(SimulatedFalcon, ErrorsNameTheSetting) {
  SimulatedSettings settings = in_virtual_time();
  settings.arm.loop.mass_kg = std::nan("");
  const auto simulated = make_simulated_falcon(settings);
  ASSERT_FALSE(simulated);
  EXPECT_EQ(simulated.error().fault, DeviceFault::bad_setting);
  EXPECT_NE(simulated.error().what.find("mass_kg"), std::string::npos);
}

TEST(SimulatedFalcon, RunsInRealTime) {
  auto simulated = make_simulated_falcon(simulated_and_loaded());
  ASSERT_TRUE(simulated);
  HapticDevice& device = *simulated->device;
  ASSERT_TRUE(device.open());
  const std::int64_t start_us = monotonic_us();
  device.write({});
  const DeviceSample sample = device.read(10'000'000);
  EXPECT_TRUE(sample.fresh);
  EXPECT_GE(sample.time_us, start_us + 1'000) << "an answer takes a millisecond";
}

}  // namespace
}  // namespace clay::falcon
