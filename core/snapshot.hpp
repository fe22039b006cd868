#pragma once
// The newest value, from one thread to another, with no lock and no waiting on either side. Three
// buffers: the writer fills one, the reader looks at another, and the third lies in the middle
// with the newest whole value. Each side swaps its own for the one in the middle.

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace clay {

/// One thread writes, one reads; for two readers take two snapshots. Values are copied into
/// buffers made beforehand: a vector of the same size allocates nothing.
template <class T>
class Snapshot {
 public:
  Snapshot() = default;
  explicit Snapshot(const T& first) : buffers_{Buffer{first}, Buffer{first}, Buffer{first}} {}
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

  /// The writer's: fill this, then publish(). Holds a value written earlier, not the last.
  [[nodiscard]] T& draft() noexcept { return buffers_[written_].value; }

  /// The draft is the newest value from now on.
  void publish() noexcept {
    written_ = middle_.exchange(written_ | kNew, std::memory_order_acq_rel) & kIndex;
  }

  /// Both at once.
  void write(const T& value) noexcept(std::is_nothrow_copy_assignable_v<T>) {
    draft() = value;
    publish();
  }

  /// The reader's: is there a value that newest() hasn't shown yet?
  [[nodiscard]] bool has_new() const noexcept {
    return (middle_.load(std::memory_order_relaxed) & kNew) != 0;
  }

  /// The newest whole value; stays as it is until the next call. The first one given, or T{}, when
  /// nothing was published yet.
  [[nodiscard]] const T& newest() noexcept {
    if (has_new()) read_ = middle_.exchange(read_, std::memory_order_acq_rel) & kIndex;
    return buffers_[read_].value;
  }

 private:
  static constexpr std::uint8_t kIndex = 3, kNew = 4;
  static constexpr std::size_t kCacheLine = 64;
  static_assert(std::atomic<std::uint8_t>::is_always_lock_free);

  // Neither side slows the other by writing next to what it reads.
  struct alignas(kCacheLine) Buffer {
    T value{};
  };

  std::array<Buffer, 3> buffers_{};
  alignas(kCacheLine) std::uint8_t written_ = 0;
  alignas(kCacheLine) std::atomic<std::uint8_t> middle_{1};
  alignas(kCacheLine) std::uint8_t read_ = 2;
};

}  // namespace clay
