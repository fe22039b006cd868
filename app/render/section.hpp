#pragma once
// Converts rows to geometry: the levels of a body's section, and the meridian that revolves into
// its surface.

#include "app/render/picture.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace clay::render {

/// The section at a height. Walls are straight between two levels; two levels of equal height are a
/// floor, a lid or nothing.
struct Level {
  float y = 0.0f;
  float outer = 0.0f, inner = 0.0f;
  /// Inclination of the walls, outward from vertical [rad].
  float outer_lean = 0.0f, inner_lean = 0.0f;
  RowWall wall;
};

/// Rows `first` up to, not including, `last`. Levels on straight walls between others, within
/// `tolerance_mm`, are omitted: triangles below the size of a pixel cost the most.
[[nodiscard]] std::vector<Level> levels_of(const PotView& pot, std::size_t first, std::size_t last,
                                           float tolerance_mm);

/// A stretch of a meridian with matter to its left; the vertex shader revolves it. All pairs: at
/// its start, at its end.
struct Stretch {
  glm::vec2 from{0.0f}, to{0.0f};                ///< (rho, y) [mm]
  glm::vec2 from_normal{0.0f}, to_normal{0.0f};  ///< outward, unit
  glm::vec2 open{1.0f};                          ///< visible fraction of the sky
  glm::vec2 wall{0.0f};                          ///< thickness [mm]
  /// Radius and height of the ring that limits the light [mm]; radius 0: none.
  glm::vec2 neck{0.0f};
};

/// The closed surface of the body between the levels.
[[nodiscard]] std::vector<Stretch> meridian_of(const std::vector<Level>& levels,
                                               bool round_lip = true);

/// The surface of a line (rho, y) upward, closed by discs where it does not end on the axis. For
/// tools and similar bodies: full sky, no wall, no limiting ring.
[[nodiscard]] std::vector<Stretch> meridian_of(const std::vector<glm::vec2>& line);

/// A slice of the section's face, from the bore to the outside.
struct Slice {
  glm::vec2 low{0.0f}, high{0.0f};  ///< (inner, outer) [mm]
  glm::vec2 y{0.0f};                ///< of both [mm]
  glm::vec2 wall{0.0f};             ///< thickness [mm]
};

[[nodiscard]] std::vector<Slice> slices_of(const std::vector<Level>& levels);

}  // namespace clay::render
