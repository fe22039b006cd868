#pragma once
// Converts errors of libusb and the system to device errors.

#include "claystack/falcon/device.hpp"

#include <string>

struct libusb_device;

namespace clay::falcon::inline device {

/// "usb:1-2.1": the bus, and the port at each hub. The same after reconnecting.
[[nodiscard]] std::string place_of(libusb_device* device);

/// For a failed libusb call during `action` (such as "open").
[[nodiscard]] DeviceError usb_error(const std::string& place, const std::string& action, int code);

/// Checks whether the device can be opened and claimed; `driver_bound` if a kernel driver holds it,
/// which opening would detach.
[[nodiscard]] DeviceResult<void> check_usb_access(libusb_device* device);

/// For a node in /dev that could not be opened.
[[nodiscard]] DeviceError node_error(const std::string& place);

}  // namespace clay::falcon::inline device
