#include "claystack/export/repair.hpp"

#include "claystack/export/proof.hpp"
#include "export/repair/soup_repair.hpp"
#include "export/solid/mesh_topology.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <algorithm>
#include <exception>
#include <iterator>

namespace clay::solid::inline repair {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Face = Surface::Face_index;
using Corners = std::array<Point, 3>;

Corners corners_of(const Surface& surface, Face face) {
  const auto h = surface.halfedge(face);
  return {surface.point(surface.source(h)), surface.point(surface.target(h)),
          surface.point(surface.target(surface.next(h)))};
}

/// The same three distinct corners in opposite orientation.
bool turned(const Corners& before, const Corners& after) {
  const auto first = std::find(after.begin(), after.end(), before[0]) - after.begin();
  return after[static_cast<std::size_t>(first + 1) % 3] != before[1];
}

struct Shells {
  explicit Shells(const Surface& surface)
      : of_face(surface.number_of_faces()),
        count(pmp::connected_components(
            surface,
            boost::make_iterator_property_map(of_face.begin(), get(boost::face_index, surface)))) {}
  std::vector<std::size_t> of_face;
  std::size_t count;
};

/// Half-edges for a clean soup with consistent orientation; each shell keeps the orientation of
/// most of its triangles.
class HalfEdgeRepair {
 public:
  HalfEdgeRepair(const TriangleMesh& soup, std::vector<Repair>& repaired) : repaired_(repaired) {
    for (const glm::dvec3& p : soup.points) points_.emplace_back(p.x, p.y, p.z);
    triangles_ = soup.triangles;
  }

  Result<TriangleMesh> run() {
    note_touching();
    if (!make_surface()) return failure(ErrorKind::unsound, "repair failed: no surface found");
    pmp::stitch_borders(surface_, CGAL::parameters::apply_per_connected_component(true));
    pmp::stitch_borders(surface_);
    pmp::duplicate_non_manifold_vertices(surface_);
    drop_degenerate();
    drop_lone_triangles();
    fill_holes();
    surface_.collect_garbage();
    turn_shells();
    return mesh();
  }

 private:
  void note_touching() {
    const MeshTopology topology = topology_of(points_.size(), triangles_);
    note_repair(repaired_, "non-manifold edge cut apart", topology.crowded_edges.count);
    note_repair(repaired_, "non-manifold vertex split", topology.split_vertices.count);
  }

  bool make_surface() {
    std::vector<Corners> before;
    before.reserve(triangles_.size());
    for (const auto& [a, b, c] : triangles_) before.push_back({points_[a], points_[b], points_[c]});
    pmp::orient_polygon_soup(points_, triangles_);
    // Half-edges of any other soup would have invalid indices.
    if (!pmp::is_polygon_soup_a_polygon_mesh(triangles_)) return false;
    pmp::polygon_soup_to_polygon_mesh(points_, triangles_, surface_);
    turn_back(before);
    return true;
  }

  void turn_back(const std::vector<Corners>& before) {
    const Shells shells(surface_);
    std::vector<std::size_t> sizes(shells.count, 0), turns(shells.count, 0);
    for (const Face face : surface_.faces()) {
      ++sizes[shells.of_face[face]];
      if (turned(before[face], corners_of(surface_, face))) ++turns[shells.of_face[face]];
    }
    std::vector<Face> back;
    for (const Face face : surface_.faces()) {
      const std::size_t shell = shells.of_face[face];
      if (2 * turns[shell] > sizes[shell]) back.push_back(face);
    }
    pmp::reverse_face_orientations(back, surface_);
    std::size_t count = 0;
    for (std::size_t shell = 0; shell < shells.count; ++shell)
      count += std::min(turns[shell], sizes[shell] - turns[shell]);
    note_repair(repaired_, "triangle turned", count);
  }

  /// A single triangle encloses nothing, even with a back face.
  void drop_lone_triangles() {
    std::vector<Face> lone;
    for (const Face face : surface_.faces()) {
      const auto around = surface_.halfedges_around_face(surface_.halfedge(face));
      if (std::all_of(around.begin(), around.end(),
                      [&](const auto h) { return surface_.is_border(surface_.opposite(h)); }))
        lone.push_back(face);
    }
    for (const Face face : lone) CGAL::Euler::remove_face(surface_.halfedge(face), surface_);
    note_repair(repaired_, "lone triangle removed", lone.size());
  }

