#pragma once
// Fewer triangles for meshes that have no profile to make them from again.

#include "claystack/engine/result.hpp"
#include "claystack/export/triangle_mesh.hpp"

#include <cstddef>

namespace clay::solid {

struct DecimatedMesh {
  TriangleMesh mesh;  ///< on points of the mesh that came in
  /// The largest distance from a vertex of either mesh to the surface of the other: measured, but
  /// at the vertices only. Between them surfaces may lie farther apart.
  double max_error_mm = 0.0;
};

inline constexpr std::size_t kFewestTriangles = 4;

/// At most `max_triangles`, by collapsing edges in the order of OpenMesh's error quadrics (Garland,
/// Heckbert, "Surface simplification using quadric error metrics"), none of which may turn a face
/// over. A mesh within the limit comes back as it is. Nothing keeps walls from meeting: check what
/// comes out. Errors of kind `unsound`: the mesh is no closed manifold with neighbours agreeing,
/// or no further edge may collapse (how far it came is said); `bad_input`: a limit below 4.
Result<DecimatedMesh> decimate(const TriangleMesh& sound_mesh, std::size_t max_triangles);

}  // namespace clay::solid
