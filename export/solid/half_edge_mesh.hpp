#pragma once
// OpenMesh's half-edges, for meshes that are known to be manifold. Needs OpenMesh's headers: not
// for other headers to include.

#include "claystack/export/solid.hpp"

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>

namespace clay::solid {

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

/// Faces keep their numbers, vertices are numbered by first use, edges too. Points that no triangle
/// uses stay behind: CGAL's search for the topmost vertex starts from the first one, used or not,
/// and takes an unused one for outward.
///
/// O(n log n) whatever the degrees: OpenMesh's own add_face looks through all edges of a vertex for
/// each of its faces. Throws std::logic_error at an edge whose faces are more than two or run along
/// it the same way, and at a vertex of two borders.
HalfEdgeMesh half_edge_mesh(const TriangleMesh& mesh);

}  // namespace clay::solid
