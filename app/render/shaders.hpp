#pragma once
// The shader programs, in the GLSL that is common to OpenGL 3.3 and OpenGL ES 3.0; make_program
// adds the first lines. All light is linear until the last line of a fragment shader.

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <string>

namespace clay::render {

/// Data of a frame for all programs: block `Frame`, std140, field by field.
struct FrameBlock {
  glm::mat4 view_projection{1.0f};
  glm::vec4 eye{0.0f};                                       ///< [mm]
  glm::vec4 to_lamp{0.0f};                                   ///< unit; cosine of the wheel's turn
  glm::vec4 to_rim_lamp{0.0f};                               ///< unit; sine of the wheel's turn
  glm::vec4 lamp{0.0f}, sky{0.0f}, bounce{0.0f}, rim{0.0f};  ///< linear colours
  glm::vec4 low{0.0f}, high{0.0f};                           ///< of the background, at its edges
  /// Width, height [px]; half side of the shadow map [mm]; rows of the picture below the
  /// framebuffer.
  glm::vec4 viewport{0.0f};
  glm::vec4 wall_map{0.0f};  ///< limit, top [mm]; above 0: drawn
  glm::vec4 wheel{0.0f};     ///< turn [rad], radius, thickness; size of the clay [mm]
  /// The sides of the lamp's window and of the rim lamp's strip, unit.
  glm::vec4 lamp_across{0.0f}, lamp_upward{0.0f}, strip_across{0.0f}, strip_upward{0.0f};
};

/// std140 arrays of the wall map's colours.
inline constexpr int kMapColours = 17;

[[nodiscard]] std::string background_vertex();
[[nodiscard]] std::string background_fragment();
[[nodiscard]] std::string revolve_vertex();  ///< Stretch, revolved
[[nodiscard]] std::string clay_fragment();
[[nodiscard]] std::string coated_clay_fragment();  ///< below water or glass
[[nodiscard]] std::string plain_fragment();        ///< tools and arrows
[[nodiscard]] std::string wheel_fragment();
[[nodiscard]] std::string ground_fragment();
[[nodiscard]] std::string slice_vertex();  ///< Slice, turned about the axis
[[nodiscard]] std::string slice_fragment();

}  // namespace clay::render
