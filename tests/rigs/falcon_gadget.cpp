#include "tests/rigs/falcon_gadget.hpp"

#include <algorithm>

namespace clay::rig {
namespace {

constexpr double kFrameS = 1e-3;
// The two FTDI bytes at the start of each packet: modem status (1 in the low nibble), line status.
constexpr std::uint8_t kModemStatus = 0x01, kLineStatus = 0x60;
constexpr std::size_t kPacket = 64, kStatusBytes = 2;

enum Request : std::uint8_t {
  kReset = 0,
  kModemControl = 1,
  kFlowControl = 2,
  kBaud = 3,
  kData = 4,
  kEventCharacter = 6,
  kLatency = 9,
};

/// The three speeds of the Falcon's start; 0 for any other.
int baud_of(std::uint16_t divisor) {
  switch (divisor) {
    case 0x4138:
      return 9'600;
    case 0x0015:
      return 142'857;
    case 0x0002:
      return 1'500'000;
    default:
      return 0;
  }
}

}  // namespace

HandledModel::HandledModel(const falcon::FalconModelSettings& settings, Trajectory hand)
    : model(settings, [this, hand = std::move(hand)](const glm::dvec3& force_n, double) {
        const glm::dvec3 position = hand(log.size());
        log.push_back({position, force_n, model.motors()});
        return position;
      }) {}

FalconGadget::FalconGadget(const falcon::FalconModelSettings& settings, Trajectory hand)
    : device(settings, std::move(hand)) {
  identity_.vendor = 0x0403;
  identity_.product = 0xcb48;
  identity_.name = "FALCON HAPTIC";
}

std::optional<Bytes> FalconGadget::control(const Setup& setup, std::span<const std::uint8_t>) {
  if (setup.request_type != 0x40) return std::nullopt;
  switch (setup.request) {
    case kReset:
      fifo_.clear();
      break;
    case kModemControl:
      if ((setup.value & 0x0100) != 0) device.model.set_dtr((setup.value & 1) != 0);
      break;
    case kBaud:
      bauds.push_back(baud_of(setup.value));
      device.model.set_baud(bauds.back());
      break;
    case kLatency:
      latency_ms = setup.value;
      break;
    case kFlowControl:
    case kData:
    case kEventCharacter:
      break;
    default:
      ++control_errors;
      return std::nullopt;
  }
  return Bytes{};
}

void FalconGadget::out(std::span<const std::uint8_t> bytes) {
  const falcon::Answer answer = device.model.receive(bytes, kFrameS);
  const auto sent = answer.span();
  fifo_.insert(fifo_.end(), sent.begin(), sent.end());
}

std::optional<Bytes> FalconGadget::in(std::size_t room, std::chrono::microseconds waited) {
  if (fifo_.empty() && waited < std::chrono::milliseconds(latency_ms)) return std::nullopt;
  Bytes packet = {kModemStatus, kLineStatus};
  const std::size_t taken = std::min(fifo_.size(), std::min(room, kPacket) - kStatusBytes);
  const auto end = fifo_.begin() + static_cast<long>(taken);
  packet.insert(packet.end(), fifo_.begin(), end);
  fifo_.erase(fifo_.begin(), end);
  return packet;
}

}  // namespace clay::rig
