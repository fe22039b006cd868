#include "tests/falcon/device/falcon_bench.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace clay::falcon {
namespace {

static_assert(noexcept(std::declval<HapticDevice&>().read(0)));
static_assert(noexcept(std::declval<HapticDevice&>().write({})));
static_assert(noexcept(std::declval<HapticDevice&>().stop()));

TEST(FalconDevice, ReportsTheGripPosition) {
  auto settings = ready_model();
  settings.buttons = kButtonForward | kButtonMinus;
  FalconBench bench(settings);
  ASSERT_TRUE(bench.device->open());
  std::int64_t last_us = 0;
  for (int i = 0; i < 1000; ++i) {
    const DeviceSample sample = bench.tick();
    ASSERT_TRUE(sample.fresh);
    const glm::dvec3 true_mm = on_circle(bench.frame - 1) - kFalconCentreMm;
    ASSERT_LT(glm::distance(sample.position_mm, true_mm), kEncoderMm) << i;
    EXPECT_EQ(sample.buttons, unsigned{kButtonForward | kButtonMinus});
    EXPECT_GT(sample.time_us, last_us);
    last_us = sample.time_us;
  }
  EXPECT_EQ(bench.device->counters().bytes_discarded, 0u);
  EXPECT_EQ(bench.device->counters().without_pose, 0u);
}

TEST(FalconDevice, RendersTheRequestedForce) {
  FalconBench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  for (const glm::dvec3& force :
       {glm::dvec3(1, 0, 0), glm::dvec3(0, -2, 0), glm::dvec3(0, 0, 5), glm::dvec3(3, 3, -4)}) {
    bench.grip = [](std::uint64_t) { return kFalconCentreMm; };
    bench.tick();
    bench.tick(force);
    // One motor count is 1.5e-4 N m, or 2.5 mN at the shortest lever, 60 mm; three motors are each
    // off by half a count.
    EXPECT_LT(glm::distance(bench.model->force_n(), force), 0.01);
  }
}

TEST(FalconDevice, LimitsForcesAndSendsZeroForNan) {
  FalconBench bench(ready_model());
  bench.grip = [](std::uint64_t) { return kFalconCentreMm; };
  ASSERT_TRUE(bench.device->open());
  bench.tick();
  for (const double huge : {10.0, 1e6, 1e150, 1e200}) {
    bench.tick({huge, 0, 0});
    EXPECT_NEAR(glm::length(bench.model->force_n()), 8.0, 0.01) << huge;
    EXPECT_GT(bench.model->force_n().x, 7.9);
  }
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    bench.tick({1, bad, 0});
    EXPECT_EQ(bench.model->motors(), LegCounts{}) << bad;
  }
}

TEST(FalconDevice, LastPacketIsZeroAfterStop) {
  FalconBench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  bench.tick();
  bench.tick({4, 0, 0});
  ASSERT_NE(bench.model->motors(), LegCounts{});
  bench.device->stop();
  EXPECT_EQ(bench.model->motors(), LegCounts{});
  const std::uint64_t frames = bench.model->frames();
  bench.tick({4, 0, 0});
  EXPECT_EQ(bench.model->frames(), frames) << "a frame after the last one";
  ASSERT_TRUE(bench.device->open());
  bench.tick();
  bench.tick({4, 0, 0});
  EXPECT_NE(bench.model->motors(), LegCounts{});
  bench.device.reset();
  EXPECT_EQ(bench.model->motors(), LegCounts{}) << "closed while a force was on";
}

TEST(FalconDevice, SendsZeroFromTheFrameThatLosesHoming) {
  FalconBench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  for (int i = 0; i < 10; ++i) bench.tick({3, 0, 0});
  bench.model->plan({WireFault::homing_lost, 0});
  EXPECT_EQ(bench.tick({3, 0, 0}).state, DeviceState::needs_homing);
  DeviceSample sample;
  for (int i = 0; i < 200; ++i) {
    sample = bench.tick({3, 0, 0});
    if (sample.state == DeviceState::ready) break;
    ASSERT_EQ(bench.model->motors(), LegCounts{}) << i;
  }
  EXPECT_EQ(sample.state, DeviceState::ready) << "homed again";
}

TEST(FalconDevice, ReadsTheNewestOfManyFrames) {
  FalconBench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  bench.tick();
  for (int i = 0; i < 60; ++i) bench.device->write({});  // 960 bytes arrive at once
  const DeviceSample sample = bench.device->read(kTickUs);
  const glm::dvec3 newest = on_circle(bench.frame - 1) - kFalconCentreMm;
  EXPECT_LT(glm::distance(sample.position_mm, newest), kEncoderMm);
  EXPECT_FALSE(bench.device->read(0).fresh);
}

