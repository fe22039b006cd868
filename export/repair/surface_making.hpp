#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/repair.hpp"
#include "export/repair/half_edge_surface.hpp"

namespace clay::solid::inline repair {

/// Half-edges for a clean soup, with consistent orientation: edges and vertices where sheets touch
/// are cut apart, borders in the same place are stitched, holes that touch in a vertex get separate
/// borders, and each connected part keeps the orientation of most of its triangles. Triangles
/// without area and lone triangles are removed. An error (`unsound`) if the library finds no
/// surface.
Result<Surface> make_surface(const TriangleMesh& soup, std::vector<Repair>& repaired);

TriangleMesh mesh_of(Surface& surface);

}  // namespace clay::solid::inline repair
