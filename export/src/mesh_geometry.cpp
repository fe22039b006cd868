#include "mesh_geometry.hpp"

#include "half_edge_mesh.hpp"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>
#include <algorithm>
#include <boost/property_map/vector_property_map.hpp>
#include <functional>
#include <vector>

namespace clay::solid {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Face = boost::graph_traits<HalfEdgeMesh>::face_descriptor;

std::uint32_t number(Face face) { return static_cast<std::uint32_t>(face.idx()); }

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
