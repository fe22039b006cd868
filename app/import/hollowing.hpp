#pragma once
// Gives the drawing of a pot's outside a wall of even thickness.

#include "app/import/half_section.hpp"

#include <string>

namespace clay::importing {

/// The part of a slab between two heights.
[[nodiscard]] Slab part_of(const Slab& slab, double from_mm, double to_mm);

/// The section with a bore, which is open at the rim. Each of its points is at least `wall_mm` from
/// the outside and the foot, and as near as kFlatMm allows: walls and floor are `wall_mm` thick
/// across, at any slope. Refuses a section that has a bore, and a wall that leaves no bore, or
/// closes it below the rim. `more_mm` is added to the wall, but neither to the
/// floor nor in errors.
Result<HalfSection> hollowed(const HalfSection& solid, double wall_mm, const std::string& name,
                             double more_mm = 0.0);

/// The least distance across the wall and floor, and its place on the inside.
struct ThinnestWall {
  double mm = 0.0, radius_mm = 0.0, height_mm = 0.0;
};

/// Of a section with a bore that is open at the rim.
[[nodiscard]] ThinnestWall thinnest_wall(const HalfSection& section);

}  // namespace clay::importing