/// A line that sends homed frames without end: each reading fills the buffer.
class FloodLine final : public Transport {
 public:
  explicit FloodLine(int& readings) : readings_(readings) {}
  [[nodiscard]] std::string describe() const override { return "flood"; }
  [[nodiscard]] bool loads_firmware() const noexcept override { return false; }
  DeviceResult<void> open() override { return {}; }
  void close() noexcept override {}
  DeviceResult<void> set_mode(LineMode) override { return {}; }
  WireStatus write(std::span<const std::uint8_t>) noexcept override { return WireStatus::ok; }
  Received read(std::span<std::uint8_t> bytes, std::int64_t) noexcept override {
    constexpr std::string_view kFrame =
        "<AAAAAAAAAAAA\xB1"
        "A>";
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<std::uint8_t>(kFrame[i % kFrame.size()]);
    return {++readings_ < 1'000'000 ? bytes.size() : 0, now_us(), WireStatus::ok};
  }
  void write_last(std::span<const std::uint8_t>) noexcept override {}

 private:
  int& readings_;
};

TEST(FalconDevice, AFloodOfFramesDoesNotHoldTheReader) {
  int readings = 0;
  const auto device = make_falcon(std::make_unique<FloodLine>(readings), {});
  ASSERT_TRUE(device->open());
  readings = 0;
  const DeviceSample sample = device->read(kTickUs);
  EXPECT_TRUE(sample.fresh);
  EXPECT_EQ(sample.state, DeviceState::ready);
  EXPECT_EQ(readings, 8) << "twice what a transport keeps";
}

/// A line that still brings a frame for an earlier program, before its own answer is due.
class UsedLine final : public Transport {
 public:
  UsedLine(std::shared_ptr<FalconModel> model, std::int64_t answer_us)
      : line_(std::move(model), SimClock::stepped), answer_us_(answer_us) {
    line_.answer_after(answer_us);
  }
  [[nodiscard]] std::string describe() const override { return "used"; }
  [[nodiscard]] bool loads_firmware() const noexcept override { return true; }
  DeviceResult<void> open() override { return line_.open(); }
  void close() noexcept override { line_.close(); }
  DeviceResult<void> set_mode(LineMode mode) override { return line_.set_mode(mode); }
  WireStatus write(std::span<const std::uint8_t> bytes) noexcept override {
    return line_.write(bytes);
  }
  Received read(std::span<std::uint8_t> bytes, std::int64_t wait_us) noexcept override {
    if (std::exchange(read_, true)) return line_.read(bytes, wait_us);
    (void)line_.read({}, answer_us_ / 2);
    const FrameBytes old = encode({});
    std::copy(old.begin(), old.end(), bytes.begin());
    return {old.size(), now_us(), WireStatus::ok};
  }
  void write_last(std::span<const std::uint8_t> bytes) noexcept override {
    line_.write_last(bytes);
  }
  [[nodiscard]] std::int64_t now_us() const noexcept override { return line_.now_us(); }

 private:
  LoopbackTransport line_;
  std::int64_t answer_us_;
  bool read_ = false;
};

TEST(FalconDevice, MeasuresTheTimeOfItsAnswersOneAtATime) {
  for (const std::int64_t answer_us : {1'000, 4'000, 12'345}) {
    const auto model = std::make_shared<FalconModel>(
        ready_model(), [](const glm::dvec3&, double) { return kFalconCentreMm; });
    FalconDevice device(std::make_unique<UsedLine>(model, answer_us), {});
    EXPECT_EQ(device.info().answer_us, 0);
    ASSERT_TRUE(device.open());
    EXPECT_EQ(device.info().answer_us, answer_us);
    EXPECT_EQ(model->motors(), LegCounts{});
  }
}

TEST(FalconDevice, RejectsAnglesWithoutAPose) {
  auto settings = ready_model();
  settings.homed = false;
  settings.unhomed_offset = -5000;  // half a turn: every thigh points away from the user
  FalconBench bench(settings);
  ASSERT_TRUE(bench.device->open());
  for (int i = 0; i < 10; ++i) {
    const DeviceSample sample = bench.tick();
    EXPECT_EQ(sample.state, DeviceState::needs_homing);
    EXPECT_FALSE(sample.fresh);
    EXPECT_EQ(sample.position_mm, glm::dvec3(0.0));
  }
  EXPECT_EQ(bench.device->counters().without_pose, bench.model->frames());
}

}  // namespace
}  // namespace clay::falcon
