// Wire faults and silence.

#include "tests/falcon/device/falcon_bench.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/geometric.hpp>
#include <span>

namespace clay::falcon {
namespace {

struct WireCase {
  WireFault fault;
  std::uint64_t lost;  // frames lost per fault
};

class FaultyWire : public testing::TestWithParam<WireCase> {};

TEST_P(FaultyWire, LosesAtMostTwoFramesAndAcceptsNoWrongFrame) {
  const auto& [fault, lost] = GetParam();
  FalconBench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  bench.tick();
  const int rounds = 50;
  std::uint64_t missing = 0;
  for (int i = 0; i < rounds; ++i) {
    bench.model->plan({fault, bench.model->frames() + 3});
    for (int tick = 0; tick < 10; ++tick) {
      const DeviceSample sample = bench.tick({1, 0, 0});
      ASSERT_EQ(sample.state, DeviceState::ready);
      // The current frame, or after a fault the previous one: 1/8 mm apart.
      const glm::dvec3 now = (on_circle(bench.frame - 1) - kFalconCentreMm);
      const glm::dvec3 before = (on_circle(bench.frame - 2) - kFalconCentreMm);
      if (!sample.fresh) ++missing;
      ASSERT_LT(glm::distance(sample.position_mm,
                              sample.fresh && fault != WireFault::stale_frame ? now : before),
                fault == WireFault::stale_frame ? 0.126 + kEncoderMm : kEncoderMm)
          << i << " " << tick;
    }
  }
  EXPECT_EQ(missing, lost * rounds);
}

INSTANTIATE_TEST_SUITE_P(
    All, FaultyWire,
    testing::Values(WireCase{WireFault::lost_byte, 1}, WireCase{WireFault::extra_byte, 1},
                    WireCase{WireFault::half_frame, 1}, WireCase{WireFault::bad_nibble, 1},
                    WireCase{WireFault::no_frame, 1}, WireCase{WireFault::stale_frame, 0}));

TEST(FalconWire, ReportsUnpluggingAndReconnects) {
  const FirmwareFile firmware;
  FalconSettings settings;
  settings.firmware_path = firmware.path();
  FalconBench bench({}, settings);
  ASSERT_TRUE(bench.device->open());
  for (int i = 0; i < 100; ++i) bench.tick({2, 0, 0});
  bench.model->plan({WireFault::unplugged, 0});
  const DeviceSample sample = bench.tick({2, 0, 0});
  EXPECT_EQ(sample.state, DeviceState::fault);
  EXPECT_FALSE(sample.fresh);
  EXPECT_EQ(bench.device->problem().fault, DeviceFault::unplugged);
  bench.tick({2, 0, 0});  // must have no effect
  EXPECT_FALSE(bench.device->open());
  bench.model->replug();
  ASSERT_TRUE(bench.device->open());
  EXPECT_EQ(bench.tick().state, DeviceState::needs_homing) << "homing holds for one power-up only";
  EXPECT_EQ(bench.model->motors(), LegCounts{});
}

TEST(FalconWire, ReportsAFaultWhenTheDeviceIsSilent) {
  FalconBench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  bench.tick();
  const std::uint64_t silent = 1000;
  for (std::uint64_t i = 0; i < silent; ++i)
    bench.model->plan({WireFault::no_frame, bench.model->frames()});
  int ticks = 0;
  while (bench.tick({1, 0, 0}).state == DeviceState::ready && ticks < 2000) ++ticks;
  EXPECT_EQ(ticks, 500) << "silence_us is 0.5 s, a tick 1 ms";
  EXPECT_EQ(bench.device->problem().fault, DeviceFault::no_answer);
}

TEST(FalconWire, ReportsNoFaultWhenTheHostPauses) {
  FalconBench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  bench.tick();
  bench.device->write({});
  std::uint8_t none[1];
  EXPECT_EQ(bench.line->read(std::span(none, 0), 3'000'000).size, 0u);  // three seconds pass
  const DeviceSample sample = bench.device->read(0);
  EXPECT_EQ(sample.state, DeviceState::ready);
  EXPECT_TRUE(sample.fresh);
}

}  // namespace
}  // namespace clay::falcon
