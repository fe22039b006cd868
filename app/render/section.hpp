#pragma once
// From rows to what is drawn of them: the levels of a body's section, and the meridian that
// revolves into its surface.

#include "app/render/picture.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace clay::render {

/// The section at a height. Between two levels walls run straight; two levels of one height are a
/// floor, a lid or nothing at all.
struct Level {
  float y = 0.0f;
  float outer = 0.0f, inner = 0.0f;
  float outer_lean = 0.0f, inner_lean = 0.0f;  ///< of the walls, outwards from upright [rad]
  RowWall wall;
};

/// Rows `first` up to, not including, `last`. Levels that lie on straight walls between others to
/// within `tolerance_mm` are left out: triangles below the size of a pixel cost the most.
[[nodiscard]] std::vector<Level> levels_of(const PotView& pot, std::size_t first, std::size_t last,
                                           float tolerance_mm);

/// A stretch of a meridian, left of which there is matter: what the vertex shader revolves. All
/// pairs: at its beginning, at its end.
struct Stretch {
  glm::vec2 from{0.0f}, to{0.0f};                ///< (rho, y) [mm]
  glm::vec2 from_normal{0.0f}, to_normal{0.0f};  ///< outward, unit
  glm::vec2 open{1.0f};                          ///< part of the sky that reaches it
  glm::vec2 wall{0.0f};                          ///< thickness [mm]
  glm::vec2 neck{
      0.0f};  ///< radius and height of the ring that light must pass [mm]; radius 0: none
};

/// The closed surface of what lies between the levels.
[[nodiscard]] std::vector<Stretch> meridian_of(const std::vector<Level>& levels);

/// Of a line (rho, y) upwards; closed by discs where it does not end on the axis. For tools and the
/// like: open sky, no wall, no neck.
[[nodiscard]] std::vector<Stretch> meridian_of(const std::vector<glm::vec2>& line);

/// A slice of the section's face, from the bore to the outside.
struct Slice {
  glm::vec2 low{0.0f}, high{0.0f};  ///< (inner, outer) [mm]
  glm::vec2 y{0.0f};                ///< of both [mm]
  glm::vec2 wall{0.0f};             ///< thickness [mm]
};

[[nodiscard]] std::vector<Slice> slices_of(const std::vector<Level>& levels);

}  // namespace clay::render
