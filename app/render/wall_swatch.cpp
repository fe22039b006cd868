#include "app/render/wall_swatch.hpp"

#include "core/colour_scale.hpp"

namespace clay::render {

Swatch wall_swatch(const WallMap& map, double wall_mm) noexcept {
  if (wall_mm < map.limit_mm) return swatch_of(kThinWall);
  const auto [red, green, blue] = scale_colour(wall_mm / map.top_mm);
  return {srgb_byte(red), srgb_byte(green), srgb_byte(blue)};
}

}  // namespace clay::render
