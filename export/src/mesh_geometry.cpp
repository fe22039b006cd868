#include "mesh_geometry.hpp"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>
#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <algorithm>
#include <boost/property_map/vector_property_map.hpp>
#include <functional>
#include <stdexcept>
#include <vector>

namespace clay::solid {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using Face = boost::graph_traits<HalfEdgeMesh>::face_descriptor;

std::uint32_t number(Face face) { return static_cast<std::uint32_t>(face.idx()); }

/// Faces keep their numbers. Points that no triangle uses stay behind: CGAL's search for the
/// topmost vertex starts from the first one, used or not, and takes an unused one for outward.
HalfEdgeMesh half_edge_mesh(const TriangleMesh& mesh) {
  HalfEdgeMesh result;
  result.reserve(mesh.points.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  std::vector<OpenMesh::VertexHandle> handles(mesh.points.size());
  const auto handle = [&](std::uint32_t vertex) {
    const glm::dvec3& p = mesh.points[vertex];
    if (!handles[vertex].is_valid()) handles[vertex] = result.add_vertex({p.x, p.y, p.z});
    return handles[vertex];
  };
  for (const auto& [a, b, c] : mesh.triangles) result.add_face(handle(a), handle(b), handle(c));
  // OpenMesh leaves out what it takes for non-manifold without a word.
  if (result.n_faces() != mesh.triangles.size())
    throw std::logic_error("OpenMesh took " + std::to_string(result.n_faces()) + " of " +
                           std::to_string(mesh.triangles.size()) + " triangles");
  return result;
}

Fault misplaced_shells(const HalfEdgeMesh& mesh) {
  boost::vector_property_map<std::size_t,
                             boost::property_map<HalfEdgeMesh, boost::face_index_t>::const_type>
      volume_of_face(get(boost::face_index, mesh));
  std::vector<pmp::Volume_error_code> verdicts;
  pmp::volume_connected_components(
      mesh, volume_of_face,
      CGAL::parameters::do_orientation_tests(true).error_codes(std::ref(verdicts)));
  Fault fault;
  std::vector<bool> seen(verdicts.size(), false);
  for (const Face face : faces(mesh)) {
    const std::size_t volume = get(volume_of_face, face);
    if (verdicts[volume] == pmp::VALID_VOLUME || seen[volume]) continue;
    seen[volume] = true;
    note(fault, {number(face)}, {});
  }
  return fault;
}

}  // namespace

ShellGeometry shell_geometry(const TriangleMesh& mesh) {
  const HalfEdgeMesh shells = half_edge_mesh(mesh);
  ShellGeometry geometry;
  geometry.outward = pmp::is_outward_oriented(shells);
  geometry.bounds_volume = pmp::does_bound_a_volume(shells);
  if (!geometry.bounds_volume) geometry.misplaced_shells = misplaced_shells(shells);
  return geometry;
}

}  // namespace clay::solid
