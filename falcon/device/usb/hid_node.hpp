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

  /// Reads one report; returns its size, 0 if none arrives within `wait_us` (rounded up to whole
  /// ms), negative if the device was disconnected.
  int read(std::span<std::uint8_t> report, std::int64_t wait_us) noexcept;
  /// `report` begins with its number, or 0 without numbers. False if the device was disconnected.
  bool write(std::span<const std::uint8_t> report) noexcept;
  /// The same from a signal handler: bypasses hidapi if the device is a /dev node. With the libusb
  /// backend, a handler that interrupted its own thread inside hidapi writes nothing, because the
  /// locks are held. The next write of that thread is then the last packet.
  void write_last(std::span<const std::uint8_t> report) noexcept;

 private:
  hid_device* device_ = nullptr;
  std::atomic<int> descriptor_{-1};
};

}  // namespace clay::falcon::inline device
