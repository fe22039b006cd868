#pragma once
// Boolean operations between two solids, with exact constructions.

#include "claystack/core/result.hpp"
#include "claystack/export/solid.hpp"

#include <vector>

namespace clay::solid::inline fallen {

struct MeshUnion {
  TriangleMesh mesh;          ///< the exact points, rounded to the nearest double
  std::vector<bool> on_seam;  ///< for each point: true if it belongs to neither solid
  double overlap_mm3 = 0.0;   ///< of the intersection, summed over its surface
};

/// Requires that both bound a volume and do not intersect themselves. Solids that touch in whole
/// faces become one; an error (`unsound`) if they touch only in an edge or a point.
Result<MeshUnion> unite(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace clay::solid::inline fallen
