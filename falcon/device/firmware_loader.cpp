#include "falcon/device/firmware.hpp"

#include <algorithm>
#include <array>
#include <functional>

namespace clay::falcon::inline device {
namespace {

constexpr std::array<std::uint8_t, 3> kGreeting = {0x0A, 0x43, 0x0D};
constexpr std::array<std::uint8_t, 4> kGreetingAnswer = {0x0A, 0x44, 0x2C, 0x0D};
constexpr std::array<std::uint8_t, 1> kAutobaud = {0x41};
// The latency timer is 16 ms; 62 bytes take 4 ms at 142857 baud, and so does the greeting at 9600.
// The greeting limit is also the waiting time without a power supply.
constexpr std::int64_t kGreetingUs = 200'000, kEchoUs = 500'000;

DeviceError lost(const Transport& line, WireStatus status) {
  if (status == WireStatus::unplugged)
    return {DeviceFault::unplugged, line.describe() + ": unplugged while its firmware was loaded",
            "plug it in again"};
  return {DeviceFault::transfer_failed,
          line.describe() + ": a transfer failed while the firmware was loaded",
          {}};
}

/// Fills `bytes`, or the part of it that arrives in time.
DeviceResult<std::size_t> read_fully(Transport& line, std::span<std::uint8_t> bytes,
                                     std::int64_t wait_us) {
  const std::int64_t end_us = line.now_us() + wait_us;
  std::size_t got = 0;
  while (got < bytes.size()) {
    const std::int64_t left_us = end_us - line.now_us();
    if (left_us <= 0) break;
    const Received received = line.read(bytes.subspan(got), left_us);
    if (received.status != WireStatus::ok) return tl::make_unexpected(lost(line, received.status));
    got += received.size;
  }
  return got;
}

DeviceResult<void> send(Transport& line, std::span<const std::uint8_t> bytes) {
  const WireStatus status = line.write(bytes);
  if (status != WireStatus::ok) return tl::make_unexpected(lost(line, status));
  return {};
}

DeviceResult<void> greet(Transport& line) {
  if (auto set = line.set_mode(LineMode::greeting); !set) return set;
  if (auto sent = send(line, kGreeting); !sent) return sent;
  // A byte 0 may precede the answer, from the restart of the processor.
  std::array<std::uint8_t, kGreetingAnswer.size() + 1> answer{};
  const auto first = read_fully(line, std::span(answer).first(kGreetingAnswer.size()), kGreetingUs);
  if (!first) return tl::make_unexpected(first.error());
  std::span<const std::uint8_t> said(answer.data(), *first);
  if (*first == kGreetingAnswer.size() && answer[0] == 0) {
    const auto rest = read_fully(line, std::span(answer).last(1), kGreetingUs);
    if (!rest) return tl::make_unexpected(rest.error());
    said = std::span<const std::uint8_t>(answer).subspan(1, kGreetingAnswer.size() - 1 + *rest);
  }
  if (std::equal(said.begin(), said.end(), kGreetingAnswer.begin(), kGreetingAnswer.end()))
    return {};
  return device_failure(DeviceFault::no_answer,
                        line.describe() +
                            ": expected the greeting of the Falcon's processor, found " +
                            (said.empty() ? std::string("nothing")
                                          : std::to_string(said.size()).append(" other bytes")),
                        "plug in the Falcon's own power supply and switch it on");
}

/// Sends a piece and compares its echo byte by byte; `at` is the offset of the piece.
DeviceResult<void> send_echoed(Transport& line, std::span<const std::uint8_t> piece,
                               const std::string& at) {
  if (auto sent = send(line, piece); !sent) return sent;
  std::array<std::uint8_t, kMostWritten> echo{};
  const auto got = read_fully(line, std::span(echo).first(piece.size()), kEchoUs);
  if (!got) return tl::make_unexpected(got.error());
  const auto differs =
      std::mismatch(piece.begin(), piece.begin() + static_cast<long>(*got), echo.begin()).first;
  if (differs == piece.end()) return {};
  const std::string found =
      differs == piece.begin() + static_cast<long>(*got) ? "nothing more" : "another byte";
  return device_failure(DeviceFault::echo_error,
                        line.describe() + ": expected the echo of " + at + ", byte " +
                            std::to_string(differs - piece.begin()) + ", found " + found,
                        "plug the Falcon straight into the computer, without a hub, and try again");
}

DeviceResult<void> load_once(Transport& line, const Firmware& firmware) {
  if (auto greeted = greet(line); !greeted) return greeted;
  if (auto set = line.set_mode(LineMode::loading); !set) return set;
  if (auto sent = send_echoed(line, kAutobaud, "the letter that sets its speed"); !sent)
    return sent;
  const std::span<const std::uint8_t> bytes(firmware.bytes);
  for (std::size_t at = 0; at < bytes.size(); at += kMostWritten) {
    const auto piece = bytes.subspan(at, std::min(kMostWritten, bytes.size() - at));
    auto sent = send_echoed(line, piece, "the firmware from byte " + std::to_string(at));
    if (!sent) return sent;
  }
  return line.set_mode(LineMode::running);
}

DeviceResult<void> tried(int attempts, const std::function<DeviceResult<void>()>& action) {
  DeviceResult<void> done;
  for (int i = 0; i < attempts; ++i) {
    done = action();
    if (done || done.error().fault == DeviceFault::unplugged) return done;
  }
  if (done || attempts <= 1) return done;
  const DeviceError& error = done.error();
  return device_failure(error.fault, error.what + " (tried " + std::to_string(attempts) + " times)",
                        error.remedy);
}

}  // namespace

DeviceResult<void> greet_loader(Transport& line, int attempts) {
  return tried(attempts, [&] { return greet(line); });
}

DeviceResult<void> load_firmware(Transport& line, const Firmware& firmware, int attempts) {
  return tried(attempts, [&] { return load_once(line, firmware); });
}

}  // namespace clay::falcon::inline device
