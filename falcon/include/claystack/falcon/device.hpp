#pragma once
#include "claystack/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <type_traits>
#include <utility>

namespace clay::falcon::inline device {

// ---- device error --------------------------------------------------------------------
// Errors of a device, worded so that a person can act on them.

enum class DeviceFault {
  not_found,            ///< no such device is connected
  no_permission,        ///< the system denies this user access
  driver_bound,         ///< a kernel driver holds it
  busy,                 ///< another program holds it
  no_firmware,          ///< a Falcon after power-up, and no firmware file to load
  bad_firmware,         ///< the file is not a boot stream
  unreadable_firmware,  ///< the file could not be read
  echo_error,           ///< the firmware echo differs from the bytes sent
  no_answer,            ///< open, but silent: usually the power supply is off
  unplugged,
  transfer_failed,  ///< any other error reported by the system
  bad_setting,
};

/// An Error of core with its fault. A fault of the user's files or settings is bad input, a file
/// that cannot be read is io, and any other is the device's. The message has the fault and its
/// remedy.
struct DeviceError : Error {
  DeviceError() : DeviceError(DeviceFault::transfer_failed, {}) {}
  DeviceError(DeviceFault device_fault, std::string found, std::string help = {});

  DeviceFault fault;
  std::string what;    ///< device, what was expected, what was found
  std::string remedy;  ///< the action that may help; empty if none is known
};

/// The Result of core, which it converts to, with the fault kept: a program reacts to it, for
/// example to no_firmware by loading it. Result itself cannot carry it, because core has no
/// devices. Everything in falcon that a user can cause returns one of the two; only checks of
/// settings, which do not allocate, return OutOfRange instead.
template <class T>
using DeviceResult = tl::expected<T, DeviceError>;
static_assert(std::is_convertible_v<DeviceResult<int>, Result<int>>);

[[nodiscard]] inline tl::unexpected<DeviceError> device_failure(DeviceFault fault, std::string what,
                                                                std::string remedy = {}) {
  return tl::make_unexpected(DeviceError{fault, std::move(what), std::move(remedy)});
}

/// For scripts, for example "no_permission".
[[nodiscard]] std::string_view name_of(DeviceFault fault) noexcept;

// ---- out of range --------------------------------------------------------------------

/// A setting out of its range, by its field name.
struct OutOfRange {
  const char* setting;
  double low, high, found;
};

/// "rate_hz: expected a value from 10 to 100000, found 1"; bad input.
[[nodiscard]] Error error_of(const OutOfRange& out);

// ---- transport -----------------------------------------------------------------------
// A byte stream to and from the Falcon's processor, over any medium.

/// The line settings for each step of the Falcon's start (docs/devices.md).
enum class LineMode {
  greeting,  ///< 9600 baud, latency 16 ms, DTR low then high: the processor restarts
  loading,   ///< 142857 baud, DTR low: its boot loader listens
  running,   ///< 1.5 Mbaud, latency 1 ms: frames
};

/// Integer divisors of the 3 MHz of the Falcon's USB chip, so that every driver sets the same.
[[nodiscard]] constexpr int baud_of(LineMode mode) noexcept {
  return mode == LineMode::greeting ? 9'600 : mode == LineMode::loading ? 142'857 : 1'500'000;
}

enum class WireStatus : std::uint8_t {
  ok,
  busy,  ///< nothing accepted: earlier bytes are still being sent
  unplugged,
  failed,
};

struct Received {
  std::size_t size = 0;  ///< bytes; 0 if none came in time
  /// CLOCK_MONOTONIC when the last byte was received. Bytes that arrived before the call of `read`
  /// have the time of the call: a late servo counts their age from then on.
  std::int64_t time_us = 0;
  WireStatus status = WireStatus::ok;
};

class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  virtual ~Transport() = default;

  /// The value for DeviceInfo::place.
  [[nodiscard]] virtual std::string describe() const = 0;

  /// Whether the host loads the firmware; a bridge loads it itself.
  [[nodiscard]] virtual bool loads_firmware() const noexcept = 0;

  virtual DeviceResult<void> open() = 0;
  virtual void close() noexcept = 0;

  /// Sets the line and discards pending bytes.
  virtual DeviceResult<void> set_mode(LineMode mode) = 0;

  /// Writes at most 62 bytes, all or none.
  virtual WireStatus write(std::span<const std::uint8_t> bytes) noexcept = 0;

  /// Reads bytes that have arrived or arrive within `wait_us`.
  virtual Received read(std::span<std::uint8_t> bytes, std::int64_t wait_us) noexcept = 0;

