#pragma once
// Selects the device and reports its errors.

#include "claystack/falcon/device.hpp"
#include "claystack/falcon/sim.hpp"

#include <array>
#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace clay::cli {

/// The names of devices that options accept, beside places.
inline constexpr std::array kDeviceNames = {"auto", "falcon", "bridge", "spacemouse", "simulated"};

/// For CLI options: accepts one of kDeviceNames or a place; otherwise returns the expected values.
[[nodiscard]] std::string check_device_name(const std::string& which);

/// For a Falcon, also behind a bridge: --firmware, or CLAYSTACK_FALCON_FIRMWARE; --geometry and
/// --motor-counts, because published figures differ. `settings` must outlive the command.
void add_falcon_options(CLI::App& command, falcon::FalconSettings& settings);

/// Opens the device. `simulated` is made with the given settings; the others need the USB parts
/// built in.
falcon::DeviceResult<std::unique_ptr<falcon::HapticDevice>> open_chosen(
    const std::string& which, const falcon::FalconSettings& falcon,
    const falcon::SimulatedSettings& simulated);

}  // namespace clay::cli
