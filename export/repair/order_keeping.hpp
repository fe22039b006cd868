#pragma once
#include "export/solid/mesh_topology.hpp"

namespace clay::solid::inline repair {

/// Numbers the result like the input, so that files of both differ only where the repair changed
/// something: triangles on the same three places keep their order and their first corner, and so do
/// the points; new ones follow.
TriangleMesh in_order_of(const TriangleMesh& before, TriangleMesh result);

}  // namespace clay::solid::inline repair
