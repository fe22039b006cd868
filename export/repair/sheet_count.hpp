#pragma once
#include "export/solid/mesh_topology.hpp"

#include <vector>

namespace clay::solid::inline repair {

struct SheetCount {
  std::vector<Triangle> triangles;  ///< no two on the same vertices, in the order of the first
  /// By triangle, at least 1: number of triangles in its direction, minus those in the opposite
  /// one.
  std::vector<int> sheets;
};

/// Adds up triangles on the same vertices by direction; those that cancel are left out, and those
/// without area too. Requires finite points and indices in range.
SheetCount count_sheets(const TriangleMesh& mesh);

}  // namespace clay::solid::inline repair
