#pragma once
// How well the servo keeps its time, tick by tick.

#include "core/histogram.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace clay::servo {

struct ServoTiming {
  Histogram lateness;   ///< woken after the deadline
  Histogram oversleep;  ///< sleeps within, ended later than asked
  Histogram period;     ///< from one sample, or want of one, to the next
  Histogram work;       ///< from there until the force is handed to the device
  Histogram age;        ///< of the sample when the force is handed over; fresh ones
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;  ///< woken a whole period late, or more
  std::uint64_t stale = 0;   ///< no fresh sample

  /// Work over periods: what the clay and the force take of the time there is.
  [[nodiscard]] double work_share() const noexcept {
    return period.mean_ns() > 0.0 ? work.mean_ns() / period.mean_ns() : 0.0;
  }
};

/// Event counts: one per flag, counted when it is raised and not while it lasts.
struct GuardEvents {
  static constexpr std::size_t kFlags = 10;
  static constexpr std::size_t kCauses = 7;
  std::array<std::uint64_t, kFlags> flags{};
  std::array<std::uint64_t, kCauses> safe{};  ///< by SafeCause
  std::uint64_t damped = 0;    ///< ticks in which the passivity controller was at work
  std::uint64_t watchdog = 0;  ///< forces ended by it
};

}  // namespace clay::servo
