#include "claystack/falcon/usb.hpp"

#include <array>
#include <string>
#include <utility>

namespace clay::falcon::inline device {
namespace {

constexpr std::uint8_t kLight = 4;  // the number of the report that switches the LED

class SpaceMouse final : public HapticDevice {
 public:
  SpaceMouse(std::string name, std::string place, const SpaceMouseSettings& settings,
             std::unique_ptr<ReportPort> port)
      : settings_(settings), port_(std::move(port)), motion_(settings) {
    info_ = {std::move(name), std::move(place), false, 0.0, glm::dvec3(settings.half_workspace_mm),
             1000.0};
  }
  ~SpaceMouse() override { light(false); }

  [[nodiscard]] const DeviceInfo& info() const noexcept override { return info_; }

  DeviceResult<void> open() override {
    auto opened = check(settings_).and_then([this] { return port_->open(info_.place); });
    reports_ = {};
    counters_ = {};
    sample_ = {};
    sample_.state = opened ? DeviceState::ready : DeviceState::closed;
    if (!opened) {
      problem_ = opened.error();
      return opened;
    }
    // After a lost connection the position stays where it was.
    if (!std::exchange(lost_, false)) motion_ = RateControl(settings_);
    light(true);
    return opened;
  }

  /// Does not wait: the position follows from the time.
  DeviceSample read(std::int64_t) noexcept override {
    sample_.fresh = false;
    if (sample_.state != DeviceState::ready) return sample_;
    std::array<std::uint8_t, 64> report{};
    int size = 0;
    const std::int64_t now_us = port_->now_us();
    for (int reports = 0; reports < kMostReportsPerRead && (size = port_->read(report)) > 0;
         ++reports) {
      ++counters_.frames;
      if (reports_.take(std::span(report).first(static_cast<std::size_t>(size))))
        heard_us_ = now_us;
    }
    if (size < 0) {
      lost_ = true;
      sample_.state = DeviceState::fault;
      return sample_;
    }
    // The release report may be lost: a deflected controller sends reports continuously.
    if (now_us - heard_us_ > settings_.silence_us) reports_.release();
    motion_.advance(reports_.deflection(), now_us);
    sample_ = {now_us, motion_.position_mm(), reports_.buttons(), DeviceState::ready, true};
    return sample_;
  }

  void write(const glm::dvec3&) noexcept override {}
  void zero() noexcept override {}
  void stop() noexcept override {}

  [[nodiscard]] DeviceError problem() const override {
    if (sample_.state != DeviceState::fault) return problem_;
    return {DeviceFault::unplugged, info_.place + ": unplugged", "plug it in again"};
  }
  [[nodiscard]] DeviceCounters counters() const noexcept override { return counters_; }

 private:
  void light(bool on) noexcept {
    port_->write(std::array<std::uint8_t, 2>{kLight, static_cast<std::uint8_t>(on ? 1 : 0)});
  }

  SpaceMouseSettings settings_;
  DeviceInfo info_;
  std::unique_ptr<ReportPort> port_;
  SpaceMouseReports reports_;
  RateControl motion_;
  DeviceSample sample_;
  DeviceCounters counters_;
  DeviceError problem_;
  std::int64_t heard_us_ = 0;
  bool lost_ = false;  // the connection, since it was opened
};

}  // namespace

std::unique_ptr<HapticDevice> make_space_mouse(std::string name, std::string place,
                                               const SpaceMouseSettings& settings,
                                               std::unique_ptr<ReportPort> port) {
  return std::make_unique<SpaceMouse>(std::move(name), std::move(place), settings, std::move(port));
}

}  // namespace clay::falcon::inline device
