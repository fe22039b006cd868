#pragma once
// Times of poses are whole microseconds; people and options have seconds.

#include <cmath>
#include <cstdint>

namespace clay {

/// The nearest double; 1e-6 * us may differ from it.
[[nodiscard]] constexpr double in_seconds(std::int64_t us) noexcept {
  return static_cast<double>(us) / 1e6;
}

/// The nearest whole number: the inverse of `in_seconds` for times of up to a century.
[[nodiscard]] inline std::int64_t in_microseconds(double seconds) noexcept {
  return std::llround(1e6 * seconds);
}

}  // namespace clay
