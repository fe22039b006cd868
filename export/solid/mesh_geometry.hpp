#pragma once
// The nesting of the shells of a mesh, by exact predicates (CGAL).

#include "export/solid/mesh_topology.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace clay::solid {

struct ShellGeometry {
  bool outward = false;      ///< the outermost shell's normals point outward
  Fault misplaced_shells;    ///< oriented against the shells around or beside them
  bool only_filled = false;  ///< each of those faces outward and lies in the clay of another
  bool bounds_volume = false;
  std::vector<std::uint32_t> enclosed;  ///< the first triangles of the shells that lie in others
  std::size_t steps = 0;                ///< visited boxes and triangles
};

/// Requires a closed, manifold, consistently oriented mesh without self-intersections and
/// degenerate triangles.
///
/// One ray per shell, upward from its top to the first triangle of another shell: both bound the
/// same region. With a tree of all triangles this takes O(log n) per shell where boxes separate
/// them.
ShellGeometry shell_geometry(const TriangleMesh& mesh, const MeshTopology& topology);

}  // namespace clay::solid
