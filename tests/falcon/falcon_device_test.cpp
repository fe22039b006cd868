#include "claystack/falcon/falcon_device.hpp"

#include "claystack/falcon/loopback_transport.hpp"
#include "dummy_firmware.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

namespace clay::falcon {
namespace {

constexpr std::int64_t kTickUs = 1'000;
// An encoder's count is 67 um at most within 40 mm of the centre; half of one on each leg.
constexpr double kEncoderMm = 0.07;

static_assert(noexcept(std::declval<HapticDevice&>().read(0)));
static_assert(noexcept(std::declval<HapticDevice&>().write({})));
static_assert(noexcept(std::declval<HapticDevice&>().stop()));

/// Where the grip of the model is at each frame [m]: a circle, 20 mm about the centre, 1 turn/s.
glm::dvec3 on_circle(std::uint64_t frame) {
  const double turn = 2e-3 * 3.14159265358979 * static_cast<double>(frame);
  return Kinematics::kCentreM + 0.02 * glm::dvec3(std::cos(turn), std::sin(turn), 0.0);
}

/// A device with its model, on a clock of their own.
struct Bench {
  explicit Bench(FalconModelSettings model_settings = {}, FalconSettings settings = {})
      : model(std::make_shared<FalconModel>(
            std::move(model_settings),
            [this](const glm::dvec3&, double) { return grip(frame++); })) {
    auto transport = std::make_unique<LoopbackTransport>(model, Pace::virtual_);
    line = transport.get();
    device = std::make_unique<FalconDevice>(std::move(transport), settings);
  }

  DeviceSample tick(const glm::dvec3& force_n = {}) {
    device->write(force_n);
    return device->read(kTickUs);
  }

  std::uint64_t frame = 0;
  std::function<glm::dvec3(std::uint64_t)> grip = on_circle;
  std::shared_ptr<FalconModel> model;
  LoopbackTransport* line = nullptr;
  std::unique_ptr<FalconDevice> device;
};

FalconModelSettings ready_model() {
  FalconModelSettings settings;
  settings.loaded = settings.homed = true;
  return settings;
}

class FirmwareFile {
 public:
  FirmwareFile() {
    close(mkstemp(path_.data()));
    const auto bytes = dummy_firmware();
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<long>(bytes.size()));
  }
  ~FirmwareFile() { unlink(path_.c_str()); }
  FirmwareFile(const FirmwareFile&) = delete;
  FirmwareFile& operator=(const FirmwareFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  /// A pattern until mkstemp has put a name in its place.
  std::string path_ = std::filesystem::temp_directory_path() / "firmware-XXXXXX";
};

TEST(FalconDevice, GoesFromPowerUpToReady) {
  const FirmwareFile firmware;
  FalconSettings settings;
  settings.firmware_path = firmware.path();
  Bench bench({}, settings);
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

TEST(FalconDevice, KeepsThePowerOnFirmware) {
  Bench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  EXPECT_TRUE(bench.model->firmware().empty()) << "loaded though it ran already";
  EXPECT_EQ(bench.tick().state, DeviceState::ready);
}

TEST(FalconDevice, SaysThatFirmwareIsMissing) {
  Bench bench;
  const auto opened = bench.device->open();
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().fault, DeviceFault::no_firmware);
  EXPECT_NE(opened.error().remedy.find("--firmware"), std::string::npos);
  EXPECT_EQ(bench.device->read(0).state, DeviceState::needs_firmware);
  EXPECT_EQ(bench.device->problem().fault, DeviceFault::no_firmware);
}

TEST(FalconDevice, TellsAFalconWithoutPowerFromOneWithoutFirmware) {
  FalconModelSettings dark;
  dark.power = false;
  Bench bench(dark);
  const auto opened = bench.device->open();
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().fault, DeviceFault::no_answer);
  EXPECT_NE(opened.error().remedy.find("power supply"), std::string::npos);
}

TEST(FalconDevice, RefusesAFileBeforeAByteOfItIsSent) {
  FalconSettings settings;
  settings.firmware_path = "/dev/null";
  Bench bench({}, settings);
  const auto opened = bench.device->open();
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().fault, DeviceFault::bad_firmware);
  EXPECT_TRUE(bench.model->firmware().empty());
}

