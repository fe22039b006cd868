#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/repair.hpp"
#include "export/repair/half_edge_surface.hpp"

namespace clay::solid::inline repair {

/// Fills holes of up to kMaxHoleEdges edges by triangles between their vertices. A wide opening is
/// an error (`unsound`) unless `cap_openings`: its cap would cover at least 1/50 of the surface,
/// and most of its border is a rim, where cap and surface meet at more than 60 degrees. The surface
/// is then as given.
Result<std::vector<FilledHole>> fill_holes(Surface& surface, bool cap_openings);

}  // namespace clay::solid::inline repair
