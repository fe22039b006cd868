#include "export/repair/surface_making.hpp"

#include "export/repair/border_joining.hpp"
#include "export/repair/soup_repair.hpp"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <algorithm>

namespace clay::solid::inline repair {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Face = Surface::Face_index;
using FacePoints = std::array<SurfacePoint, 3>;

FacePoints points_of(const Surface& surface, Face face) {
  const auto h = surface.halfedge(face);
  return {surface.point(surface.source(h)), surface.point(surface.target(h)),
          surface.point(surface.target(surface.next(h)))};
}

/// The same three distinct corners in opposite orientation.
bool turned(const FacePoints& before, const FacePoints& after) {
  const auto first = std::find(after.begin(), after.end(), before[0]) - after.begin();
  return after[static_cast<std::size_t>(first + 1) % 3] != before[1];
}

class Making {
 public:
  Making(const TriangleMesh& soup, std::vector<Repair>& repaired) : repaired_(repaired) {
    for (const glm::dvec3& p : soup.points) points_.emplace_back(p.x, p.y, p.z);
    triangles_ = soup.triangles;
  }

  Result<Surface> run() {
    note_cut_edges();
    if (!orient()) return failure(ErrorKind::unsound, "repair failed: no surface found");
    pmp::stitch_borders(surface_, CGAL::parameters::apply_per_connected_component(true));
    pmp::stitch_borders(surface_);
    pmp::duplicate_non_manifold_vertices(surface_);
    drop_degenerate();
    drop_lone_triangles();
    note_split(join_borders(surface_));
    surface_.collect_garbage();
    return std::move(surface_);
  }

 private:
  void note_cut_edges() {
    const MeshTopology topology = topology_of(points_.size(), triangles_);
    note_repair(repaired_, "non-manifold edge cut apart", topology.crowded_edges.count);
    touching_vertices_ = topology.split_vertices.count;
  }

  /// Of the vertices where sheets touch, those that were joined again are parts of one sheet.
  void note_split(std::size_t joined) {
    note_repair(repaired_, "non-manifold vertex split",
                touching_vertices_ - std::min(joined, touching_vertices_));
  }

  bool orient() {
    std::vector<FacePoints> before;
    before.reserve(triangles_.size());
    for (const auto& [a, b, c] : triangles_) before.push_back({points_[a], points_[b], points_[c]});
    pmp::orient_polygon_soup(points_, triangles_);
    // Half-edges of any other soup would have invalid indices.
    if (!pmp::is_polygon_soup_a_polygon_mesh(triangles_)) return false;
    pmp::polygon_soup_to_polygon_mesh(points_, triangles_, surface_);
    turn_back(before);
    return true;
  }

  void turn_back(const std::vector<FacePoints>& before) {
    const Shells shells(surface_);
    std::vector<std::size_t> sizes(shells.count, 0), turns(shells.count, 0);
    for (const Face face : surface_.faces()) {
      ++sizes[shells.of_face[face]];
      if (turned(before[face], points_of(surface_, face))) ++turns[shells.of_face[face]];
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

  /// A single triangle does not enclose a volume, even with a back face.
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

  std::vector<SurfacePoint> points_;
  std::vector<Triangle> triangles_;
  Surface surface_;
  std::size_t touching_vertices_ = 0;
  std::vector<Repair>& repaired_;
};

}  // namespace

Result<Surface> make_surface(const TriangleMesh& soup, std::vector<Repair>& repaired) {
  return Making(soup, repaired).run();
}

TriangleMesh mesh_of(Surface& surface) {
  surface.collect_garbage();
  TriangleMesh result;
  for (const auto v : surface.vertices()) result.points.push_back(point_of(surface.point(v)));
  for (const Face face : surface.faces()) {
    const auto h = surface.halfedge(face);
    result.triangles.push_back(
        {surface.source(h), surface.target(h), surface.target(surface.next(h))});
  }
  return result;
}

}  // namespace clay::solid::inline repair