TEST(FalconDevice, RefusesNonsenseSettings) {
  const double nan = std::nan("");
  std::vector<FalconSettings> nonsense(7);
  nonsense[0].force_limit_n = 9.0;
  nonsense[1].force_limit_n = nan;
  nonsense[2].motor_counts_per_nm = 0.0;
  nonsense[3].motor_counts_per_nm = nan;
  nonsense[4].silence_us = 0;
  nonsense[5].centre_m = {0, 0, 0.5};
  nonsense[6].centre_m = {nan, 0, 0};
  for (const FalconSettings& settings : nonsense) {
    Bench bench(ready_model(), settings);
    const auto opened = bench.device->open();
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().fault, DeviceFault::bad_setting);
    EXPECT_EQ(bench.model->frames(), 0u);
  }
}

TEST(FalconDevice, SeesTheGripWhereItIs) {
  auto settings = ready_model();
  settings.buttons = kButtonForward | kButtonMinus;
  Bench bench(settings);
  ASSERT_TRUE(bench.device->open());
  std::int64_t last_us = 0;
  for (int i = 0; i < 1000; ++i) {
    const DeviceSample sample = bench.tick();
    ASSERT_TRUE(sample.fresh);
    const glm::dvec3 true_mm = 1e3 * (on_circle(bench.frame - 1) - Kinematics::kCentreM);
    ASSERT_LT(glm::distance(sample.position_mm, true_mm), kEncoderMm) << i;
    EXPECT_EQ(sample.buttons, unsigned{kButtonForward | kButtonMinus});
    EXPECT_GT(sample.time_us, last_us);
    last_us = sample.time_us;
  }
  EXPECT_EQ(bench.device->counters().bytes_discarded, 0u);
  EXPECT_EQ(bench.device->counters().without_pose, 0u);
}

TEST(FalconDevice, RendersTheForceAskedFor) {
  Bench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  for (const glm::dvec3& force :
       {glm::dvec3(1, 0, 0), glm::dvec3(0, -2, 0), glm::dvec3(0, 0, 5), glm::dvec3(3, 3, -4)}) {
    bench.grip = [](std::uint64_t) { return Kinematics::kCentreM; };
    bench.tick();
    bench.tick(force);
    // A count of each motor is 1.5e-4 N m; of the shortest lever, 60 mm, 2.5 mN: half of three.
    EXPECT_LT(glm::distance(bench.model->force_n(), force), 0.01);
  }
}

TEST(FalconDevice, CutsForcesAndSendsNoneThatIsNoNumber) {
  Bench bench(ready_model());
  bench.grip = [](std::uint64_t) { return Kinematics::kCentreM; };
  ASSERT_TRUE(bench.device->open());
  bench.tick();
  for (const double huge : {10.0, 1e6, 1e150}) {
    bench.tick({huge, 0, 0});
    EXPECT_NEAR(glm::length(bench.model->force_n()), 8.0, 0.01) << huge;
    EXPECT_GT(bench.model->force_n().x, 7.9);
  }
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e200}) {
    bench.tick({1, bad, 0});
    EXPECT_EQ(bench.model->motors(), LegCounts{}) << bad;
  }
}

TEST(FalconDevice, TheLastPacketIsZeroAfterStop) {
  Bench bench(ready_model());
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
  EXPECT_EQ(bench.model->motors(), LegCounts{}) << "closed with a force on";
}

