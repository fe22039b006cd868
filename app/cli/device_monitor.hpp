#pragma once
// A device as it moves, for people and scripts.

#include "app/cli/console.hpp"
#include "app/servo/mapping.hpp"
#include "claystack/falcon/device.hpp"

namespace clay::cli {

/// Reads the device a thousand times a second with zero force, and shows it ten times a second, and
/// where the tool would be on the wheel: on a terminal in one line, elsewhere line by line, as JSON
/// objects when asked for. Ends after `seconds` (0: never), on SIGINT or SIGTERM, and with the
/// device's problem when it fails.
falcon::DeviceResult<void> watch(falcon::HapticDevice& device, double seconds,
                                 const servo::Mapping& mapping, const Console& console);

}  // namespace clay::cli
