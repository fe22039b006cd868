#pragma once
// How the shells of a mesh lie, by exact predicates (CGAL).

#include "mesh_topology.hpp"

namespace clay::solid {

struct ShellGeometry {
  bool outward = false;    ///< the outermost shell's normals point away from what it encloses
  Fault misplaced_shells;  ///< turned against the shells around or beside them
  bool bounds_volume = false;
};

/// For meshes that are closed, manifold and consistently oriented, cross themselves nowhere and
/// have no degenerate triangle.
ShellGeometry shell_geometry(const TriangleMesh& mesh);

}  // namespace clay::solid
