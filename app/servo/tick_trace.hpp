#pragma once
// Every tick of the servo for who plots them: it never waits, and what finds no room is counted.

#include "core/spsc_queue.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace clay::servo {

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
