#pragma once
#include <cstdint>
#include <string_view>

namespace clay {

/// FNV-1a, 64 bits (Fowler, Noll, Vo). Every step is a bijection of the state, so the change of one
/// byte always changes the hash.
class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) add_byte(static_cast<unsigned char>(byte));
  }
  /// Eight bytes, little-endian.
  void add(std::int64_t value) {
    for (unsigned shift = 0; shift < 64; shift += 8)
      add_byte(static_cast<std::uint64_t>(value) >> shift & 0xff);
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  void add_byte(std::uint64_t byte) { value_ = (value_ ^ byte) * 0x100000001b3; }
  std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace clay
