#pragma once
// Light, colours and materials of both themes.

#include "app/render/picture.hpp"
#include "app/render/shaders.hpp"

#include <array>
#include <glm/vec3.hpp>

namespace clay::render {

/// Linear light of an sRGB colour, 0xRRGGBB.
[[nodiscard]] glm::vec3 linear_of(unsigned rgb) noexcept;

/// `kScaleColours`, linear, for the shaders.
[[nodiscard]] const std::array<glm::vec4, kMapColours>& map_colours() noexcept;

struct Look {
  glm::vec3 lamp, sky, bounce, rim;
  glm::vec3 low, high;  ///< background
  glm::vec3 metal;      ///< wheel head
  glm::vec3 tool, arrow;
};
[[nodiscard]] const Look& look_of(Theme theme) noexcept;

/// Linear colour of the cut through the clay: its body, paler.
[[nodiscard]] glm::vec3 section_colour(const Material& material) noexcept;

/// The lamps move with the camera, so that shape is visible from every side: (right, up, to the
/// camera), unit.
[[nodiscard]] glm::dvec3 lamp_direction() noexcept;
[[nodiscard]] glm::dvec3 rim_lamp_direction() noexcept;

}  // namespace clay::render
