#pragma once
// Finds places where the tool does not touch the clay. A press that begins inside the clay starts
// from such a place, so that a click removes nothing.

#include "app/render/picture.hpp"
#include "claystack/engine/tool.hpp"

#include <glm/vec2.hpp>
#include <optional>

namespace clay::studio {

/// Minimum distance between tool and clay [mm].
inline constexpr double kClearanceMm = 0.25;

/// Whether the tool can be in the bore: not in that of a pot that stands upside down.
enum class Bore { open, covered };

/// The nearest place to `place_mm` (rho, y) at which `tool` is clear of the clay: the place itself,
/// beside it at the same height (outside or in an open bore), or straight above it. rho keeps its
/// sign, and y is at least 0.
[[nodiscard]] glm::dvec2 free_place(const render::PotView& pot, const Tool& tool,
                                    glm::dvec2 place_mm, Bore bore = Bore::open);

/// A wall that is led outward keeps at least this distance from the edge of the foot [mm].
inline constexpr double kFootSpareMm = 3.0;

struct WallPlace {
  double middle_mm = 0.0;     ///< rho of the middle of the wall, above 0
  double thickness_mm = 0.0;  ///< gap at which two tools are clear of the clay
  double y_mm = 0.0;          ///< height of the tools
};
/// The wall at this height, over the height of the tool; nothing if there is no wall (no bore, or
/// above the rim).
[[nodiscard]] std::optional<WallPlace> wall_at(const render::PotView& pot, const Tool& tool,
                                               double y_mm);

/// The same at the lowest height from `y_mm` on at which two tools fit: above the floor.
[[nodiscard]] std::optional<WallPlace> wall_above(const render::PotView& pot, const Tool& tool,
                                                  double y_mm);

/// Additional gap of two tools at a wall that leans, compared with an upright one [mm]: with it
/// they touch the wall along its slope and do not fold it. 0 without a wall at this height.
[[nodiscard]] double stand_off_mm(const render::PotView& pot, const Tool& tool, double y_mm);

/// True if a place on the wheel is nearer to the bore than to the outside.
[[nodiscard]] bool inside(const render::PotView& pot, const glm::dvec3& place_mm);

}  // namespace clay::studio
