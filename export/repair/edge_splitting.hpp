#pragma once
#include "export/solid/mesh_topology.hpp"

#include <cstddef>
#include <optional>

namespace clay::solid::inline repair {

/// Closes T-junctions: open edges are split at the vertices of other open edges that lie on them,
/// so that the borders match. The default of the distance is a ten-thousandth of the edge, at most
/// that of `weld_cracks`, which must have been called before with the same `weld_mm`. No point
/// moves. Returns the number of vertices that were added to edges.
std::size_t split_edges(TriangleMesh& mesh, std::optional<double> weld_mm);

}  // namespace clay::solid::inline repair
