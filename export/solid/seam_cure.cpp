#include "export/solid/seam_cure.hpp"

#include "export/solid/half_edge_mesh.hpp"
#include "export/solid/mesh_topology.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

namespace clay::solid {
namespace {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using Corners = std::array<glm::dvec3, 3>;

// A safety limit: each pass shortens the work list.
constexpr int kMaxPasses = 20;
// Triangles may rotate by at most 60 degrees, except needles.
constexpr double kLeastCosine = 0.5;

glm::dvec3 normal_of(const Corners& t) { return glm::cross(t[1] - t[0], t[2] - t[0]); }

double longest_of(const Corners& t) {
  return std::max(
      {glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
}

/// The smallest of the three heights.
double height_of(const Corners& t) {
  const double longest = longest_of(t);
  return longest > 0.0 ? glm::length(normal_of(t)) / longest : 0.0;
}

bool same_side(const Corners& a, const Corners& b) {
  const glm::dvec3 m = normal_of(a), n = normal_of(b);
  return glm::dot(m, n) > kLeastCosine * glm::length(m) * glm::length(n);
}

class Cure {
 public:
  Cure(const TriangleMesh& mesh, const std::vector<bool>& on_seam, double shortest_mm)
      : on_seam_(on_seam), moved_(mesh.points.size(), 0.0), shortest_(shortest_mm) {
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    for (const glm::dvec3& p : mesh.points) mesh_.add_vertex({p.x, p.y, p.z});
    for (const auto& [a, b, c] : mesh.triangles) mesh_.add_face(vertex(a), vertex(b), vertex(c));
  }

  CuredMesh run() {
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      const bool collapsed = collapse_short_edges();
      if (!flip_caps() && !collapsed) break;
    }
    return {taken(), max_move_};
  }

 private:
  static VertexHandle vertex(std::uint32_t i) { return VertexHandle(static_cast<int>(i)); }
  static std::size_t number(VertexHandle v) { return static_cast<std::size_t>(v.idx()); }

  glm::dvec3 point(VertexHandle v) const {
    const auto& p = mesh_.point(v);
    return {p[0], p[1], p[2]};
  }
  double length(HalfedgeHandle h) const {
    return glm::distance(point(mesh_.from_vertex_handle(h)), point(mesh_.to_vertex_handle(h)));
  }
  /// The vertices from the start of `h` on.
  std::array<VertexHandle, 3> vertices(HalfedgeHandle h) const {
    return {mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h),
            mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h))};
  }
  Corners corners(HalfedgeHandle h) const {
    const auto [a, b, c] = vertices(h);
    return {point(a), point(b), point(c)};
  }
  bool on_seam(VertexHandle v) const { return on_seam_[number(v)]; }

  bool collapse_short_edges() {
    std::vector<std::pair<double, EdgeHandle>> edges;
    for (const EdgeHandle edge : mesh_.edges())
      if (collapsible(edge)) edges.emplace_back(length(mesh_.halfedge_handle(edge, 0)), edge);
    std::sort(edges.begin(), edges.end());
    bool any = false;
    for (const auto& [was, edge] : edges)
      if (!mesh_.status(edge).deleted() && collapsible(edge)) any = collapse(edge) || any;
    return any;
  }

  bool collapsible(EdgeHandle edge) const {
    const HalfedgeHandle h = mesh_.halfedge_handle(edge, 0);
    return length(h) < shortest_ &&
           (on_seam(mesh_.from_vertex_handle(h)) || on_seam(mesh_.to_vertex_handle(h)));
  }

  /// Keeps a point of the parts and removes one of the seam, if possible.
  bool collapse(EdgeHandle edge) {
    HalfedgeHandle h = mesh_.halfedge_handle(edge, 0);
    if (!on_seam(mesh_.from_vertex_handle(h))) h = mesh_.opposite_halfedge_handle(h);
    for (const HalfedgeHandle way : {h, mesh_.opposite_halfedge_handle(h)}) {
      if (!mesh_.is_collapse_ok(way) || is_tetrahedron(way) || !stays_unfolded(way)) continue;
      const std::size_t gone = number(mesh_.from_vertex_handle(way));
      const std::size_t kept = number(mesh_.to_vertex_handle(way));
      moved_[kept] = std::max(moved_[kept], moved_[gone] + length(way));
      max_move_ = std::max(max_move_, moved_[kept]);
      mesh_.collapse(way);
      return true;
    }
    return false;
  }

