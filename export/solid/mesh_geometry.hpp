#pragma once
// How the shells of a mesh lie, by exact predicates (CGAL).

#include "export/solid/mesh_topology.hpp"

#include <cstddef>

namespace clay::solid {

struct ShellGeometry {
  bool outward = false;    ///< the outermost shell's normals point away from what it encloses
  Fault misplaced_shells;  ///< turned against the shells around or beside them
  bool bounds_volume = false;
  std::size_t steps = 0;  ///< of the search: boxes and triangles looked at
};

/// For meshes that are closed, manifold and consistently oriented, cross themselves nowhere and
/// have no degenerate triangle.
///
/// One ray for each shell, upward from its top to the first triangle of another shell: the two
/// bound the same region. Through a tree of all triangles, that takes O(log n) a shell where boxes
/// say something.
ShellGeometry shell_geometry(const TriangleMesh& mesh, const MeshTopology& topology);

}  // namespace clay::solid
