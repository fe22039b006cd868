#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace clay::falcon::inline device {

// ---- device error --------------------------------------------------------------------
// What a device can refuse, told so that a person can act on it.

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

// ---- out of range --------------------------------------------------------------------

/// A setting out of its range, by the name it has in its struct.
struct OutOfRange {
  const char* setting;
  double low, high, found;
};

// ---- transport -----------------------------------------------------------------------
// A stream of bytes to and from the Falcon's processor, whatever carries it.

/// How the line must be set for each step of the Falcon's start (docs/devices.md).
enum class LineMode {
  greeting,  ///< 9600 baud, latency 16 ms, DTR low then high: the processor restarts
  loading,   ///< 142857 baud, DTR low: its boot loader listens
  running,   ///< 1.5 Mbaud, latency 1 ms: frames
};

enum class WireStatus : std::uint8_t {
  ok,
  busy,  ///< nothing taken: what was written before has not left yet
  unplugged,
  failed,
};

struct Received {
  std::size_t size = 0;      ///< bytes; 0 when none came in time
  std::int64_t time_us = 0;  ///< CLOCK_MONOTONIC when the last of them arrived
  WireStatus status = WireStatus::ok;
};

class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  virtual ~Transport() = default;

  /// The place of DeviceInfo.
  [[nodiscard]] virtual std::string describe() const = 0;

  /// Whether this side loads the firmware; a bridge does so itself.
  [[nodiscard]] virtual bool loads_firmware() const noexcept = 0;

  virtual DeviceResult<void> open() = 0;
  virtual void close() noexcept = 0;

  /// Sets the line and forgets what was on it.
  virtual DeviceResult<void> set_mode(LineMode mode) = 0;

  /// At most 62 bytes, all of them or none.
  virtual WireStatus write(std::span<const std::uint8_t> bytes) noexcept = 0;

  /// What has come, or comes within `wait_us`.
  virtual Received read(std::span<std::uint8_t> bytes, std::int64_t wait_us) noexcept = 0;

  /// At most 62 bytes, from any thread or signal handler, after all that was written.
  virtual void write_last(std::span<const std::uint8_t> bytes) noexcept = 0;

  /// The clock of `Received`. CLOCK_MONOTONIC, but for models that run in a time of their own.
  [[nodiscard]] virtual std::int64_t now_us() const noexcept;
};

/// Most bytes of a write: what an FTDI packet or a report of the bridge holds.
inline constexpr std::size_t kMostWritten = 62;

/// CLOCK_MONOTONIC [us].
[[nodiscard]] std::int64_t monotonic_us() noexcept;

// ---- device --------------------------------------------------------------------------
// One door for everything a hand can hold: a Falcon, one behind a bridge, a 3Dconnexion controller,
// an arm that is simulated.
//
// Device frame: x to the right, y up, z towards the user; the origin is the middle of the
// workspace. Positions in mm, forces in N, times in us of CLOCK_MONOTONIC.

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

}  // namespace clay::falcon::inline device
