#include "claystack/falcon/usb.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace clay::falcon {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A report as the device sends it: its number, then int16 values, low byte first.
Bytes report(std::uint8_t number, const std::vector<int>& values) {
  Bytes bytes = {number};
  for (const int value : values) {
    const unsigned word = static_cast<std::uint16_t>(value);
    bytes.push_back(static_cast<std::uint8_t>(word % 256));
    bytes.push_back(static_cast<std::uint8_t>(word / 256));
  }
  return bytes;
}

TEST(SpaceMouseReports, ConvertAxesToTheDeviceFrame) {
  SpaceMouseReports reports;
  // Raw: x right, y to the user, z down. Device: x right, y up, z to the user.
  EXPECT_TRUE(reports.take(report(1, {350, 0, 0})));
  EXPECT_EQ(reports.deflection(), glm::dvec3(1, 0, 0));
  EXPECT_TRUE(reports.take(report(1, {0, 350, 0})));
  EXPECT_EQ(reports.deflection(), glm::dvec3(0, 0, 1));
  EXPECT_TRUE(reports.take(report(1, {0, 0, 350})));
  EXPECT_EQ(reports.deflection(), glm::dvec3(0, -1, 0));
  EXPECT_TRUE(reports.take(report(1, {-175, 0, 0})));
  EXPECT_EQ(reports.deflection(), glm::dvec3(-0.5, 0, 0));
}

TEST(SpaceMouseReports, ReadTheLongFormAndIgnoreRotation) {
  SpaceMouseReports reports;
  EXPECT_TRUE(reports.take(report(1, {350, -350, 0, 1, 2, 3})));
  const glm::dvec3 moved(1, 0, -1);
  EXPECT_EQ(reports.deflection(), moved);
  EXPECT_FALSE(reports.take(report(2, {300, 300, 300})));
  EXPECT_EQ(reports.deflection(), moved);
}

TEST(SpaceMouseReports, NeverExceedFullDeflection) {
  SpaceMouseReports reports;
  EXPECT_TRUE(reports.take(report(1, {32767, -32768, 500})));
  EXPECT_EQ(reports.deflection(), glm::dvec3(1, -1, -1));
}

TEST(SpaceMouseReports, ReadButtonsOfEverySize) {
  SpaceMouseReports reports;
  EXPECT_TRUE(reports.take(Bytes{3, 2}));
  EXPECT_EQ(reports.buttons(), 2u);
  EXPECT_TRUE(reports.take(Bytes{3, 0x01, 0x80}));
  EXPECT_EQ(reports.buttons(), 0x8001u);
  EXPECT_TRUE(reports.take(Bytes{3, 1, 0, 0, 0x40, 0xFF, 0xFF}));
  EXPECT_EQ(reports.buttons(), 0x40000001u);
  EXPECT_TRUE(reports.take(Bytes{3, 0}));
  EXPECT_EQ(reports.buttons(), 0u);
}

RC_GTEST_PROP(SpaceMouseReports, IgnoreShortAndUnknownReports, ()) {
  SpaceMouseReports reports;
  RC_ASSERT(reports.take(report(1, {35, 70, 105})));
  const glm::dvec3 before = reports.deflection();
  auto bytes = *rc::gen::container<Bytes>(rc::gen::arbitrary<std::uint8_t>());
  const bool translation = bytes.size() >= 7 && bytes[0] == 1;
  const bool buttons = bytes.size() >= 2 && bytes[0] == 3;
  RC_ASSERT(reports.take(bytes) == (translation || buttons));
  if (!translation) RC_ASSERT(reports.deflection() == before);
}

TEST(SpaceMouseModels, ListEachSixAxisModelOnce) {
  std::set<std::pair<int, int>> ids;
  for (const SpaceMouseModel& model : space_mouse_models()) {
    EXPECT_TRUE(ids.emplace(model.vendor, model.product).second);
    EXPECT_FALSE(model.name.empty());
  }
  EXPECT_EQ(ids.size(), 21u);
  EXPECT_TRUE(ids.count({0x046d, 0xc626}) && ids.count({0x256f, 0xc635}));
  for (const int keypad : {0xc650, 0xc651, 0xc654, 0xc658, 0xc664, 0xc668})
    EXPECT_FALSE(ids.count({0x256f, keypad}));
}

