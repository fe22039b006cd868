#include "claystack/export/solid.hpp"

#include "core/cancel.hpp"
#include "export/solid/edge_collapse.hpp"
#include "export/solid/half_edge_mesh.hpp"
#include "export/solid/mesh_topology.hpp"
#include "export/solid/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>

namespace clay::solid {
namespace {

bool is_finite(const TriangleMesh& mesh) {
  return std::all_of(mesh.points.begin(), mesh.points.end(), [](const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  });
}

bool is_closed_manifold(const TriangleMesh& mesh) {
  if (mesh.triangles.empty() || mesh.triangles.size() > kMaxTriangles || !is_finite(mesh))
    return false;
  if (indices_out_of_range(mesh.points.size(), mesh.triangles).found()) return false;
  const MeshTopology topology = topology_of(mesh.points.size(), mesh.triangles);
  return topology.closed() && topology.manifold() && topology.oriented() &&
         !topology.collapsed.found();
}

/// Relative to the middle, so that distance from the origin costs the quadrics no digits.
glm::dvec3 middle_of(const TriangleMesh& mesh) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& p : mesh.points) sum += p / static_cast<double>(mesh.points.size());
  return sum;
}

/// The remaining triangles, on the points of the source: half-edge meshes number vertices by first
/// use.
TriangleMesh remaining(const HalfEdgeMesh& mesh, const TriangleMesh& source) {
  std::vector<bool> seen(source.points.size(), false);
  std::vector<std::uint32_t> source_of;
  for (const Triangle& t : source.triangles)
    for (const std::uint32_t v : t) {
      if (seen[v]) continue;
      seen[v] = true;
      source_of.push_back(v);
    }
  TriangleMesh result{source.points, {}};
  for (const auto face : mesh.faces()) {
    if (mesh.status(face).deleted()) continue;
    Triangle& triangle = result.triangles.emplace_back();
    auto corner = mesh.cfv_iter(face);
    for (std::uint32_t& v : triangle) v = source_of[static_cast<std::size_t>((corner++)->idx())];
  }
  drop_unused_points(result);
  return result;
}

/// The share of the work that is the collapses; the rest is the distance.
constexpr double kCollapseShare = 0.8;

Result<DecimatedMesh> decimate_closed(const TriangleMesh& mesh, std::size_t max_triangles,
                                      const std::function<void(double)>& progress) {
  TriangleMesh centred = mesh;
  const glm::dvec3 middle = middle_of(mesh);
  for (glm::dvec3& p : centred.points) p -= middle;
  HalfEdgeMesh half_edges(half_edge_mesh(centred));
  centred = {};
  std::function<void(double)> collapsed;
  if (progress) collapsed = [&](double share) { progress(kCollapseShare * share); };
  collapse_edges(half_edges, max_triangles, collapsed);
  DecimatedMesh result{remaining(half_edges, mesh), 0.0};
  if (result.mesh.triangles.size() > max_triangles)
    return failure(ErrorKind::bad_input,
                   "expected a limit of at least " + std::to_string(result.mesh.triangles.size()) +
                       " triangles, below which no edge of this mesh may collapse, found " +
                       std::to_string(max_triangles));
  if (progress) progress(kCollapseShare);
  // The vertices of the result lie on the mesh: they are some of its vertices.
  result.max_error_mm = distance_to_surface(mesh.points, result.mesh);
  if (progress) progress(1.0);
  return result;
}

Result<DecimatedMesh> decimated(const TriangleMesh& sound_mesh, std::size_t max_triangles,
                                const std::function<void(double)>& progress) {
  if (max_triangles < kFewestTriangles)
    return failure(ErrorKind::bad_input, "expected a limit of at least 4 triangles, found " +
                                             std::to_string(max_triangles));
  if (!is_closed_manifold(sound_mesh))
    return failure(ErrorKind::unsound,
                   "expected a closed, consistently oriented manifold mesh to decimate, found "
                   "one that is not; repair it first");
  if (sound_mesh.triangles.size() <= max_triangles) return DecimatedMesh{sound_mesh, 0.0};
  return decimate_closed(sound_mesh, max_triangles, progress);
}

}  // namespace

Result<DecimatedMesh> decimate(const TriangleMesh& sound_mesh, std::size_t max_triangles,
                               const DecimateOptions& options) try {
  const CancelScope scope(options.cancelled ? &options.cancelled : CancelScope::current());
  return decimated(sound_mesh, max_triangles, options.progress);
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::io, "decimation stopped: not enough memory");
} catch (const std::exception& e) {
  return failure(ErrorKind::io, std::string("decimation failed: ") + e.what());
} catch (const Cancelled&) {
  // Without `cancelled`, an enclosing job decides the cancellation.
  if (!options.cancelled) throw;
  return failure(ErrorKind::io, "decimation stopped: cancelled");
}

}  // namespace clay::solid
