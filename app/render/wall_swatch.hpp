#pragma once
// The colours of the wall map on a screen or in a file.

#include "app/render/picture.hpp"

#include <cstdint>

namespace clay::render {

/// An sRGB colour.
struct Swatch {
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// Walls below the limit, and the stripes that hatch them: sRGB 0xRRGGBB.
inline constexpr std::uint32_t kThinWall = 0xE72830, kThinWallStripe = 0xFFE7DF;

[[nodiscard]] constexpr Swatch swatch_of(std::uint32_t rgb) noexcept {
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
          static_cast<std::uint8_t>(rgb)};
}

/// The colour of a wall; kThinWall below the limit.
[[nodiscard]] Swatch wall_swatch(const WallMap& map, double wall_mm) noexcept;

}  // namespace clay::render
