#pragma once
// Parts of a solid that touch in an edge or a point: files identify points by their position, so
// such parts must be moved apart to be printable as a manifold.

#include "export/solid/mesh_topology.hpp"

#include <cstddef>

namespace clay::solid::inline repair {

/// For a closed mesh whose triangles meet only in common edges and vertices, oriented so that every
/// edge is followed equally often in both directions. Where clay touches clay in an edge or a
/// vertex, the parts are separated: of each part but the flattest, the vertex moves by `gap_mm`
/// towards its own neighbours. New points are float32, and follow the old ones. Returns the number
/// of vertices that moved.
std::size_t pull_apart(TriangleMesh& mesh, double gap_mm);

}  // namespace clay::solid::inline repair
