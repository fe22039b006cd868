#pragma once
// OpenMesh half-edges for meshes known to be manifold. Requires OpenMesh's headers: do not include
// this in other headers.

#include "claystack/export/solid.hpp"

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace clay::solid {

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

/// Faces keep their numbers; vertices and edges are numbered by first use. Unused points are
/// dropped: CGAL's search for the topmost vertex starts from the first one, used or not, and treats
/// an unused one as outward.
///
/// O(n log n) for any degrees; OpenMesh's add_face searches all edges of a vertex for each of its
/// faces. Throws std::logic_error at an edge with more than two faces or with two faces of the same
/// direction, and at a vertex of two borders.
HalfEdgeMesh half_edge_mesh(const TriangleMesh& mesh);

}  // namespace clay::solid
