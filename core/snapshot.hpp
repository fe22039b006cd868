#pragma once
// Passes the newest value from one thread to another without locks or waiting. Triple buffer: the
// writer fills one, the reader reads another, and the third holds the newest complete value. Each
// side swaps its buffer with the third.

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace clay {

/// One thread writes, one reads; two readers need two snapshots. Values are copied into existing
/// buffers: a vector of the same size allocates nothing.
template <class T>
class Snapshot {
 public:
  Snapshot() = default;
  explicit Snapshot(const T& first) : buffers_{Buffer{first}, Buffer{first}, Buffer{first}} {}
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

  /// Writer: fill this, then publish(). Holds an older value, not the last one.
  [[nodiscard]] T& draft() noexcept { return buffers_[written_].value; }

  /// Makes the draft the newest value.
  void publish() noexcept {
    written_ = middle_.exchange(written_ | kNew, std::memory_order_acq_rel) & kIndex;
  }

  /// Fills the draft and publishes it.
  void write(const T& value) noexcept(std::is_nothrow_copy_assignable_v<T>) {
    draft() = value;
    publish();
  }

  /// Reader: true if newest() has not yet returned the newest value.
  [[nodiscard]] bool has_new() const noexcept {
    return (middle_.load(std::memory_order_relaxed) & kNew) != 0;
  }

  /// The newest complete value; unchanged until the next call. Before the first publish: the
  /// initial value, or T{}.
  [[nodiscard]] const T& newest() noexcept {
    if (has_new()) read_ = middle_.exchange(read_, std::memory_order_acq_rel) & kIndex;
    return buffers_[read_].value;
  }

 private:
  static constexpr std::uint8_t kIndex = 3, kNew = 4;
  static constexpr std::size_t kCacheLine = 64;
  static_assert(std::atomic<std::uint8_t>::is_always_lock_free);

  // Separate cache lines: neither side slows the other by false sharing.
  struct alignas(kCacheLine) Buffer {
    T value{};
  };

  std::array<Buffer, 3> buffers_{};
  alignas(kCacheLine) std::uint8_t written_ = 0;
  alignas(kCacheLine) std::atomic<std::uint8_t> middle_{1};
  alignas(kCacheLine) std::uint8_t read_ = 2;
};

}  // namespace clay
