#pragma once
// For a thread of its own, since a servo that hangs can't watch itself. Pure: both times are told.

#include <cstdint>

namespace clay::falcon {

/// The servo leaves the time of each tick where the watchdog finds it (an atomic); the watchdog
/// sleeps until next_look_us and closes the gate (force_gate.hpp) for a while when it must.
class Watchdog {
 public:
  static constexpr std::int64_t kPatienceUs = 10'000;

  /// Is the last heartbeat 10 ms old, or so far ahead that one of the clocks is wrong? A
  /// heartbeat a little ahead is one that came after `now_us` was read.
  [[nodiscard]] static constexpr bool must_zero(std::int64_t heartbeat_us,
                                                std::int64_t now_us) noexcept {
    const auto apart =
        heartbeat_us < now_us ? distance(heartbeat_us, now_us) : distance(now_us, heartbeat_us);
    return apart >= static_cast<std::uint64_t>(kPatienceUs);
  }

  /// When this heartbeat will have been the last for too long.
  [[nodiscard]] static constexpr std::int64_t next_look_us(std::int64_t heartbeat_us) noexcept {
    constexpr std::int64_t kLast = INT64_MAX - kPatienceUs;
    return heartbeat_us > kLast ? INT64_MAX : heartbeat_us + kPatienceUs;
  }

 private:
  /// Of two signed numbers, which may not fit one.
  static constexpr std::uint64_t distance(std::int64_t low, std::int64_t high) noexcept {
    return static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
  }
};

}  // namespace clay::falcon
