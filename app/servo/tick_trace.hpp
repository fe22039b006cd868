#pragma once
// How well the servo keeps its time: all ticks as histograms, and each tick for a plot. Adding
// never waits; what finds no room is counted.

#include "core/histogram.hpp"
#include "core/spsc_queue.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

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

struct TickSample {
  std::int64_t time_ns = 0;  ///< when the sample was there; of the servo's clock
  float clay_n = 0.0f;       ///< of the clay on the tool, its length
  float sent_n = 0.0f;       ///< to the device, its length
  float late_us = 0.0f;      ///< woken after the deadline
  float work_us = 0.0f;      ///< from the sample until the force is handed to the device
  bool missed = false;       ///< woken a whole period late, or more
};

/// The servo adds, one other thread takes. Outlives the servo.
class TickTrace {
 public:
  static constexpr std::size_t kRoom = 4096;  ///< four seconds at 1 kHz

  /// By the thread that takes. Off, a tick costs one relaxed load.
  void want(bool wanted) noexcept { wanted_.store(wanted, std::memory_order_relaxed); }
  [[nodiscard]] std::optional<TickSample> take() noexcept { return queue_.pop(); }
  /// Samples that there was no room for.
  [[nodiscard]] std::uint64_t dropped() const noexcept {
    return dropped_.load(std::memory_order_relaxed);
  }

  /// By the servo.
  void add(const TickSample& sample) noexcept {
    if (!wanted_.load(std::memory_order_relaxed)) return;
    if (!queue_.push(sample)) dropped_.fetch_add(1, std::memory_order_relaxed);
  }

 private:
  SpscQueue<TickSample, kRoom> queue_;
  std::atomic<bool> wanted_{false};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace clay::servo
