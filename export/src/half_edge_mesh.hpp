#pragma once
// OpenMesh's half-edges, for meshes that are known to be manifold. Needs OpenMesh's headers: not
// for other headers to include.

#include "claystack/export/triangle_mesh.hpp"

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <stdexcept>
#include <string>
#include <vector>

namespace clay::solid {

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

/// Faces keep their numbers, vertices are numbered by first use. Points that no triangle uses stay
/// behind: CGAL's search for the topmost vertex starts from the first one, used or not, and takes
/// an unused one for outward.
inline HalfEdgeMesh half_edge_mesh(const TriangleMesh& mesh) {
  HalfEdgeMesh result;
  result.reserve(mesh.points.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  std::vector<OpenMesh::VertexHandle> handles(mesh.points.size());
  const auto handle = [&](std::uint32_t vertex) {
    const glm::dvec3& p = mesh.points[vertex];
    if (!handles[vertex].is_valid()) handles[vertex] = result.add_vertex({p.x, p.y, p.z});
    return handles[vertex];
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    // Arguments of a call would be evaluated in any order.
    const auto first = handle(a), second = handle(b), third = handle(c);
    result.add_face(first, second, third);
  }
  // OpenMesh leaves out what it takes for non-manifold without a word.
  if (result.n_faces() != mesh.triangles.size())
    throw std::logic_error("OpenMesh took " + std::to_string(result.n_faces()) + " of " +
                           std::to_string(mesh.triangles.size()) + " triangles");
  return result;
}

}  // namespace clay::solid
