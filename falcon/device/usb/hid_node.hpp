#pragma once
// One open HID device. Links with either backend of hidapi.

#include "claystack/falcon/device.hpp"

#include <hidapi.h>

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace clay::falcon::inline device {

class HidNode {
 public:
  ~HidNode() { close(); }

  /// Of two programs that want a device exclusively, one gets it. hidraw permits any number of
  /// openers, so a lock decides; the libusb backend permits one in any case.
  enum class Use { shared, exclusive };

  /// The first time, opens the device at `place`; later the same device at any place: while it was
  /// disconnected, another one may have taken its place. `busy` if another program has it
  /// exclusively too.
  DeviceResult<void> open(const std::string& place, Use use);
  void close() noexcept;
  [[nodiscard]] bool is_open() const noexcept { return device_ != nullptr; }

  /// Reads one report; returns its size, 0 if none arrives within `wait_us` (rounded up to whole
  /// ms) or before a signal, negative if the device was disconnected.
  int read(std::span<std::uint8_t> report, std::int64_t wait_us) noexcept;
  /// `report` begins with its number, or 0 without numbers. False if the device was disconnected.
  bool write(std::span<const std::uint8_t> report) noexcept;
  /// The same from a signal handler: bypasses hidapi if the device is a /dev node. With the libusb
  /// backend, a handler that interrupted its own thread inside hidapi writes nothing, because the
  /// locks are held. The next write of that thread is then the last packet.
  void write_last(std::span<const std::uint8_t> report) noexcept;

 private:
  /// Properties of a device that remain the same when it is unplugged and plugged in again.
  struct Identity {
    unsigned short vendor, product;
    unsigned short usage_page, usage;
    int interface;
    std::wstring serial, name;
    friend bool operator==(const Identity&, const Identity&) = default;
  };
  DeviceResult<void> open_descriptor(const std::string& path, Use use);
  static Identity identity_of(const hid_device_info& info);
  /// The current path of the device that was first opened at `place`; empty: not connected.
  std::string find(const std::string& place);

  std::optional<Identity> identity_;  // of the first device opened
  hid_device* device_ = nullptr;
  std::atomic<int> descriptor_{-1};
};

}  // namespace clay::falcon::inline device