  /// Writes at most 62 bytes after all earlier ones, from any thread or signal handler.
  virtual void write_last(std::span<const std::uint8_t> bytes) noexcept = 0;

  /// The clock of `Received`: CLOCK_MONOTONIC, except for models with a simulated clock.
  [[nodiscard]] virtual std::int64_t now_us() const noexcept;
};

/// The most bytes per write: the payload of an FTDI packet or a bridge report.
inline constexpr std::size_t kMostWritten = 62;

/// CLOCK_MONOTONIC [us].
[[nodiscard]] std::int64_t monotonic_us() noexcept;

// ---- device --------------------------------------------------------------------------
// One interface for every input device: a Falcon, a Falcon behind a bridge, a 3Dconnexion
// controller, a simulated arm.
//
// Device frame: x to the right, y up, z towards the user; the origin is the middle of the
// workspace. Positions in mm, forces in N, times in us of CLOCK_MONOTONIC.

enum class DeviceState : std::uint8_t {
  closed,
  needs_firmware,  ///< not open: its processor has no program yet, and `open` loads it
  needs_homing,  ///< answers, but positions are relative until the user moves the grip through its
                 ///< range
  ready,
  fault,  ///< `HapticDevice::problem` explains; `open` tries again
};

/// Whether the device answers, so that `read` may bring samples.
[[nodiscard]] constexpr bool is_open(DeviceState state) noexcept {
  return state == DeviceState::needs_homing || state == DeviceState::ready;
}

/// For scripts, for example "needs_homing".
[[nodiscard]] std::string_view name_of(DeviceState state) noexcept;

struct DeviceSample {
  std::int64_t time_us = 0;     ///< arrival of its frame
  glm::dvec3 position_mm{0.0};  ///< of the grip or the handle
  unsigned buttons = 0;         ///< one bit for each pressed button
  DeviceState state = DeviceState::closed;
  bool fresh = false;  ///< arrived since the last read; false: a repeat of the last sample
  std::optional<double> grip_mm =
      std::nullopt;  ///< distance between the fingers, if the device measures it
};

struct DeviceInfo {
  std::string name;                   ///< "Novint Falcon"
  std::string place;                  ///< its connection: "usb:001:004", "/dev/hidraw0"
  bool can_push = false;              ///< has motors
  double force_limit_n = 0.0;         ///< `write` limits forces to this length; 0 without motors
  glm::dvec3 half_workspace_mm{0.0};  ///< reach from the origin along each axis
  double rate_hz = 0.0;               ///< nominal sample rate
  /// From a force to the frame that answers it, as `open` has measured it; 0: not measured.
  std::int64_t answer_us = 0;
};

/// Counted since `open`.
struct DeviceCounters {
  std::uint64_t frames = 0;           ///< whole frames received
  std::uint64_t bytes_discarded = 0;  ///< bytes that belong to no whole frame
  std::uint64_t without_pose = 0;     ///< rejected frames: no pose has their angles
  std::uint64_t writes_dropped = 0;   ///< forces not sent because the device accepted none
};

/// `read`, `write`, `zero` and `stop` do not allocate or throw. `read` and `write` belong to one
/// thread; `zero` and `stop` may be called from any thread and from a signal handler. The other
/// functions are for setup.
class HapticDevice {
 public:
  HapticDevice() = default;
  HapticDevice(const HapticDevice&) = delete;
  HapticDevice& operator=(const HapticDevice&) = delete;
  virtual ~HapticDevice() = default;

  [[nodiscard]] virtual const DeviceInfo& info() const noexcept = 0;

  /// From closed or fault to needs_homing or ready. May take seconds (firmware).
  virtual DeviceResult<void> open() = 0;

  /// The newest sample; waits for one for at most `wait_us`. Never fails: see the state of the
  /// sample.
  virtual DeviceSample read(std::int64_t wait_us) noexcept = 0;

  /// Sends a force. An invalid force (not finite) is sent as zero, as is every force before
  /// `ready`.
  virtual void write(const glm::dvec3& force_n) noexcept = 0;

  /// Sends zero force after all earlier writes, for a watchdog; later writes take effect again.
  virtual void zero() noexcept = 0;

  /// Sends zero force as the last packet: later writes are ignored until `open`.
  virtual void stop() noexcept = 0;

  /// The reason for the state `fault` or `needs_firmware`.
  [[nodiscard]] virtual DeviceError problem() const = 0;

  [[nodiscard]] virtual DeviceCounters counters() const noexcept = 0;
};

}  // namespace clay::falcon::inline device
