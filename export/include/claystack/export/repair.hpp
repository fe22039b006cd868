#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/solid.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace clay::solid::inline repair {

// ---- mesh repair ---------------------------------------------------------------------
// Repairs of foreign meshes.

/// One kind of repair, and how often it was made.
struct Repair {
  std::string what;  ///< "hole filled", "shell turned", ...
  std::size_t count = 0;
};

struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<Repair> repaired;  ///< in the order of the work; empty for a sound mesh
};

/// Repairs defects that have one sensible answer; only vertices of cracks are moved:
/// - triangles with an index out of range, a point that is not finite, or zero area;
/// - duplicate points; border points within 4 units in the last place of float32 at the largest
///   coordinate (cracks); triangles on the same vertices, of which one is kept, or none where two
///   lie back to back;
/// - open sheets on an edge of three triangles (fins); edges and vertices where surfaces touch;
/// - triangles oriented against their neighbours, holes of up to kMaxHoleEdges edges, and shells
///   oriented against those that enclose them.
/// Intersecting or touching surfaces are left, because the intent is unknown; check_mesh reports
/// what remains. A sound mesh is returned unchanged. Deterministic. Soup and holes use CGAL's
/// Polygon Mesh Processing. Error (kind `unsound`): nothing is left to repair, or the library
/// failed.
Result<RepairedMesh> repair_mesh(const TriangleMesh& mesh);

/// The longest border of a hole that is filled: above it, the search for a patch takes too long.
inline constexpr std::size_t kMaxHoleEdges = 10'000;

}  // namespace clay::solid::inline repair
