#pragma once
// The Falcon's run-time frame, 16 bytes out and 16 back:
//
//   0    1..4   5..8   9..12   13      14      15
//   '<'  top    right  left    status  unused  '>'
//
// Every payload byte is its value + 'A'. A leg's number is an int16, one nibble per byte, least
// significant first: -1447 = 0xFA59 is "JFKP".

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace clay::falcon::inline device {

inline constexpr std::size_t kFrameBytes = 16;
inline constexpr std::int16_t kMotorLimit = 4095;  ///< saturation limit of the vendor's driver

/// One number for each leg: top, right, left, as the user sees them.
using LegCounts = std::array<std::int16_t, 3>;

/// Frame from the host.
struct MotorFrame {
  LegCounts motors{};   ///< limited to +-kMotorLimit
  bool homing = false;  ///< set in every frame until all legs are homed
  bool green = false;
  bool red = false;
};

using FrameBytes = std::array<std::uint8_t, kFrameBytes>;

[[nodiscard]] FrameBytes encode(const MotorFrame& frame) noexcept;

/// Frame from the device.
struct StateFrame {
  LegCounts encoders{};         ///< relative until homed: the origin jumps at homing
  std::uint8_t buttons = 0;     ///< bits of Button
  std::array<bool, 3> homed{};  ///< each leg has passed its index

  [[nodiscard]] bool all_homed() const noexcept { return homed[0] && homed[1] && homed[2]; }
  friend bool operator==(const StateFrame&, const StateFrame&) = default;
};

/// Finds the frames in a byte stream that may lose, repeat or damage bytes (FTDI status bytes
/// already removed). '<' and '>' never occur inside a frame, so each '<' starts a new one: a fault
/// costs only the frames it touches. The format has no checksum: a letter changed to another, or
/// two halves joined by the loss of a multiple of 16 bytes, cannot be detected.
class FrameReader {
 public:
  /// The next whole frame in `bytes`; advances `bytes` past it. Empty when all bytes are consumed.
  /// A frame may begin in one call and end in another.
  [[nodiscard]] std::optional<StateFrame> next(std::span<const std::uint8_t>& bytes) noexcept;

  /// Number of bytes so far that belonged to no whole frame.
  [[nodiscard]] std::uint64_t discarded() const noexcept { return discarded_; }

 private:
  void take(std::uint8_t byte) noexcept;

  FrameBytes frame_{};
  std::size_t size_ = 0;
  std::uint64_t discarded_ = 0;
};

}  // namespace clay::falcon::inline device
