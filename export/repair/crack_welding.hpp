#pragma once
#include "export/solid/mesh_topology.hpp"

#include <cstddef>
#include <optional>

namespace clay::solid::inline repair {

/// Points of open edges within `weld_mm` of each other become one; for the default see
/// RepairOptions. Requires finite points. Returns the number of points that were welded.
std::size_t weld_cracks(TriangleMesh& mesh, std::optional<double> weld_mm);

}  // namespace clay::solid::inline repair
