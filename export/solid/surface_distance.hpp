#pragma once
#include "claystack/export/solid.hpp"

namespace clay::solid {

/// The largest distance [mm] from a point to the surface of the mesh, which has a triangle with
/// area.
[[nodiscard]] double distance_to_surface(const std::vector<glm::dvec3>& points,
                                         const TriangleMesh& mesh);

/// The largest distance [mm] from a vertex of either mesh to the surface of the other. Each must
/// have a triangle with area; unused points count too.
[[nodiscard]] double surface_distance(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace clay::solid
