#pragma once
// One door for everything a hand can hold: a Falcon, one behind a bridge, a 3Dconnexion controller,
// an arm that is simulated.
//
// Device frame: x to the right, y up, z towards the user; the origin is the middle of the
// workspace. Positions in mm, forces in N, times in us of CLOCK_MONOTONIC.

#include "claystack/falcon/device_error.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace clay::falcon {

enum class DeviceState : std::uint8_t {
  closed,
  needs_firmware,  ///< open, and does not answer: its processor has no program yet
  needs_homing,    ///< answers, but positions are relative until the user moves it through
  ready,
  fault,  ///< `HapticDevice::problem` tells; `open` tries again
};

/// For scripts: "needs_homing".
[[nodiscard]] std::string_view name_of(DeviceState state) noexcept;

struct DeviceSample {
  std::int64_t time_us = 0;     ///< when its frame arrived
  glm::dvec3 position_mm{0.0};  ///< of the grip, or the handle
  unsigned buttons = 0;         ///< a bit for each that is down
  DeviceState state = DeviceState::closed;
  bool fresh = false;  ///< arrived since the last read; otherwise the last one again
  std::optional<double> grip_mm =
      std::nullopt;  ///< how far fingers are apart, of a device that measures it
};

struct DeviceInfo {
  std::string name;                   ///< "Novint Falcon"
  std::string place;                  ///< where it is plugged in: "usb:001:004", "/dev/hidraw0"
  bool can_push = false;              ///< has motors
  double force_limit_n = 0.0;         ///< `write` cuts forces to this length; 0 without motors
  glm::dvec3 half_workspace_mm{0.0};  ///< reach from the origin along each axis
  double rate_hz = 0.0;               ///< of samples, nominally
};

/// Since `open`.
struct DeviceCounters {
  std::uint64_t frames = 0;           ///< whole frames taken
  std::uint64_t bytes_discarded = 0;  ///< of no whole frame
  std::uint64_t without_pose = 0;     ///< frames whose angles no pose has: not believed
  std::uint64_t writes_dropped = 0;   ///< forces not sent, since the device took none
};

/// `read`, `write`, `zero` and `stop` allocate and throw nothing. `read` and `write` belong to one
/// thread; `zero` and `stop` may be called from any, and from a signal handler. The rest is for
/// set-up.
class HapticDevice {
 public:
  HapticDevice() = default;
  HapticDevice(const HapticDevice&) = delete;
  HapticDevice& operator=(const HapticDevice&) = delete;
  virtual ~HapticDevice() = default;

  [[nodiscard]] virtual const DeviceInfo& info() const noexcept = 0;

  /// From closed or fault to needs_homing or ready. May take seconds (firmware).
  virtual DeviceResult<void> open() = 0;

  /// The newest sample; waits for one at most `wait_us`. Never fails: the state tells.
  virtual DeviceSample read(std::int64_t wait_us) noexcept = 0;

  /// Sends a force. One that is not finite is sent as zero, and until `ready` all are.
  virtual void write(const glm::dvec3& force_n) noexcept = 0;

  /// A packet of zero force after all that was written, for a watchdog: what is written next counts
  /// again.
  virtual void zero() noexcept = 0;

  /// The last packet is zero force: nothing that `write` sends comes after it, until `open`.
  virtual void stop() noexcept = 0;

  /// What made the state `fault`, or keeps it at `needs_firmware`.
  [[nodiscard]] virtual DeviceError problem() const = 0;

  [[nodiscard]] virtual DeviceCounters counters() const noexcept = 0;
};

}  // namespace clay::falcon
