#pragma once
// The shadow of the clay on the wheel head as a small map: soft, so that few texels suffice.

#include "app/render/section.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace clay::render {

/// A body that casts a shadow: its levels, and its placement.
struct Body {
  std::vector<Level> levels;
  glm::mat4 place{1.0f};
};

struct ShadowMap {
  static constexpr std::size_t kSide = 96;
  /// Light of the lamp and of the sky that reaches each texel, rows along z, texels along x.
  std::array<std::array<std::uint8_t, 2>, kSide * kSide> light{};
  float half_side_mm = 1.0f;  ///< covers the square of twice this side about the axis
};

/// `to_lamp`: unit, upwards. `sweep`: azimuths between which the bodies are not cut away [rad].
[[nodiscard]] ShadowMap shadow_of(std::span<const Body> bodies, const glm::vec3& to_lamp,
                                  glm::vec2 sweep);

}  // namespace clay::render
