#pragma once
// What a device can refuse, told so that a person can act on it.

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace clay::falcon {

enum class DeviceFault {
  not_found,      ///< nothing like it is plugged in
  no_permission,  ///< the system lets this user not open it
  driver_bound,   ///< a kernel driver has it
  busy,           ///< another program has it
  no_firmware,    ///< a Falcon after power-up, and no file to load
  bad_firmware,   ///< the file is no boot stream
  echo_error,     ///< the firmware came back other than it was sent
  no_answer,      ///< open, but silent: most often the power supply
  unplugged,
  transfer_failed,  ///< anything else that the system reports
  bad_setting,
};

struct DeviceError {
  DeviceFault fault = DeviceFault::transfer_failed;
  std::string what;    ///< which device, what was expected, what was found
  std::string remedy;  ///< what to do about it; empty when nothing is known to help
};

template <class T>
using DeviceResult = tl::expected<T, DeviceError>;

[[nodiscard]] inline tl::unexpected<DeviceError> device_failure(DeviceFault fault, std::string what,
                                                                std::string remedy = {}) {
  return tl::make_unexpected(DeviceError{fault, std::move(what), std::move(remedy)});
}

/// For scripts: "no_permission".
[[nodiscard]] std::string_view name_of(DeviceFault fault) noexcept;

/// For people: what, and what to do.
[[nodiscard]] std::string text_of(const DeviceError& error);

}  // namespace clay::falcon
