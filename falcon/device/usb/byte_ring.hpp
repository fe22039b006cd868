#pragma once
// A buffer of received bytes. On overflow the oldest are dropped, because a late reader needs the
// newest.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace clay::falcon::inline device {

class ByteRing {
 public:
  void push(std::span<const std::uint8_t> bytes) noexcept {
    for (const std::uint8_t byte : bytes) {
      if (size_ == ring_.size()) --size_, ++first_;
      ring_[(first_ + size_++) % ring_.size()] = byte;
    }
  }

  std::size_t pop(std::span<std::uint8_t> bytes) noexcept {
    const std::size_t taken = std::min(bytes.size(), size_);
    for (std::size_t i = 0; i < taken; ++i) bytes[i] = ring_[(first_ + i) % ring_.size()];
    first_ += taken;
    size_ -= taken;
    return taken;
  }

  void clear() noexcept { size_ = 0; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }

 private:
  std::array<std::uint8_t, 2048> ring_{};
  std::size_t first_ = 0, size_ = 0;
};

}  // namespace clay::falcon::inline device
