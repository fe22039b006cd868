#pragma once
// A stream of bytes to and from the Falcon's processor, whatever carries it.

#include "claystack/falcon/device_error.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace clay::falcon {

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

}  // namespace clay::falcon
