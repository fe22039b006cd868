#pragma once
// The clock of the machine, and the times of the servo's ticks on any clock.

#include "claystack/servo/servo.hpp"

#include <algorithm>
#include <cstdint>

namespace clay::servo {

/// CLOCK_MONOTONIC with absolute deadlines, so that delays of sleeps do not accumulate.
class MonotonicClock final : public Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() noexcept override;
  void sleep_until_ns(std::int64_t time_ns) noexcept override;
  /// Sleeps until shortly before `time_ns`, with a margin that follows the recent delays of sleeps,
  /// then polls the clock, for kLongestLookNs at most.
  std::int64_t wake_at_ns(std::int64_t time_ns) noexcept override;

  static constexpr std::int64_t kLongestLookNs = 100'000;

 private:
  std::int64_t lead_ns_ = kLongestLookNs;
};

/// Schedules the ticks: absolute deadlines, one period apart, so that delays do not accumulate;
/// missed ticks are not repeated. A device that answers requests sets the pace itself: the servo
/// wakes half a period before the answer is due and waits for it.
class Pacer {
 public:
  explicit Pacer(std::int64_t period_ns) noexcept : period_ns_(period_ns) {}

  /// Call when the device is opened; a request may have been sent to it just now.
  void start(std::int64_t now_ns) noexcept { deadline_ns_ = now_ns + period_ns_ / 2; }

  /// Sleeps until the deadline. Returns the delay of the wake-up [ns].
  [[nodiscard]] std::int64_t wait(Clock& clock) noexcept {
    overslept_ns_ = clock.wake_at_ns(deadline_ns_);
    return std::max<std::int64_t>(0, clock.now_ns() - deadline_ns_);
  }

  /// Maximum time to wait for the device after the wake-up [us].
  [[nodiscard]] std::int64_t patience_us(std::int64_t now_ns) const noexcept {
    return std::max<std::int64_t>(0, deadline_ns_ + period_ns_ - now_ns) / 1000;
  }

  /// Call when the sample has arrived or has been given up.
  void sampled(std::int64_t now_ns) noexcept {
    deadline_ns_ = std::max(deadline_ns_ + period_ns_, now_ns + period_ns_ / 2);
  }

  /// Delay that wait() would have had without polling the clock.
  [[nodiscard]] std::int64_t overslept_ns() const noexcept { return overslept_ns_; }
  [[nodiscard]] std::int64_t period_ns() const noexcept { return period_ns_; }

 private:
  std::int64_t period_ns_, deadline_ns_ = 0, overslept_ns_ = 0;
};

}  // namespace clay::servo
