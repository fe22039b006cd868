#include "claystack/falcon/usb.hpp"
#include "falcon/device/usb/hid_node.hpp"

#include <algorithm>
#include <array>

namespace clay::falcon::inline device {
namespace {

constexpr std::size_t kReport = 64;
constexpr std::size_t kMostInReport = kReport - 1;

using Report = std::array<std::uint8_t, 1 + kReport>;  // hidapi puts the report's number first

Report report_of(std::span<const std::uint8_t> bytes) noexcept {
  Report report{};
  report[1] = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), report.begin() + 2);
  return report;
}

/// A Falcon behind a microcontroller that passes its bytes on in HID reports (docs/devices.md).
class BridgeTransport final : public Transport {
 public:
  explicit BridgeTransport(std::string place) : place_(std::move(place)) {}

  [[nodiscard]] std::string describe() const override { return place_; }
  [[nodiscard]] bool loads_firmware() const noexcept override { return false; }
  DeviceResult<void> open() override {
    return node_.open(place_, HidNode::Use::exclusive);  // two programs would mix their forces
  }
  void close() noexcept override { node_.close(); }

  DeviceResult<void> set_mode(LineMode mode) override {
    if (mode != LineMode::running)
      return device_failure(DeviceFault::no_firmware, place_ + ": the bridge loads the firmware",
                            "see docs/devices.md");
    Report old{};
    for (int reports = 0; reports < kMostReportsPerRead; ++reports)
      if (node_.read(std::span(old).first(kReport), 0) <= 0) break;
    return {};
  }

  WireStatus write(std::span<const std::uint8_t> bytes) noexcept override {
    if (bytes.empty() || bytes.size() > kMostWritten) return WireStatus::failed;
    return node_.write(report_of(bytes)) ? WireStatus::ok : WireStatus::unplugged;
  }

  /// Reads the bytes of all available reports for which there is room. Ignores reports with a count
  /// that is too large: they are not from a bridge.
  Received read(std::span<std::uint8_t> bytes, std::int64_t wait_us) noexcept override {
    Received received{0, monotonic_us(), WireStatus::ok};
    const std::int64_t end_us = received.time_us + wait_us;
    for (int reports = 0;
         reports < kMostReportsPerRead && bytes.size() - received.size >= kMostInReport;
         ++reports) {
      const std::int64_t left_us =
          received.size > 0 ? 0 : std::max<std::int64_t>(end_us - monotonic_us(), 0);
      std::array<std::uint8_t, kReport> report{};
      const int size = node_.read(report, left_us);
      if (size < 0) received.status = WireStatus::unplugged;
      if (size <= 0) break;
      const std::size_t count = report[0];
      if (count >= static_cast<std::size_t>(size)) continue;
      std::copy_n(report.begin() + 1, count, bytes.begin() + static_cast<long>(received.size));
      received.size += count;
      received.time_us = monotonic_us();
    }
    return received;
  }

  void write_last(std::span<const std::uint8_t> bytes) noexcept override {
    if (bytes.size() <= kMostWritten) node_.write_last(report_of(bytes));
  }

 private:
  std::string place_;
  HidNode node_;
};

}  // namespace

std::unique_ptr<Transport> make_bridge_transport(std::string place) {
  return std::make_unique<BridgeTransport>(std::move(place));
}

}  // namespace clay::falcon::inline device