TEST(RateControl, MovesAtTheSetSpeed) {
  RateControl control({});
  const SpaceMouseSettings settings;
  control.advance({1, 0, 0}, 1'000'000);
  for (int ms = 1; ms <= 1000; ++ms) control.advance({1, 0, 0}, 1'000'000 + 1000 * ms);
  EXPECT_NEAR(control.position_mm().x, settings.speed_mm_s, 1e-9);
  EXPECT_EQ(control.position_mm().y, 0.0);
}

TEST(RateControl, StaysStillInTheDeadZoneAndIsContinuousBeyond) {
  RateControl control({});
  control.advance({0, 0.05, 0}, 1);
  for (int i = 0; i < 1000; ++i) control.advance({0, 0.05, 0}, 1 + 1000 * i);
  EXPECT_EQ(control.position_mm(), glm::dvec3(0.0));
  // Midway between dead zone and full deflection: a quarter of the speed.
  RateControl half({});
  half.advance({0, 0.525, 0}, 1);
  for (int i = 1; i <= 1000; ++i) half.advance({0, 0.525, 0}, 1 + 1000 * i);
  EXPECT_NEAR(half.position_mm().y, 20.0, 1e-9);
}

RC_GTEST_PROP(RateControl, StaysInItsWorkspaceAndMovesNoFasterThanSet, ()) {
  RateControl control({});
  std::int64_t now = 1;
  control.advance({}, now);
  for (int i = 0; i < 50; ++i) {
    const auto axis = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
    const auto step_us = *rc::gen::inRange<std::int64_t>(-100'000, 2'000'000);
    const glm::dvec3 before = control.position_mm();
    control.advance({axis(), axis(), axis()}, now += step_us);
    const double seconds = std::clamp(1e-6 * static_cast<double>(step_us), 0.0, 0.05);
    RC_ASSERT(glm::distance(before, control.position_mm()) <= 80.0 * seconds + 1e-9);
    for (int k = 0; k < 3; ++k) RC_ASSERT(std::abs(control.position_mm()[k]) <= 100.0);
  }
}

/// A controller that sends without end: each reading brings another report.
class FloodPort final : public ReportPort {
 public:
  explicit FloodPort(int& readings) : readings_(readings) {}
  DeviceResult<void> open(const std::string&) override { return {}; }
  int read(std::span<std::uint8_t> bytes) noexcept override {
    const Bytes full_right = report(1, {350, 0, 0});
    std::copy(full_right.begin(), full_right.end(), bytes.begin());
    return ++readings_ < 1'000'000 ? static_cast<int>(full_right.size()) : 0;
  }
  void write(std::span<const std::uint8_t>) noexcept override {}

 private:
  int& readings_;
};

TEST(SpaceMouse, AFloodOfReportsDoesNotHoldTheReader) {
  int readings = 0;
  const auto mouse =
      make_space_mouse("flood", "nowhere", {}, std::make_unique<FloodPort>(readings));
  ASSERT_TRUE(mouse->open());
  EXPECT_EQ(mouse->read(0).state, DeviceState::ready);
  EXPECT_EQ(readings, 64) << "as many reports as the kernel keeps";
}

TEST(SpaceMouseSettings, AreRefusedOutsideTheirRanges) {
  EXPECT_TRUE(check(SpaceMouseSettings{}));
  const auto refusal = [](auto change) {
    SpaceMouseSettings settings;
    change(settings);
    const auto checked = check(settings);
    return checked ? std::string("accepted") : checked.error().message;
  };
  EXPECT_EQ(refusal([](auto& s) { s.speed_mm_s = 0.0; }),
            "spacemouse: speed_mm_s: expected a value from 1 to 500, found 0");
  EXPECT_EQ(refusal([](auto& s) { s.dead_zone = std::nan(""); }),
            "spacemouse: dead_zone: expected a value from 0 to 0.5, found nan");
  EXPECT_EQ(refusal([](auto& s) { s.half_workspace_mm = 1e6; }),
            "spacemouse: half_workspace_mm: expected a value from 10 to 1000, found 1e+06");
  EXPECT_EQ(refusal([](auto& s) { s.silence_us = 0; }),
            "spacemouse: silence_us: expected a value from 20000 to 1000000, found 0");
}

}  // namespace
}  // namespace clay::falcon
