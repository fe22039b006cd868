#include "export/repair/shell_turning.hpp"

#include "export/repair/surface_making.hpp"
#include "export/repair/winding_ray.hpp"
#include "export/solid/shell_volumes.hpp"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

namespace clay::solid::inline repair {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

/// Shells that may intersect others or themselves: their volumes show their orientation. A negative
/// shell inside clay is a cavity, and any other one is turned. A positive shell stays, also inside
/// another one: slicers fill it.
class OrientedShells {
 public:
  OrientedShells(TriangleMesh mesh, const Shells& shells)
      : mesh_(std::move(mesh)),
        shells_(shells),
        volumes_mm3_(volumes_of_shells(mesh_, shells.count,
                                       [&](std::size_t t) { return shells.of_face[t]; })) {}

  std::vector<bool> to_turn() {
    const bool all = std::accumulate(volumes_mm3_.begin(), volumes_mm3_.end(), 0.0) < 0.0;
    std::vector<bool> turn(shells_.count, all);
    if (all) reverse_all();
    if (shells_.count == 1) return turn;
    const WindingRay ray(mesh_);
    const std::vector<std::uint32_t> tops = top_triangles();
    for (std::size_t shell = 0; shell < shells_.count; ++shell)
      if (volumes_mm3_[shell] < 0.0 && winding_behind(ray, tops[shell]) <= 0) turn[shell] = !all;
    return turn;
  }

 private:
  void reverse_all() {
    for (Triangle& t : mesh_.triangles) std::swap(t[1], t[2]);
    for (double& volume : volumes_mm3_) volume = -volume;
  }

  /// For each shell, the triangle at its highest vertex that is seen best from above.
  std::vector<std::uint32_t> top_triangles() const {
    std::vector<std::uint32_t> tops(shells_.count, 0);
    std::vector<std::pair<double, double>> best(shells_.count, {-INFINITY, -INFINITY});
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [i, j, k] = mesh_.triangles[t];
      const glm::dvec3 &a = mesh_.points[i], &b = mesh_.points[j], &c = mesh_.points[k];
      const glm::dvec3 normal = glm::cross(b - a, c - a);
      const double length = glm::length(normal);
      if (!(length > 0.0)) continue;
      const std::pair rank(std::max({a.z, b.z, c.z}), std::abs(normal.z) / length);
      if (rank <= best[shells_.of_face[t]]) continue;
      best[shells_.of_face[t]] = rank;
      tops[shells_.of_face[t]] = t;
    }
    return tops;
  }

  /// The winding number behind a triangle of a reversed shell, outside of which it lies.
  int winding_behind(const WindingRay& ray, std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const auto count = ray.from_middle_of(
        {exact_point(mesh_.points[a]), exact_point(mesh_.points[b]), exact_point(mesh_.points[c])});
    return count.front ? count.winding + 1 : count.winding;
  }

  TriangleMesh mesh_;
  const Shells& shells_;
  std::vector<double> volumes_mm3_;
};

}  // namespace

std::size_t turn_shells(Surface& surface) {
  if (surface.is_empty() || !CGAL::is_closed(surface)) return 0;
  TriangleMesh mesh = mesh_of(surface);
  const Shells shells(surface);
  const std::vector<bool> turn = OrientedShells(std::move(mesh), shells).to_turn();
  std::vector<Surface::Face_index> faces;
  for (const auto face : surface.faces())
    if (turn[shells.of_face[face]]) faces.push_back(face);
  pmp::reverse_face_orientations(faces, surface);
  return static_cast<std::size_t>(std::count(turn.begin(), turn.end(), true));
}

}  // namespace clay::solid::inline repair
