#pragma once
#include "claystack/falcon/device.hpp"

#include <span>
#include <string>
#include <string_view>

namespace clay::falcon::inline device {

/// The first of `settings` that is NaN or out of its range.
[[nodiscard]] inline tl::expected<void, OutOfRange> check_ranges(
    std::span<const OutOfRange> settings) noexcept {
  for (const OutOfRange& setting : settings)
    if (!(setting.found >= setting.low && setting.found <= setting.high))
      return tl::make_unexpected(setting);
  return {};
}

/// "falcon: force_limit_n: expected a value from 0 to 8.9, found 9".
[[nodiscard]] inline tl::unexpected<DeviceError> bad_setting(std::string_view device,
                                                             const OutOfRange& out) {
  return device_failure(DeviceFault::bad_setting,
                        std::string(device).append(": ").append(error_of(out).message));
}

}  // namespace clay::falcon::inline device
