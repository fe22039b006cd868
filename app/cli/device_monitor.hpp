#pragma once
// Shows a moving device, for people and scripts.

#include "app/cli/console.hpp"
#include "app/servo/mapping.hpp"
#include "claystack/falcon/device.hpp"

namespace clay::cli {

/// Reads the device a thousand times a second with zero force, and shows it, and the tool's
/// position on the wheel, ten times a second: on a terminal in one line, otherwise line by line, as
/// JSON objects if requested. Ends after `seconds` (0: never), on SIGINT or SIGTERM, and with the
/// device's error if it fails.
falcon::DeviceResult<void> watch(falcon::HapticDevice& device, double seconds,
                                 const servo::Mapping& mapping, const Console& console);

}  // namespace clay::cli
