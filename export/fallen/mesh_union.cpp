#include "export/fallen/mesh_union.hpp"

#include "core/cancel.hpp"
#include "export/solid/cgal_versions.hpp"
#include "export/solid/exact_point.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace clay::solid::inline fallen {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

SurfaceMesh exact_mesh(const TriangleMesh& mesh) {
  SurfaceMesh result;
  result.reserve(static_cast<SurfaceMesh::size_type>(mesh.points.size()),
                 static_cast<SurfaceMesh::size_type>(3 * mesh.triangles.size() / 2),
                 static_cast<SurfaceMesh::size_type>(mesh.triangles.size()));
  for (const glm::dvec3& p : mesh.points) result.add_vertex({p.x, p.y, p.z});
  using Vertex = SurfaceMesh::Vertex_index;
  for (const auto& [a, b, c] : mesh.triangles) {
    step_of_loop();
    if (!result.add_face(Vertex(a), Vertex(b), Vertex(c)).is_valid())
      throw std::logic_error("a solid that is no manifold");
  }
  return result;
}

TriangleMesh nearest_mesh(SurfaceMesh& mesh) {
  mesh.collect_garbage();
  TriangleMesh result;
  result.points.reserve(mesh.number_of_vertices());
  result.triangles.reserve(mesh.number_of_faces());
  for (const auto vertex : mesh.vertices()) {
    step_of_loop();
    result.points.push_back(cgal::doubles_of(mesh.point(vertex)));
  }
  for (const auto face : mesh.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t corner = 0;
    for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face)))
      corners.at(corner++) = vertex;
    result.triangles.push_back(corners);
  }
  return result;
}

bool before(const glm::dvec3& p, const glm::dvec3& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

/// CGAL calls it at every step: checks for cancellation.
struct Watch : pmp::Corefinement::Default_visitor<SurfaceMesh> {
  using Face = SurfaceMesh::Face_index;
  void progress_filtering_intersections(double) const { step_of_loop(); }
  void edge_face_intersections_step() const { step_of_loop(); }
  void intersection_of_coplanar_faces_step() const { step_of_loop(); }
  void triangulating_faces_step() const { step_of_loop(); }
  void after_face_copy(Face, const SurfaceMesh&, Face, SurfaceMesh&) { step_of_loop(); }
};

/// CGAL's order of intersections depends on memory addresses: sort points by coordinates, and
/// triangles by their points.
TriangleMesh in_order(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.points.size()), place(mesh.points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return before(mesh.points[a], mesh.points[b]);
  });
  TriangleMesh result;
  for (const std::uint32_t v : order) {
    place[v] = static_cast<std::uint32_t>(result.points.size());
    result.points.push_back(mesh.points[v]);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    std::array<std::uint32_t, 3> corners{place[a], place[b], place[c]};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.triangles.push_back(corners);
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

std::vector<bool> new_points(const TriangleMesh& result, const TriangleMesh& a,
                             const TriangleMesh& b) {
  std::vector<glm::dvec3> old = a.points;
  old.insert(old.end(), b.points.begin(), b.points.end());
  std::sort(old.begin(), old.end(), before);
  std::vector<bool> fresh;
  fresh.reserve(result.points.size());
  for (const glm::dvec3& p : result.points)
    fresh.push_back(!std::binary_search(old.begin(), old.end(), p, before));
  return fresh;
}

}  // namespace

Result<MeshUnion> unite(const TriangleMesh& a, const TriangleMesh& b) {
  CGAL::get_default_random() = CGAL::Random(0);  // its search for intersections uses it
  SurfaceMesh first = exact_mesh(a), second = exact_mesh(b), both, common;
  std::array<cgal::Optional<SurfaceMesh*>, 4> wanted;
  wanted[pmp::Corefinement::UNION] = &both;
  wanted[pmp::Corefinement::INTERSECTION] = &common;
  const auto done = pmp::corefine_and_compute_boolean_operations(
      first, second, wanted, CGAL::parameters::visitor(Watch()));
  if (!done[pmp::Corefinement::UNION] || !done[pmp::Corefinement::INTERSECTION])
    return failure(ErrorKind::unsound,
                   "expected two parts that share clay, a face or nothing, found that they touch "
                   "in an edge or a point");
  MeshUnion result;
  result.mesh = in_order(nearest_mesh(both));
  result.on_seam = new_points(result.mesh, a, b);
  result.overlap_mm3 = signed_volume(nearest_mesh(common));
  return result;
}

}  // namespace clay::solid::inline fallen
