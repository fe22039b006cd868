#pragma once
#include "claystack/export/solid.hpp"

namespace clay::solid {

/// The largest distance [mm] from a vertex of either mesh to the nearest of the other (Hausdorff
/// distance of the vertex sets); for formats that change the order of vertices. Neither may be
/// empty.
[[nodiscard]] double vertex_distance(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace clay::solid
