#pragma once
#include "claystack/export/solid.hpp"

namespace clay::solid {

/// The largest distance [mm] from a vertex of either mesh to the surface of the other. Each must
/// have a triangle with area; unused points count too.
[[nodiscard]] double surface_distance(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace clay::solid
