#pragma once
// Identifies the bytes of a file: XXH3-128 detects accidental changes, but does not resist forgery.

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace clay {

/// 32 hexadecimal digits, as `xxh128sum` prints them.
using ContentHash = std::string;

class ContentHasher {
 public:
  ContentHasher();
  void add(std::span<const std::byte> bytes) noexcept;
  [[nodiscard]] ContentHash digest() const;

 private:
  struct State;
  struct Free {
    void operator()(State* state) const noexcept;
  };
  std::unique_ptr<State, Free> state_;
};

[[nodiscard]] ContentHash hash_of(std::span<const std::byte> bytes);

}  // namespace clay
