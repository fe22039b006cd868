#include "claystack/falcon/device.hpp"

namespace clay::falcon::inline device {

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

std::string text_of(const DeviceError& error) {
  return error.remedy.empty() ? error.what : error.what + "; " + error.remedy;
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
