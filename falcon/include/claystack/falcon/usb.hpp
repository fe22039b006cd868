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
// 3Dconnexion controllers: a cap that deflects a little and has no motors. Its deflection sets a
// speed, which is integrated to a position.

struct SpaceMouseModel {
  std::uint16_t vendor = 0, product = 0;
  std::string_view name;
};

/// The six-axis controllers. Other 3Dconnexion devices (keypads, two-axis mice) are excluded.
[[nodiscard]] std::span<const SpaceMouseModel> space_mouse_models() noexcept;

/// Decodes reports: 1 is translation, followed by rotation in the longer form of the wireless
/// models; 2 is rotation, which is ignored; 3 is buttons. Numbers are int16, low byte first.
class SpaceMouseReports {
 public:
  /// `report` begins with its number. Returns false, without a change, for unknown or short
  /// reports.
  bool take(std::span<const std::uint8_t> report) noexcept;

  /// Fraction of the full deflection, in the device frame (x right, y up, z to the user), within
  /// +-1.
  [[nodiscard]] const glm::dvec3& deflection() const noexcept { return deflection_; }
  [[nodiscard]] unsigned buttons() const noexcept { return buttons_; }
  void release() noexcept { deflection_ = glm::dvec3(0.0); }

 private:
  glm::dvec3 deflection_{0.0};
  unsigned buttons_ = 0;
};

struct SpaceMouseSettings {
  double speed_mm_s = 80.0;        ///< at full deflection, 1 to 500
  double dead_zone = 0.05;         ///< fraction of the deflection that is ignored, 0 to 0.5
  double half_workspace_mm = 100;  ///< limit of the position, 10 to 1000
  std::int64_t silence_us =
      100'000;  ///< after this time without a report the cap counts as released; 20 ms to 1 s
};

/// Refuses settings out of their ranges.
[[nodiscard]] DeviceResult<void> check(const SpaceMouseSettings& settings);

/// Part of the full speed, with the direction of the deflection: zero within the dead zone; beyond,
/// it grows with the square of the deflection, for fine control.
[[nodiscard]] glm::dvec3 rate_of(const glm::dvec3& deflection, double dead_zone) noexcept;

/// Integrates the speed.
class RateControl {
 public:
  explicit RateControl(const SpaceMouseSettings& settings) noexcept : settings_(settings) {}

  /// Advances to `now_us`, by at most 50 ms of motion: no jump after a pause.
  void advance(const glm::dvec3& deflection, std::int64_t now_us) noexcept;

  [[nodiscard]] const glm::dvec3& position_mm() const noexcept { return position_mm_; }

 private:
  SpaceMouseSettings settings_;
  glm::dvec3 position_mm_{0.0};
  std::int64_t last_us_ = 0;
};

/// Reports of a HID device that one reading takes at most, as many as the kernel keeps: a device
/// that floods the line must not block the servo.
inline constexpr int kMostReportsPerRead = 64;

/// The reports of an open HID device, by any medium.
class ReportPort {
 public:
  ReportPort() = default;
  ReportPort(const ReportPort&) = delete;
  ReportPort& operator=(const ReportPort&) = delete;
  virtual ~ReportPort() = default;

  virtual DeviceResult<void> open(const std::string& place) = 0;
  /// Reads a report that has arrived; it begins with its number. Returns its size, 0 if there is
  /// none, negative if the device was disconnected.
  virtual int read(std::span<std::uint8_t> report) noexcept = 0;
  /// Does nothing without an open device.
  virtual void write(std::span<const std::uint8_t> report) noexcept = 0;
  /// The clock of the samples [us].
  [[nodiscard]] virtual std::int64_t now_us() const noexcept { return monotonic_us(); }
};

/// A 3Dconnexion controller without motors. `place`: for its port.
[[nodiscard]] std::unique_ptr<HapticDevice> make_space_mouse(std::string name, std::string place,
                                                             const SpaceMouseSettings& settings,
                                                             std::unique_ptr<ReportPort> port);

// ---- usb devices ---------------------------------------------------------------------
// Connected devices: claystack::falcon_usb, with libftdi1, libusb and hidapi.

inline constexpr std::uint16_t kFalconVendor = 0x0403, kFalconProduct = 0xcb48;
/// Identifies a bridge: its USB product string begins with this.
inline constexpr std::string_view kBridgeProduct = "Falcon HID bridge";

enum class DeviceKind { falcon, bridge, space_mouse };

/// As on the command line: "falcon", "bridge", "spacemouse".
[[nodiscard]] std::string_view name_of(DeviceKind kind) noexcept;

struct ListedDevice {
  DeviceKind kind = DeviceKind::falcon;
  std::string name;                    ///< "SpaceNavigator"
  std::string place;                   ///< "usb:1-2.1" (bus and ports), "/dev/hidraw3"
  bool usable = true;                  ///< whether it can be opened now
  std::optional<DeviceError> problem;  ///< the reason if not usable; otherwise a note
};

/// Lists the connected devices, and whether the system permits opening them. Sends no byte to any
/// device, so it cannot report whether a Falcon has power or firmware; opening does. Fails only if
/// the system cannot list devices at all.
[[nodiscard]] DeviceResult<std::vector<ListedDevice>> list_devices();

struct DeviceSettings {
  FalconSettings falcon;
  SpaceMouseSettings space_mouse;
};

/// Opens a device by kind ("falcon", "bridge", "spacemouse"), by place, or "auto": the first usable
/// one in that order.
[[nodiscard]] DeviceResult<std::unique_ptr<HapticDevice>> open_device(
    std::string_view which, const DeviceSettings& settings = {});

/// The parts of `open_device`. None touches the device before `open`. After unplugging, `open`
/// finds a Falcon again at the same port.
[[nodiscard]] std::unique_ptr<Transport> make_ftdi_transport(std::string place);
[[nodiscard]] std::unique_ptr<Transport> make_bridge_transport(std::string place);
[[nodiscard]] std::unique_ptr<HapticDevice> make_space_mouse(std::string name, std::string place,
                                                             const SpaceMouseSettings& settings);

}  // namespace clay::falcon::inline device