TEST(FalconDevice, HasNoForceFromTheFrameOnThatLosesItsHoming) {
  Bench bench(ready_model());
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

struct WireCase {
  WireFault fault;
  std::uint64_t lost;  // frames that do not come
};

class FaultyWire : public testing::TestWithParam<WireCase> {};

TEST_P(FaultyWire, LosesAtMostTwoFramesAndBelievesNoWrongOne) {
  const auto& [fault, lost] = GetParam();
  Bench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  bench.tick();
  const int rounds = 50;
  std::uint64_t missing = 0;
  for (int i = 0; i < rounds; ++i) {
    bench.model->plan({fault, bench.model->frames() + 3});
    for (int tick = 0; tick < 10; ++tick) {
      const DeviceSample sample = bench.tick({1, 0, 0});
      ASSERT_EQ(sample.state, DeviceState::ready);
      // The frame just made, or when that was spoilt the one before it: 1/8 mm apart.
      const glm::dvec3 now = 1e3 * (on_circle(bench.frame - 1) - Kinematics::kCentreM);
      const glm::dvec3 before = 1e3 * (on_circle(bench.frame - 2) - Kinematics::kCentreM);
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

TEST(FalconDevice, TellsThatItWasUnpluggedAndComesBack) {
  const FirmwareFile firmware;
  FalconSettings settings;
  settings.firmware_path = firmware.path();
  Bench bench({}, settings);
  ASSERT_TRUE(bench.device->open());
  for (int i = 0; i < 100; ++i) bench.tick({2, 0, 0});
  bench.model->plan({WireFault::unplugged, 0});
  const DeviceSample sample = bench.tick({2, 0, 0});
  EXPECT_EQ(sample.state, DeviceState::fault);
  EXPECT_FALSE(sample.fresh);
  EXPECT_EQ(bench.device->problem().fault, DeviceFault::unplugged);
  bench.tick({2, 0, 0});  // harmless
  EXPECT_FALSE(bench.device->open());
  bench.model->replug();
  ASSERT_TRUE(bench.device->open());
  EXPECT_EQ(bench.tick().state, DeviceState::needs_homing) << "homing is for this power-up only";
  EXPECT_EQ(bench.model->motors(), LegCounts{});
}

TEST(FalconDevice, IsAtFaultWhenItFallsSilent) {
  Bench bench(ready_model());
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

TEST(FalconDevice, IsNotAtFaultWhenTheHostPauses) {
  Bench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  bench.tick();
  bench.device->write({});
  std::uint8_t none[1];
  EXPECT_EQ(bench.line->read(std::span(none, 0), 3'000'000).size, 0u);  // three seconds pass
  const DeviceSample sample = bench.device->read(0);
  EXPECT_EQ(sample.state, DeviceState::ready);
  EXPECT_TRUE(sample.fresh);
}

TEST(FalconDevice, ReadsTheNewestOfManyFrames) {
  Bench bench(ready_model());
  ASSERT_TRUE(bench.device->open());
  bench.tick();
  for (int i = 0; i < 60; ++i) bench.device->write({});  // 960 bytes come at once
  const DeviceSample sample = bench.device->read(kTickUs);
  const glm::dvec3 newest = 1e3 * (on_circle(bench.frame - 1) - Kinematics::kCentreM);
  EXPECT_LT(glm::distance(sample.position_mm, newest), kEncoderMm);
  EXPECT_FALSE(bench.device->read(0).fresh);
}

TEST(FalconDevice, DoesNotBelieveAnglesWithoutAPose) {
  auto settings = ready_model();
  settings.homed = false;
  settings.unhomed_offset = -5000;  // half a turn: every thigh points away from the user
  Bench bench(settings);
  ASSERT_TRUE(bench.device->open());
  for (int i = 0; i < 10; ++i) {
    const DeviceSample sample = bench.tick();
    EXPECT_EQ(sample.state, DeviceState::needs_homing);
    EXPECT_FALSE(sample.fresh);
    EXPECT_EQ(sample.position_mm, glm::dvec3(0.0));
  }
  EXPECT_EQ(bench.device->counters().without_pose, 11u);
}

}  // namespace
}  // namespace clay::falcon
