#include "falcon/device/usb/usb_error.hpp"

#include <libusb.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

namespace clay::falcon::inline device {
namespace {

constexpr const char* kRule =
    "install the udev rule (60-claystack.rules, see docs/devices.md) and plug it in again";
constexpr const char* kOtherProgram = "close the other program that uses it";

using Handle = std::unique_ptr<libusb_device_handle, decltype(&libusb_close)>;

}  // namespace

std::string place_of(libusb_device* device) {
  std::array<std::uint8_t, 8> ports{};
  const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
  std::string place = "usb:" + std::to_string(libusb_get_bus_number(device));
  for (int i = 0; i < depth; ++i)
    place.append(i == 0 ? "-" : ".").append(std::to_string(ports[static_cast<std::size_t>(i)]));
  return place;
}

DeviceError usb_error(const std::string& place, const std::string& action, int code) {
  const std::string what = place + ": could not " + action + ": ";
  switch (code) {
    case LIBUSB_ERROR_ACCESS:
      return {DeviceFault::no_permission, what + "no permission", kRule};
    case LIBUSB_ERROR_BUSY:
      return {DeviceFault::busy, what + "another program uses it", kOtherProgram};
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND:
      return {DeviceFault::unplugged, what + "it was unplugged", "plug it in again"};
    default:
      return {DeviceFault::transfer_failed, what + libusb_error_name(code),
              "unplug it and plug it in again"};
  }
}

DeviceResult<void> check_usb_access(libusb_device* device) {
  const std::string place = place_of(device);
  libusb_device_handle* raw = nullptr;
  if (const int code = libusb_open(device, &raw); code != 0)
    return tl::make_unexpected(usb_error(place, "open", code));
  const Handle handle(raw, &libusb_close);
  if (libusb_kernel_driver_active(raw, 0) == 1)
    return device_failure(DeviceFault::driver_bound,
                          place + ": a kernel driver uses it (ftdi_sio?)",
                          "opening it here detaches the driver; to detach it permanently, remove "
                          "0403 cb48 through the driver's remove_id");
  const int claimed = libusb_claim_interface(raw, 0);
  if (claimed != 0) return tl::make_unexpected(usb_error(place, "claim", claimed));
  libusb_release_interface(raw, 0);
  return {};
}

DeviceError node_error(const std::string& place) {
  const std::string what = place + ": could not open: ";
  // hidapi does not report the cause, and its libusb backend has no node to check.
  if (place.front() != '/' || access(place.c_str(), R_OK | W_OK) == 0)
    return {DeviceFault::busy, what + "another program uses it, or no permission", kRule};
  if (errno == ENOENT || errno == ENODEV)
    return {DeviceFault::unplugged, what + "it is not there", "plug it in again"};
  return {DeviceFault::no_permission, what + std::strerror(errno), kRule};
}

}  // namespace clay::falcon::inline device
