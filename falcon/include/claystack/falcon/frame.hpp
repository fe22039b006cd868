#pragma once
// The Falcon's run-time frame, 16 bytes out and 16 back:
//
//   0    1..4   5..8   9..12   13      14      15
//   '<'  top    right  left    status  unused  '>'
//
// Every payload byte is its value + 'A'. A leg's number is an int16, a nibble to the byte, the
// least significant first: -1447 = 0xFA59 is "JFKP".

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace clay::falcon {

inline constexpr std::size_t kFrameBytes = 16;
inline constexpr std::int16_t kMotorLimit = 4095;  ///< where the vendor's own driver saturates

/// One number for each leg: top, right, left, as the user sees them.
using LegCounts = std::array<std::int16_t, 3>;

/// What the host sends.
struct MotorFrame {
  LegCounts motors{};   ///< within +-kMotorLimit
  bool homing = false;  ///< on in every frame until all legs are homed
  bool green = false;
  bool blue = false;
  bool red = false;
};

struct EncodedFrame {
  std::array<std::uint8_t, kFrameBytes> bytes{};
  bool saturated = false;  ///< a motor was beyond the limit: the force sent is not the one asked
};

[[nodiscard]] EncodedFrame encode(const MotorFrame& frame) noexcept;

/// Bits of StateFrame::buttons, from far right to far left as the user sees them.
enum Button : std::uint8_t {
  kButtonPlus = 1,
  kButtonForward = 2,
  kButtonCentre = 4,
  kButtonMinus = 8,
};

/// What the device answers.
struct StateFrame {
  LegCounts encoders{};         ///< relative until homed: the origin jumps at homing
  std::uint8_t buttons = 0;     ///< of Button
  std::array<bool, 3> homed{};  ///< each leg has passed its index

  [[nodiscard]] bool all_homed() const noexcept { return homed[0] && homed[1] && homed[2]; }
  friend bool operator==(const StateFrame&, const StateFrame&) = default;
};

/// Finds the frames in a stream of bytes that may lose, repeat or spoil some (FTDI's own status
/// bytes already taken out). '<' and '>' never stand inside a frame, so each '<' begins one
/// anew: a fault costs the frames it touches and no other. The format has no checksum: a letter
/// turned into another, or two halves joined by the loss of 16 bytes or a multiple, can't be seen.
class FrameReader {
 public:
  /// The next whole frame in `bytes`, and leaves there what follows it; nothing when all bytes
  /// are used up. A frame may begin in one call and end in another.
  [[nodiscard]] std::optional<StateFrame> next(std::span<const std::uint8_t>& bytes) noexcept;

  /// Bytes so far that belonged to no whole frame.
  [[nodiscard]] std::uint64_t discarded() const noexcept { return discarded_; }
  /// Bytes of a frame that is not whole yet, below kFrameBytes.
  [[nodiscard]] std::size_t pending() const noexcept { return size_; }

 private:
  void take(std::uint8_t byte) noexcept;

  std::array<std::uint8_t, kFrameBytes> frame_{};
  std::size_t size_ = 0;
  std::uint64_t discarded_ = 0;
};

}  // namespace clay::falcon
