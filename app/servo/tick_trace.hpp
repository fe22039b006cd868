#pragma once
// Timing of the servo: histograms of all ticks, and single ticks for a plot. Adding never waits;
// samples that do not fit are counted.

#include "claystack/servo/servo.hpp"
#include "core/histogram.hpp"
#include "core/spsc_queue.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace clay::servo {

struct ServoTiming {
  Histogram lateness;   ///< delay of the wake-up after the deadline
  Histogram oversleep;  ///< delay of sleeps, without polling
  Histogram period;     ///< between samples, or failed readings
  Histogram work;       ///< from the sample to the force handed to the device
  Histogram age;        ///< age of fresh samples when the force is handed over
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;  ///< woken a whole period late or more
  std::uint64_t stale = 0;   ///< ticks without a fresh sample

  /// Mean load: the fraction of the period that clay and force need.
  [[nodiscard]] double work_share() const noexcept {
    return period.mean_ns() > 0.0 ? work.mean_ns() / period.mean_ns() : 0.0;
  }
};

/// Event counts: one per flag, counted when the flag is raised and not while it lasts.
struct GuardEvents {
  static constexpr std::size_t kFlags = 10;
  static constexpr std::size_t kCauses = 7;
  std::array<std::uint64_t, kFlags> flags{};
  std::array<std::uint64_t, kCauses> safe{};  ///< by SafeCause
  std::uint64_t damped = 0;                   ///< ticks in which the passivity controller acted
  std::uint64_t watchdog = 0;                 ///< forces ended by the watchdog
};

struct TickSample {
  std::int64_t time_ns = 0;  ///< time of the sample on the servo's clock
  float clay_n = 0.0f;       ///< force of the clay on the tool
  float sent_n = 0.0f;       ///< force sent to the device
  float late_us = 0.0f;      ///< delay of the wake-up after the deadline
  float work_us = 0.0f;      ///< from the sample to the force handed to the device
  bool missed = false;       ///< woken a whole period late or more
};

/// The servo adds samples; one other thread removes them. Outlives the servo.
class TickTrace {
 public:
  static constexpr std::size_t kRoom = 4096;  ///< four seconds at 1 kHz

  /// Called by the reader. While off, a tick costs one relaxed load.
  void want(bool wanted) noexcept { wanted_.store(wanted, std::memory_order_relaxed); }
  [[nodiscard]] std::optional<TickSample> take() noexcept { return queue_.pop(); }
  /// Number of samples lost because the queue was full.
  [[nodiscard]] std::uint64_t dropped() const noexcept {
    return dropped_.load(std::memory_order_relaxed);
  }

  /// Called by the servo.
  void add(const TickSample& sample) noexcept {
    if (!wanted_.load(std::memory_order_relaxed)) return;
    if (!queue_.push(sample)) dropped_.fetch_add(1, std::memory_order_relaxed);
  }

 private:
  SpscQueue<TickSample, kRoom> queue_;
  std::atomic<bool> wanted_{false};
  std::atomic<std::uint64_t> dropped_{0};
};

/// The measurements of a live throw.
struct LiveMeasures {
  /// LiveThrow::build with a trace of the ticks, which must outlive it; null: none.
  static Result<LiveThrow> build(const ThrowParts& parts, const LiveSettings& settings,
                                 TickTrace* trace);
  // After LiveThrow::join.
  [[nodiscard]] static const ServoTiming& timing(const LiveThrow& live) noexcept;
  [[nodiscard]] static const GuardEvents& events(const LiveThrow& live) noexcept;
};

}  // namespace clay::servo
