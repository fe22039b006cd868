#pragma once
// Where a tool can be without touching the clay: a press that begins inside the clay begins there
// instead, so that a click never bites.

#include "app/render/picture.hpp"
#include "claystack/engine/tool.hpp"

#include <glm/vec2.hpp>
#include <optional>

namespace clay::studio {

/// The tool's centre, at least so far from the clay [mm].
inline constexpr double kClearanceMm = 0.25;

/// The nearest place to `place_mm` (rho, y) at which `tool` is clear of the clay: itself, or beside
/// it at the same height, outside or in the bore, or straight above it. rho keeps its sign, and y
/// is at least 0.
[[nodiscard]] glm::dvec2 free_place(const render::PotView& pot, const Tool& tool,
                                    glm::dvec2 place_mm);

struct WallPlace {
  double middle_mm = 0.0;     ///< rho of the wall's middle, above 0
  double thickness_mm = 0.0;  ///< that two tools have to span, each wholly clear of the clay
};
/// The wall at a height, as far as the tool reaches up and down; nothing where there is none
/// (no bore, or above the rim).
[[nodiscard]] std::optional<WallPlace> wall_at(const render::PotView& pot, const Tool& tool,
                                               double y_mm);

/// Whether a place on the wheel is nearer to the bore than to the outside.
[[nodiscard]] bool inside(const render::PotView& pot, const glm::dvec3& place_mm);

}  // namespace clay::studio
