#pragma once
#include "claystack/falcon/device.hpp"
#include "claystack/falcon/falcon_device.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay::falcon::inline device {

// ---- space mouse ---------------------------------------------------------------------
// 3Dconnexion controllers: a cap that is pushed a little way, and does not push back. How far it is
// pushed is a speed, and the speeds add up to a position.

struct SpaceMouseModel {
  std::uint16_t vendor = 0, product = 0;
  std::string_view name;
};

/// The controllers of six axes. 3Dconnexion's other devices (keypads, mice of two axes) are not
/// among them.
[[nodiscard]] std::span<const SpaceMouseModel> space_mouse_models() noexcept;

/// Reads reports: 1 is translation, with rotation behind it in the longer form that the wireless
/// ones send; 2 is rotation, which has no use here; 3 is buttons. Numbers are int16, low byte
/// first.
class SpaceMouseReports {
 public:
  /// `report` begins with its number. False: of no use, nothing changed (unknown, or too short).
  bool take(std::span<const std::uint8_t> report) noexcept;

  /// Part of the full way, in the device frame (x right, y up, z to the user), each within +-1.
  [[nodiscard]] const glm::dvec3& deflection() const noexcept { return deflection_; }
  [[nodiscard]] unsigned buttons() const noexcept { return buttons_; }
  void release() noexcept { deflection_ = glm::dvec3(0.0); }

 private:
  glm::dvec3 deflection_{0.0};
  unsigned buttons_ = 0;
};

struct SpaceMouseSettings {
  double speed_mm_s = 80.0;           ///< at full deflection, 1 to 500
  double dead_zone = 0.05;            ///< part of the full way that does nothing, 0 to 0.5
  double half_workspace_mm = 100;     ///< where the position stops, 10 to 1000
  std::int64_t silence_us = 100'000;  ///< a cap not heard of for longer is let go; 20 ms to 1 s
};

/// Refuses settings out of their ranges.
[[nodiscard]] DeviceResult<void> check(const SpaceMouseSettings& settings);

/// Adds speeds up. Within the dead zone it stands still; beyond, speed grows with the square of the
/// way, so that small corrections are easy.
class RateControl {
 public:
  explicit RateControl(const SpaceMouseSettings& settings) noexcept : settings_(settings) {}

  /// Moves on to `now_us`, at most by 50 ms of motion: after a pause the position does not leap.
  void advance(const glm::dvec3& deflection, std::int64_t now_us) noexcept;

  [[nodiscard]] const glm::dvec3& position_mm() const noexcept { return position_mm_; }

 private:
  SpaceMouseSettings settings_;
  glm::dvec3 position_mm_{0.0};
  std::int64_t last_us_ = 0;
};

// ---- usb devices ---------------------------------------------------------------------
// Devices that are plugged in: claystack::falcon_usb, with libftdi1, libusb and hidapi.

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

}  // namespace clay::falcon::inline device
