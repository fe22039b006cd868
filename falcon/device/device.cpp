#include "claystack/falcon/device.hpp"

#include "core/text.hpp"

#include <string>

namespace clay::falcon::inline device {
namespace {

ErrorKind kind_of(DeviceFault fault) noexcept {
  switch (fault) {
    case DeviceFault::bad_firmware:
    case DeviceFault::bad_setting:
      return ErrorKind::bad_input;
    case DeviceFault::unreadable_firmware:
      return ErrorKind::io;
    default:
      return ErrorKind::device;
  }
}

}  // namespace

std::string_view name_of(DeviceFault fault) noexcept {
  switch (fault) {
    case DeviceFault::not_found:
      return "not_found";
    case DeviceFault::no_permission:
      return "no_permission";
    case DeviceFault::driver_bound:
      return "driver_bound";
    case DeviceFault::busy:
      return "busy";
    case DeviceFault::no_firmware:
      return "no_firmware";
    case DeviceFault::bad_firmware:
      return "bad_firmware";
    case DeviceFault::unreadable_firmware:
      return "unreadable_firmware";
    case DeviceFault::echo_error:
      return "echo_error";
    case DeviceFault::no_answer:
      return "no_answer";
    case DeviceFault::unplugged:
      return "unplugged";
    case DeviceFault::transfer_failed:
      return "transfer_failed";
    case DeviceFault::bad_setting:
      return "bad_setting";
  }
  return "unknown";
}

DeviceError::DeviceError(DeviceFault device_fault, std::string found, std::string help)
    : Error{kind_of(device_fault), help.empty() ? found : found + "; " + help},
      fault(device_fault),
      what(std::move(found)),
      remedy(std::move(help)) {}

Error error_of(const OutOfRange& out) {
  // Limits may be computed (0.009000000000000001), and a value may be just beyond one.
  return {ErrorKind::bad_input, std::string(out.setting) + ": expected a value from " +
                                    nine_digit_text(out.low) + " to " + nine_digit_text(out.high) +
                                    ", found " + number_text(out.found)};
}

std::string_view name_of(DeviceState state) noexcept {
  switch (state) {
    case DeviceState::closed:
      return "closed";
    case DeviceState::needs_firmware:
      return "needs_firmware";
    case DeviceState::needs_homing:
      return "needs_homing";
    case DeviceState::ready:
      return "ready";
    case DeviceState::fault:
      return "fault";
  }
  return "unknown";
}

}  // namespace clay::falcon::inline device
