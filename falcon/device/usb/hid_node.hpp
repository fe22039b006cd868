#pragma once
// One open HID device. Links with either backend of hidapi.

#include "claystack/falcon/device.hpp"

#include <hidapi.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace clay::falcon::inline device {

class HidNode {
 public:
  ~HidNode() { close(); }

  DeviceResult<void> open(const std::string& place);
  void close() noexcept;
  [[nodiscard]] bool is_open() const noexcept { return device_ != nullptr; }

  /// One report; its size, 0 when none came within `wait_us` (whole ms, rounded up), below 0 when
  /// the device is gone.
  int read(std::span<std::uint8_t> report, std::int64_t wait_us) noexcept;
  /// `report` begins with its number, 0 where reports have none. False when the device is gone.
  bool write(std::span<const std::uint8_t> report) noexcept;
  /// The same from a signal handler: past hidapi where the device is a node of /dev. With its
  /// libusb backend a handler that met its own thread inside hidapi writes nothing: the locks are
  /// taken. What that thread writes next is what the device is told last.
  void write_last(std::span<const std::uint8_t> report) noexcept;

 private:
  hid_device* device_ = nullptr;
  std::atomic<int> descriptor_{-1};
};

}  // namespace clay::falcon::inline device
