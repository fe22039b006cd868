#include "claystack/export/solid.hpp"

#include "core/cancel.hpp"
#include "export/solid/half_edge_mesh.hpp"
#include "export/solid/mesh_topology.hpp"
#include "export/solid/surface_distance.hpp"

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace clay::solid {
namespace {

namespace om = OpenMesh::Decimater;

/// A closed mesh. OpenMesh's own test of a collapse marks all neighbours first; here, most of the
/// time of a decimation goes into that test.
class ClosedMesh : public HalfEdgeMesh {
 public:
  explicit ClosedMesh(HalfEdgeMesh mesh) : HalfEdgeMesh(std::move(mesh)) {}

  /// Hides that of OpenMesh: the decimater is a template on the mesh. The ends of the edge have no
  /// common neighbours but the tips of its two triangles, which differ.
  [[nodiscard]] bool is_collapse_ok(OpenMesh::HalfedgeHandle way) const {
    const OpenMesh::HalfedgeHandle back = opposite_halfedge_handle(way);
    const OpenMesh::VertexHandle gone = from_vertex_handle(way), kept = to_vertex_handle(way);
    if (status(edge_handle(way)).deleted() || status(gone).deleted() || status(kept).deleted())
      return false;
    const OpenMesh::VertexHandle left = to_vertex_handle(next_halfedge_handle(way));
    const OpenMesh::VertexHandle right = to_vertex_handle(next_halfedge_handle(back));
    if (left == right) return false;
    for (auto a = cvv_begin(gone); a != cvv_end(gone); ++a) {
      if (*a == kept || *a == left || *a == right) continue;
      for (auto b = cvv_begin(kept); b != cvv_end(kept); ++b)
        if (*a == *b) return false;
    }
    return true;
  }
};

/// Rounding makes some errors of flat places negative, which OpenMesh treats as forbidden.
class Quadric : public om::ModQuadricT<ClosedMesh> {
 public:
  using Self = Quadric;
  using Handle = om::ModHandleT<Quadric>;
  explicit Quadric(ClosedMesh& mesh) : om::ModQuadricT<ClosedMesh>(mesh) {}

  float collapse_priority(const CollapseInfo& collapse) override {
    step_of_loop();
    return std::max(om::ModQuadricT<ClosedMesh>::collapse_priority(collapse), 0.0F);
  }
};

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

void collapse_edges(ClosedMesh& mesh, std::size_t max_triangles) {
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  mesh.request_face_normals();
  mesh.update_face_normals();
  om::DecimaterT<ClosedMesh> decimater(mesh);
  Quadric::Handle quadric;
  om::ModNormalFlippingT<ClosedMesh>::Handle flipping;
  decimater.add(quadric);
  decimater.add(flipping);
  decimater.initialize();
  decimater.decimate_to_faces(0, max_triangles);
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

Result<DecimatedMesh> decimate_closed(const TriangleMesh& mesh, std::size_t max_triangles) {
  TriangleMesh centred = mesh;
  const glm::dvec3 middle = middle_of(mesh);
  for (glm::dvec3& p : centred.points) p -= middle;
  ClosedMesh half_edges(half_edge_mesh(centred));
  centred = {};
  collapse_edges(half_edges, max_triangles);
  DecimatedMesh result{remaining(half_edges, mesh), 0.0};
  if (result.mesh.triangles.size() > max_triangles)
    return failure(ErrorKind::unsound, "expected at most " + std::to_string(max_triangles) +
                                           " triangles, found no edge that may collapse below " +
                                           std::to_string(result.mesh.triangles.size()));
  result.max_error_mm = surface_distance(mesh, result.mesh);
  return result;
}

}  // namespace

Result<DecimatedMesh> decimate(const TriangleMesh& sound_mesh, std::size_t max_triangles) try {
  if (max_triangles < kFewestTriangles)
    return failure(ErrorKind::bad_input, "expected a limit of at least 4 triangles, found " +
                                             std::to_string(max_triangles));
  if (!is_closed_manifold(sound_mesh))
    return failure(ErrorKind::unsound,
                   "expected a closed manifold with neighbours agreeing, to have fewer triangles; "
                   "found one that is not");
  if (sound_mesh.triangles.size() <= max_triangles) return DecimatedMesh{sound_mesh, 0.0};
  return decimate_closed(sound_mesh, max_triangles);
} catch (const std::exception& e) {
  return failure(ErrorKind::unsound, std::string("decimation failed: ") + e.what());
}

}  // namespace clay::solid
