#pragma once
// The servo's only source of time, so that tests can run it on one of their own.

#include <cstdint>

namespace clay::live {

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
};

/// CLOCK_MONOTONIC, with absolute deadlines: what a sleep comes late by does not add up.
class MonotonicClock final : public Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() noexcept override;
  void sleep_until_ns(std::int64_t time_ns) noexcept override;
};

}  // namespace clay::live
