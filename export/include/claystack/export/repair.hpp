#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/solid.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace clay::solid::inline repair {

// ---- mesh repair ---------------------------------------------------------------------
// Repairs of foreign meshes.

/// One kind of repair that was made, and how often.
struct Repair {
  std::string what;  ///< "hole filled", "shell turned", ...
  std::size_t count = 0;
};

struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<Repair> repaired;  ///< in the order of the work; empty for a mesh that was sound
};

/// Mends what has one sensible answer, with no vertex moved but those of cracks:
///  - triangles with an index out of range, a point that is no number or no area;
///  - points of one place; border points within 4 units in the last place of float32 at the
///    largest coordinate (cracks); triangles on the same vertices, of which one is kept, or none
///    where two lie back to back;
///  - open sheets on an edge of three triangles (fins); edges and vertices where surfaces touch;
///  - triangles turned against their neighbours, holes of up to kMaxHoleEdges edges, and shells
///    turned against what they enclose or lie in.
/// Surfaces that cross or touch are left: there is no telling what was meant. What remains is for
/// check_mesh to say. A sound mesh comes back as it is. The same mesh gives the same repair.
/// Soup and holes by CGAL's Polygon Mesh Processing. Error (kind `unsound`): nothing is left to
/// repair, or the library gave up.
Result<RepairedMesh> repair_mesh(const TriangleMesh& mesh);

/// Border of the largest hole that is filled: beyond, the search for a patch takes too long.
inline constexpr std::size_t kMaxHoleEdges = 10'000;

}  // namespace clay::solid::inline repair
