#pragma once
#include "claystack/export/solid.hpp"

namespace clay::solid::inline repair {

/// Of points beside a surface, 1.3 times `offset_mm` away on either side, the share inside a wall
/// around it, a closed mesh: the gaps that the wall closes, and corners. By 2,000 samples, spread
/// evenly over the area. The surface has a triangle with area.
double share_filled(const TriangleMesh& surface, const TriangleMesh& wall, double offset_mm);

}  // namespace clay::solid::inline repair
