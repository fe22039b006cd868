#pragma once
// The seam of a union has needles and caps that no file's float32 can tell from a line.

#include "claystack/core/result.hpp"
#include "claystack/export/solid.hpp"

#include <vector>

namespace clay::solid::inline fallen {

struct CuredMesh {
  TriangleMesh mesh;
  double max_move_mm = 0.0;  ///< no point of the surface moved farther
};

/// Among the triangles that touch the seam (`on_seam`, for each point of a closed mesh): edges
/// shorter than `shortest_mm` are pulled together, and triangles lower than half of that give
/// their longest edge to their neighbour, as long as that is possible without a non-manifold edge
/// (link condition; Dey, Edelsbrunner, Guha and Nekhayev, "Topology preserving edge contraction",
/// 1999) and without a fold. What cannot be helped so stays: check the result.
/// An error (`unsound`) for a mesh that is no manifold.
Result<CuredMesh> cure_seam(const TriangleMesh& mesh, const std::vector<bool>& on_seam,
                            double shortest_mm);

}  // namespace clay::solid::inline fallen