  /// Such a shell would end as two triangles back to back, which OpenMesh permits.
  bool is_tetrahedron(HalfedgeHandle h) const {
    return mesh_.valence(mesh_.from_vertex_handle(h)) == 3 &&
           mesh_.valence(mesh_.to_vertex_handle(h)) == 3 && mesh_.valence(vertices(h)[2]) == 3;
  }

  /// True if no triangle flips when the start of `way` moves to its end; needles must not become
  /// lower, because their normals are unreliable.
  bool stays_unfolded(HalfedgeHandle way) const {
    const VertexHandle gone = mesh_.from_vertex_handle(way), kept = mesh_.to_vertex_handle(way);
    for (auto h = mesh_.cvoh_begin(gone); h != mesh_.cvoh_end(gone); ++h) {
      const auto [a, b, c] = vertices(*h);
      if (b == kept || c == kept) continue;
      const Corners before{point(a), point(b), point(c)}, after{point(kept), point(b), point(c)};
      const bool needle = height_of(before) < 0.5 * shortest_;
      if (needle ? height_of(after) < height_of(before) : !same_side(before, after)) return false;
    }
    return true;
  }

  bool flip_caps() {
    bool any = false;
    for (const FaceHandle face : mesh_.faces())
      if (!mesh_.status(face).deleted()) any = flip_if_cap(face) || any;
    return any;
  }

  bool flip_if_cap(FaceHandle face) {
    HalfedgeHandle h = mesh_.halfedge_handle(face);
    const auto of_face = vertices(h);
    if (!on_seam(of_face[0]) && !on_seam(of_face[1]) && !on_seam(of_face[2])) return false;
    const double height = height_of(corners(h));
    if (height >= 0.5 * shortest_) return false;
    for (HalfedgeHandle side : {mesh_.next_halfedge_handle(h), mesh_.prev_halfedge_handle(h)})
      if (length(side) > length(h)) h = side;
    const HalfedgeHandle other = mesh_.opposite_halfedge_handle(h);
    const auto [a, b, c] = vertices(h);
    const VertexHandle d = vertices(other)[2];
    const Corners neighbour = corners(other);
    const Corners first{point(c), point(a), point(d)}, second{point(d), point(b), point(c)};
    const double before = std::min(height, height_of(neighbour));
    if (std::min(height_of(first), height_of(second)) <= before) return false;
    const bool flat = height_of(neighbour) < 0.5 * shortest_;
    if (!flat && (!same_side(neighbour, first) || !same_side(neighbour, second))) return false;
    const EdgeHandle edge = mesh_.edge_handle(h);
    if (!mesh_.is_flip_ok(edge)) return false;
    max_move_ = std::max(max_move_, height + moved_[number(c)]);
    mesh_.flip(edge);
    return true;
  }

  TriangleMesh taken() {
    mesh_.garbage_collection();
    TriangleMesh result;
    for (const VertexHandle v : mesh_.vertices()) result.points.push_back(point(v));
    for (const FaceHandle face : mesh_.faces()) {
      const auto [a, b, c] = vertices(mesh_.halfedge_handle(face));
      result.triangles.push_back({static_cast<std::uint32_t>(a.idx()),
                                  static_cast<std::uint32_t>(b.idx()),
                                  static_cast<std::uint32_t>(c.idx())});
    }
    return result;
  }

  HalfEdgeMesh mesh_;
  const std::vector<bool>& on_seam_;
  std::vector<double> moved_;
  double shortest_;
  double max_move_ = 0.0;
};

}  // namespace

Result<CuredMesh> cure_seam(const TriangleMesh& mesh, const std::vector<bool>& on_seam,
                            double shortest_mm) {
  const MeshTopology topology = topology_of(mesh.points.size(), mesh.triangles);
  if (!topology.closed() || !topology.manifold() || !topology.oriented())
    return failure(ErrorKind::unsound,
                   "expected parts that share a seam of closed curves, found "
                   "that it branches or ends");
  return Cure(mesh, on_seam, shortest_mm).run();
}

}  // namespace clay::solid