  std::size_t degenerate_count() const {
    return static_cast<std::size_t>(std::count_if(
        surface_.faces_begin(), surface_.faces_end(),
        [&](const Face face) { return pmp::is_degenerate_triangle_face(face, surface_); }));
  }

  void drop_degenerate() {
    const std::size_t before = degenerate_count();
    if (before == 0) return;
    pmp::remove_degenerate_faces(surface_);
    pmp::duplicate_non_manifold_vertices(surface_);
    const std::size_t after = degenerate_count();
    note_repair(repaired_, "triangle without area removed", before - std::min(before, after));
  }

  void fill_holes() {
    std::vector<Surface::Halfedge_index> holes;
    pmp::extract_boundary_cycles(surface_, std::back_inserter(holes));
    std::size_t filled = 0;
    for (const auto hole : holes) {
      const auto border = surface_.halfedges_around_face(hole);
      const auto edges = static_cast<std::size_t>(std::distance(border.begin(), border.end()));
      if (edges > kMaxHoleEdges) continue;
      constexpr std::size_t kMostForCubicSearch = 200;
      std::vector<Face> patch;
      pmp::triangulate_hole(surface_, hole, std::back_inserter(patch),
                            CGAL::parameters::use_2d_constrained_delaunay_triangulation(true)
                                .do_not_use_cubic_algorithm(edges > kMostForCubicSearch));
      filled += patch.empty() ? 0 : 1;
    }
    note_repair(repaired_, "hole filled", filled);
  }

  /// Only a closed surface has an inside.
  void turn_shells() {
    if (surface_.is_empty() || !CGAL::is_closed(surface_)) return;
    const Shells shells(surface_);
    std::vector<Face> first(shells.count, Surface::null_face());
    for (const Face face : surface_.faces())
      if (Face& of_shell = first[shells.of_face[face]]; of_shell == Surface::null_face())
        of_shell = face;
    std::vector<Corners> before;
    for (const Face face : first) before.push_back(corners_of(surface_, face));
    if (degenerate_count() == 0 && !pmp::does_self_intersect(surface_))
      pmp::orient_to_bound_a_volume(surface_);
    else if (pmp::volume(surface_) < 0.0)
      pmp::reverse_face_orientations(surface_);
    std::size_t count = 0;
    for (std::size_t shell = 0; shell < shells.count; ++shell)
      count += turned(before[shell], corners_of(surface_, first[shell])) ? 1 : 0;
    note_repair(repaired_, "shell turned", count);
  }

  TriangleMesh mesh() const {
    TriangleMesh result;
    for (const auto v : surface_.vertices()) {
      const Point& p = surface_.point(v);
      result.points.emplace_back(p.x(), p.y(), p.z());
    }
    for (const Face face : surface_.faces()) {
      const auto h = surface_.halfedge(face);
      result.triangles.push_back(
          {surface_.source(h), surface_.target(h), surface_.target(surface_.next(h))});
    }
    return result;
  }

  std::vector<Point> points_;
  std::vector<Triangle> triangles_;
  Surface surface_;
  std::vector<Repair>& repaired_;
};

Result<RepairedMesh> repair_unsound(const TriangleMesh& mesh) {
  RepairedMesh result;
  TriangleMesh soup = mesh;
  clean_soup(soup, result.repaired);
  if (soup.triangles.empty())
    return failure(ErrorKind::unsound, "repair leaves nothing: no triangle is part of a surface");
  auto repaired = HalfEdgeRepair(soup, result.repaired).run();
  if (!repaired) return tl::make_unexpected(repaired.error());
  if (repaired->triangles.empty())
    return failure(ErrorKind::unsound, "repair leaves nothing: no triangle is part of a surface");
  result.mesh = std::move(*repaired);
  return result;
}

}  // namespace

Result<RepairedMesh> repair_mesh(const TriangleMesh& mesh) try {
  if (check_mesh(mesh).sound()) return RepairedMesh{mesh, {}};
  if (mesh.triangles.empty() || mesh.triangles.size() > kMaxTriangles)
    return failure(ErrorKind::unsound, "expected 1 to " + std::to_string(kMaxTriangles) +
                                           " triangles to repair, found " +
                                           std::to_string(mesh.triangles.size()));
  return repair_unsound(mesh);
} catch (const std::exception& e) {
  return failure(ErrorKind::unsound, std::string("repair failed: ") + e.what());
}

}  // namespace clay::solid::inline repair
