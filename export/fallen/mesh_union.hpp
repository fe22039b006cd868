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

/// Both bound a volume and cross themselves nowhere. Solids that touch in whole faces become one;
/// an error (`unsound`) where they touch in an edge or a point only, which no manifold can show.
Result<MeshUnion> unite(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace clay::solid::inline fallen
