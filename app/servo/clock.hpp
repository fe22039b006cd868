#pragma once
// The machine's clock, and when the servo ticks on any clock.

#include "claystack/servo/servo.hpp"

#include <algorithm>
#include <cstdint>

namespace clay::servo {

/// CLOCK_MONOTONIC, with absolute deadlines: what a sleep comes late by does not add up.
class MonotonicClock final : public Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() noexcept override;
  void sleep_until_ns(std::int64_t time_ns) noexcept override;
  /// Sleeps until a little before, by as much as sleeps of the last while ended late, and looks at
  /// the clock from there on: for kLongestLookNs at most.
  std::int64_t wake_at_ns(std::int64_t time_ns) noexcept override;

  static constexpr std::int64_t kLongestLookNs = 100'000;

 private:
  std::int64_t lead_ns_ = kLongestLookNs;
};

/// When the servo ticks. Absolute deadlines, one period apart, so that what a sleep is late by does
/// not add up; ticks that were missed are not made up for. A device that answers a question of ours
/// sets the pace itself: the servo wakes half a period before its answer is due, and waits for it.
class Pacer {
 public:
  explicit Pacer(std::int64_t period_ns) noexcept : period_ns_(period_ns) {}

  /// A device may have been asked just now.
  void start(std::int64_t now_ns) noexcept { deadline_ns_ = now_ns + period_ns_ / 2; }

  /// Sleeps until the deadline; how late it woke [ns].
  [[nodiscard]] std::int64_t wait(Clock& clock) noexcept {
    overslept_ns_ = clock.wake_at_ns(deadline_ns_);
    return std::max<std::int64_t>(0, clock.now_ns() - deadline_ns_);
  }

  /// How long the device may then be waited for [us].
  [[nodiscard]] std::int64_t patience_us(std::int64_t now_ns) const noexcept {
    return std::max<std::int64_t>(0, deadline_ns_ + period_ns_ - now_ns) / 1000;
  }

  /// The sample is there, or was not to be had.
  void sampled(std::int64_t now_ns) noexcept {
    deadline_ns_ = std::max(deadline_ns_ + period_ns_, now_ns + period_ns_ / 2);
  }

  /// What wait() would have been late by without looking at the clock.
  [[nodiscard]] std::int64_t overslept_ns() const noexcept { return overslept_ns_; }
  [[nodiscard]] std::int64_t period_ns() const noexcept { return period_ns_; }

 private:
  std::int64_t period_ns_, deadline_ns_ = 0, overslept_ns_ = 0;
};

}  // namespace clay::servo
