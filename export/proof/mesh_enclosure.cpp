#include "claystack/export/proof.hpp"

#include "export/solid/mesh_topology.hpp"

namespace clay::solid::inline proof {
namespace {

glm::dvec3 middle_of(const TriangleMesh& mesh, const Fault& edge) {
  if (!edge.found()) return glm::dvec3(0.0);
  return 0.5 * (mesh.points[edge.vertices[0]] + mesh.points[edge.vertices[1]]);
}

}  // namespace

MeshEnclosure enclosure_of(const TriangleMesh& mesh) {
  const MeshTopology topology = topology_of(mesh.points.size(), mesh.triangles);
  MeshEnclosure result{topology.open_edges.count,
                       topology.flipped_edges.count,
                       middle_of(mesh, topology.open_edges),
                       middle_of(mesh, topology.flipped_edges),
                       {}};
  if (topology.balanced) result.volume_mm3 = signed_volume(mesh);
  return result;
}

}  // namespace clay::solid::inline proof
