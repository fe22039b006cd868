#include "claystack/export/check.hpp"

#include "export/solid/mesh_topology.hpp"
#include "export/solid/shell_volumes.hpp"

#include <algorithm>
#include <vector>

namespace clay::solid::inline check {
namespace {

/// A shell turned inward is a cavity, or no clay at all.
bool all_outward(const TriangleMesh& mesh, const MeshTopology& topology) {
  const auto volumes_mm3 =
      volumes_of_shells(mesh, mesh.triangles.size(), [&](std::size_t t) -> std::size_t {
        return topology.components > 1 ? topology.component_of[t] : 0;
      });
  return std::ranges::none_of(volumes_mm3, [](double mm3) { return mm3 < 0.0; });
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
