#pragma once
// Devices that are plugged in: claystack::falcon_usb, with libftdi1, libusb and hidapi.

#include "claystack/falcon/device.hpp"
#include "claystack/falcon/falcon_device.hpp"
#include "claystack/falcon/space_mouse.hpp"
#include "claystack/falcon/transport.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::falcon {

inline constexpr std::uint16_t kFalconVendor = 0x0403, kFalconProduct = 0xcb48;
/// How a bridge is known: its USB product string begins so.
inline constexpr std::string_view kBridgeProduct = "Falcon HID bridge";

enum class DeviceKind { falcon, bridge, space_mouse };

/// As the command line has it: "falcon", "bridge", "spacemouse".
[[nodiscard]] std::string_view name_of(DeviceKind kind) noexcept;

struct ListedDevice {
  DeviceKind kind = DeviceKind::falcon;
  std::string name;                    ///< "SpaceNavigator"
  std::string place;                   ///< "usb:1-2.1" (bus and ports), "/dev/hidraw3"
  bool usable = true;                  ///< whether it could be opened now
  std::optional<DeviceError> problem;  ///< why not; or, usable, what is worth knowing
};

/// What is plugged in, and whether the system lets it be opened. Sends no byte to any device, so it
/// can't tell whether a Falcon has power or firmware: opening it does. An error only when the
/// system can't be asked at all.
[[nodiscard]] DeviceResult<std::vector<ListedDevice>> list_devices();

struct DeviceSettings {
  FalconSettings falcon;
  SpaceMouseSettings space_mouse;
};

/// A device by kind ("falcon", "bridge", "spacemouse"), by place, or "auto": the first usable one,
/// in that order. It is open.
[[nodiscard]] DeviceResult<std::unique_ptr<HapticDevice>> open_device(
    std::string_view which, const DeviceSettings& settings = {});

/// The parts of it. None touches the device before `open`. After unplugging, `open` finds a Falcon
/// again that is plugged in at the same port.
[[nodiscard]] std::unique_ptr<Transport> make_ftdi_transport(std::string place);
[[nodiscard]] std::unique_ptr<Transport> make_bridge_transport(std::string place);
[[nodiscard]] std::unique_ptr<HapticDevice> make_space_mouse(std::string name, std::string place,
                                                             const SpaceMouseSettings& settings);

}  // namespace clay::falcon
