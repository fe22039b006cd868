#pragma once
// Passes commands from one thread to another in order, without locks or waiting: a ring buffer of
// fixed size. A full queue refuses, an empty one returns nothing.

#include <array>
#include <atomic>
#include <cstddef>
#include <optional>
#include <type_traits>

namespace clay {

/// One thread pushes, one pops. `Capacity`: a power of two, so that the counters may wrap.
template <class T, std::size_t Capacity>
class SpscQueue {
  static_assert(Capacity > 0 && (Capacity & (Capacity - 1)) == 0, "a power of two");
  static_assert(std::is_nothrow_copy_assignable_v<T> && std::is_nothrow_copy_constructible_v<T>,
                "the servo pops: nothing may throw");

 public:
  SpscQueue() = default;
  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  /// False if full: the command was not queued.
  [[nodiscard]] bool push(const T& command) noexcept {
    const std::size_t pushed = pushed_.load(std::memory_order_relaxed);
    if (pushed - popped_.load(std::memory_order_acquire) == Capacity) return false;
    ring_[pushed % Capacity] = command;
    pushed_.store(pushed + 1, std::memory_order_release);
    return true;
  }

  [[nodiscard]] std::optional<T> pop() noexcept {
    const std::size_t popped = popped_.load(std::memory_order_relaxed);
    if (pushed_.load(std::memory_order_acquire) == popped) return std::nullopt;
    std::optional<T> command(ring_[popped % Capacity]);
    popped_.store(popped + 1, std::memory_order_release);
    return command;
  }

 private:
  static constexpr std::size_t kCacheLine = 64;
  static_assert(std::atomic<std::size_t>::is_always_lock_free);

  std::array<T, Capacity> ring_{};
  alignas(kCacheLine) std::atomic<std::size_t> pushed_{0};
  alignas(kCacheLine) std::atomic<std::size_t> popped_{0};
};

}  // namespace clay
