#pragma once
// Which device a person means, and how what is wrong with it is told.

#include "claystack/core/result.hpp"
#include "claystack/falcon/device.hpp"
#include "claystack/falcon/sim.hpp"

#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace clay::cli {

/// A fault of the user's files and settings is bad input, any other the device's.
[[nodiscard]] Error error_of(const falcon::DeviceError& error);

/// For CLI options: auto, falcon, bridge, spacemouse, simulated or a place; otherwise what was
/// expected.
[[nodiscard]] std::string check_device_name(const std::string& which);

/// Of a Falcon, also behind a bridge: --firmware, or CLAYSTACK_FALCON_FIRMWARE; --geometry and
/// --motor-counts, since published figures differ. `settings` outlives the command.
void add_falcon_options(CLI::App& command, falcon::FalconSettings& settings);

/// The device, open. `simulated` is made as it says; the others need the USB parts built in.
Result<std::unique_ptr<falcon::HapticDevice>> open_chosen(
    const std::string& which, const falcon::FalconSettings& falcon,
    const falcon::SimulatedSettings& simulated);

}  // namespace clay::cli
