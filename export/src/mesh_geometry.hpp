#pragma once
// What the points of a mesh say, by exact predicates (CGAL). Points are finite, indices in range.

#include "mesh_topology.hpp"

namespace clay::solid {

/// Counting stops here: a mesh in such a state is a lost one.
inline constexpr std::size_t kMaxSelfIntersections = 100'000;

/// Triangles whose corners lie in line.
Fault degenerate_triangles(const TriangleMesh& mesh);

/// Pairs of triangles that meet elsewhere than in the vertices or the edge they share. Takes any
/// soup; triangles with corners in line, and pairs on the same three vertices, are passed over.
Fault soup_self_intersections(const TriangleMesh& mesh);

struct ShellGeometry {
  Fault self_intersections;
  /// The rest only where the mesh is closed, crosses itself nowhere and has no degenerate triangle.
  bool outward = false;    ///< the outermost shell's normals point away from what it encloses
  Fault misplaced_shells;  ///< turned against the shells around or beside them
  bool bounds_volume = false;
};

/// For meshes whose indices are manifold and consistently oriented.
ShellGeometry shell_geometry(const TriangleMesh& mesh, bool closed, bool degenerate);

}  // namespace clay::solid
