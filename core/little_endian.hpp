#pragma once
// Numbers in binary files, with the same byte order on every machine.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace clay {

/// Swaps the bytes on big-endian machines; its own inverse.
[[nodiscard]] inline std::uint32_t little_endian(std::uint32_t value) noexcept {
  if constexpr (std::endian::native == std::endian::little) return value;
  auto bytes = std::bit_cast<std::array<char, 4>>(value);
  std::ranges::reverse(bytes);
  return std::bit_cast<std::uint32_t>(bytes);
}

inline void store_u32(char* at, std::uint32_t value) noexcept {
  const std::uint32_t stored = little_endian(value);
  std::memcpy(at, &stored, sizeof stored);
}

[[nodiscard]] inline std::uint32_t load_u32(const char* at) noexcept {
  std::uint32_t stored = 0;
  std::memcpy(&stored, at, sizeof stored);
  return little_endian(stored);
}

inline void store_f32(char* at, float value) noexcept {
  store_u32(at, std::bit_cast<std::uint32_t>(value));
}

[[nodiscard]] inline float load_f32(const char* at) noexcept {
  return std::bit_cast<float>(load_u32(at));
}

}  // namespace clay
