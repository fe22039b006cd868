#pragma once
// What libusb and the system say, as a device error.

#include "claystack/falcon/device.hpp"

#include <string>

struct libusb_device;

namespace clay::falcon::inline device {

/// "usb:1-2.1": the bus, and the port of each hub on the way. The same after replugging.
[[nodiscard]] std::string place_of(libusb_device* device);

/// Of a failed libusb call that set out to do `action` ("open").
[[nodiscard]] DeviceError usb_error(const std::string& place, const std::string& action, int code);

/// Whether the device can be opened and claimed; `driver_bound` when a kernel driver has it, which
/// opening it would end.
[[nodiscard]] DeviceResult<void> check_usb_access(libusb_device* device);

/// A node in /dev that could not be opened.
[[nodiscard]] DeviceError node_error(const std::string& place);

}  // namespace clay::falcon::inline device
