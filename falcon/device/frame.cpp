#include "falcon/device/frame.hpp"

#include <algorithm>

namespace clay::falcon::inline device {
namespace {

constexpr std::uint8_t kBegin = '<';
constexpr std::uint8_t kEnd = '>';
constexpr std::uint8_t kZero = 'A';
constexpr unsigned kNibble = 0xF;
constexpr std::size_t kNibblesPerLeg = 4;
constexpr std::size_t kStatus = 13;
constexpr std::size_t kUnused = 14;
constexpr std::size_t kLast = kFrameBytes - 1;

constexpr unsigned kHoming = 0x01, kGreen = 0x02,
                   kRed = 0x08;       // 0x04 is blue, which no state shows
constexpr unsigned kTopHomed = 0x10;  // the bits of right and left follow
constexpr unsigned kStateBits = 0x7F;

constexpr std::size_t byte_of(std::size_t leg, std::size_t nibble) {
  return 1 + leg * kNibblesPerLeg + nibble;
}

constexpr std::uint8_t letter(unsigned value) { return static_cast<std::uint8_t>(kZero + value); }

constexpr bool is_value(std::uint8_t byte, unsigned most) {
  return byte >= kZero && byte - kZero <= static_cast<int>(most);
}

/// Whether `byte` is valid at `position`. No source documents the unused byte; it is only checked
/// not to be a frame mark.
constexpr bool fits(std::size_t position, std::uint8_t byte) {
  switch (position) {
    case 0:
      return byte == kBegin;
    case kStatus:
      return is_value(byte, kStateBits);
    case kUnused:
      return byte != kBegin && byte != kEnd;
    case kLast:
      return byte == kEnd;
    default:
      return is_value(byte, kNibble);
  }
}

StateFrame decode(const FrameBytes& bytes) noexcept {
  const auto value = [&bytes](std::size_t at) { return static_cast<unsigned>(bytes[at] - kZero); };
  StateFrame frame;
  for (std::size_t leg = 0; leg < frame.encoders.size(); ++leg) {
    unsigned word = 0;
    for (std::size_t n = 0; n < kNibblesPerLeg; ++n) word |= value(byte_of(leg, n)) << (4 * n);
    frame.encoders[leg] = static_cast<std::int16_t>(word);
    frame.homed[leg] = (value(kStatus) & (kTopHomed << leg)) != 0;
  }
  frame.buttons = static_cast<std::uint8_t>(value(kStatus) & kNibble);
  return frame;
}

}  // namespace

FrameBytes encode(const MotorFrame& frame) noexcept {
  FrameBytes bytes;
  bytes.fill(kZero);
  bytes[0] = kBegin;
  bytes[kLast] = kEnd;
  for (std::size_t leg = 0; leg < frame.motors.size(); ++leg) {
    const int motor = std::clamp<int>(frame.motors[leg], -kMotorLimit, kMotorLimit);
    for (std::size_t n = 0; n < kNibblesPerLeg; ++n)
      bytes[byte_of(leg, n)] = letter((static_cast<unsigned>(motor) >> (4 * n)) & kNibble);
  }
  bytes[kStatus] =
      letter((frame.homing ? kHoming : 0u) | (frame.green ? kGreen : 0u) | (frame.red ? kRed : 0u));
  return bytes;
}

void FrameReader::take(std::uint8_t byte) noexcept {
  if (!fits(size_, byte)) {
    discarded_ += size_;
    size_ = 0;
  }
  if (fits(size_, byte))
    frame_[size_++] = byte;
  else
    ++discarded_;
}

std::optional<StateFrame> FrameReader::next(std::span<const std::uint8_t>& bytes) noexcept {
  while (!bytes.empty()) {
    take(bytes.front());
    bytes = bytes.subspan(1);
    if (size_ == kFrameBytes) {
      size_ = 0;
      return decode(frame_);
    }
  }
  return std::nullopt;
}

}  // namespace clay::falcon::inline device
