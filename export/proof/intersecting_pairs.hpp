#pragma once
#include "export/proof/crossings.hpp"
#include "export/solid/mesh_topology.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline proof {

/// The pairs of triangles that intersect outside the vertices or the edge they share, sorted; at
/// most `most` of them. Triangles without area, and pairs on the same three vertices, are skipped.
/// Requires finite points and indices in range.
std::vector<TrianglePair> intersecting_pairs(const TriangleMesh& mesh, std::size_t most);

}  // namespace clay::solid::inline proof
