#pragma once
// The servo's only source of time, so that tests can run it on one of their own.

#include <cstdint>

namespace clay::servo {

class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  /// [ns]; in whole microseconds the time of the device's samples.
  [[nodiscard]] virtual std::int64_t now_ns() noexcept = 0;
  [[nodiscard]] std::int64_t now_us() noexcept { return now_ns() / 1000; }

  /// Returns at once where that time has passed.
  virtual void sleep_until_ns(std::int64_t time_ns) noexcept = 0;

  /// The same as exactly as can be, for one thread. How much later than asked the sleep within it
  /// ended [ns]: what the system alone is good for.
  virtual std::int64_t wake_at_ns(std::int64_t time_ns) noexcept {
    sleep_until_ns(time_ns);
    return 0;
  }
};

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

}  // namespace clay::servo
