#pragma once
// The seam of a union has needles and caps that float32 files cannot represent.

#include "claystack/core/result.hpp"
#include "claystack/export/solid.hpp"

#include <vector>

namespace clay::solid {

struct CuredMesh {
  TriangleMesh mesh;
  double max_move_mm = 0.0;  ///< maximum displacement of a surface point
};

/// Among the triangles that touch the seam (`on_seam`, for each point of a closed mesh): edges
/// shorter than `shortest_mm` are collapsed, and the longest edge of triangles lower than half of
/// that is flipped, unless that makes a non-manifold edge (link condition; Dey, Edelsbrunner, Guha
/// and Nekhayev, "Topology preserving edge contraction", 1999) or a fold. Other defects remain:
/// check the result. An error (`unsound`) for a mesh that is not manifold.
Result<CuredMesh> cure_seam(const TriangleMesh& mesh, const std::vector<bool>& on_seam,
                            double shortest_mm);

}  // namespace clay::solid
