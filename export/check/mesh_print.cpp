#include "claystack/export/check.hpp"

#include "core/compensated_sum.hpp"
#include "export/solid/mesh_topology.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

namespace clay::solid::inline check {
namespace {

/// A shell turned inward is a cavity, or no clay at all.
bool all_outward(const TriangleMesh& mesh, const MeshTopology& topology) {
  std::vector<CompensatedSum> six_volumes(mesh.triangles.size());
  const glm::dvec3 origin = mesh.points[mesh.triangles.front()[0]];
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const std::size_t shell = topology.components > 1 ? topology.component_of[t] : 0;
    six_volumes[shell].add(glm::dot(mesh.points[a] - origin,
                                    glm::cross(mesh.points[b] - origin, mesh.points[c] - origin)));
  }
  return std::ranges::none_of(six_volumes,
                              [](const CompensatedSum& six) { return six.value() < 0.0; });
}

}  // namespace

bool slicer_unites(const TriangleMesh& mesh, const MeshReport& report) {
  // The volume is positive only if every point was finite and every index in range.
  if (!report.closed || !report.oriented || !(report.volume_mm3 > 0.0) ||
      report.self_intersections > kMostUnitedPairs)
    return false;
  const MeshTopology topology = topology_of(mesh.points.size(), mesh.triangles);
  return !topology.crowded_edges.found() && !topology.duplicates.found() &&
         all_outward(mesh, topology);
}

}  // namespace clay::solid::inline check
