#include "export/fallen/pockets.hpp"

#include "core/compensated_sum.hpp"
#include "export/solid/disjoint_sets.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace clay::solid::inline fallen {
namespace {

/// Points joined by triangles: one set for each shell.
DisjointSets joined_points(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.unite(a, b);
    sets.unite(a, c);
  }
  return sets;
}

struct Shell {
  std::size_t triangles = 0;
  glm::dvec3 origin{0.0};  // per shell: relative to a distant point, a pocket's volume would cancel
  CompensatedSum sextuple;
  double area_mm2 = 0.0;
  bool on_seam = false;

  [[nodiscard]] double volume_mm3() const { return sextuple.value() / 6.0; }
  [[nodiscard]] double depth_mm() const { return -3.0 * volume_mm3() / area_mm2; }
  void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    if (triangles++ == 0) origin = a;
    sextuple.add(glm::dot(a - origin, glm::cross(b - origin, c - origin)));
    area_mm2 += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
};

/// The shell of each point that names a set.
std::vector<Shell> shells_of(const TriangleMesh& mesh, DisjointSets& points) {
  std::vector<Shell> shells(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles)
    shells[points.of(a)].add(mesh.points[a], mesh.points[b], mesh.points[c]);
  return shells;
}

}  // namespace

std::vector<double> shell_volumes(const TriangleMesh& mesh) {
  DisjointSets points = joined_points(mesh);
  std::vector<double> volumes;
  for (const Shell& shell : shells_of(mesh, points))
    if (shell.triangles > 0) volumes.push_back(shell.volume_mm3());
  return volumes;
}

FilledPockets fill_pockets(const TriangleMesh& mesh, const std::vector<bool>& on_seam,
                           double deepest_mm) {
  DisjointSets points = joined_points(mesh);
  std::vector<Shell> shells = shells_of(mesh, points);
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v)
    if (on_seam[v]) shells[points.of(v)].on_seam = true;
  const auto is_pocket = [&](const Shell& shell) {
    return shell.on_seam && shell.volume_mm3() < 0.0 && shell.depth_mm() <= deepest_mm;
  };

  FilledPockets result;
  std::vector<bool> filled(shells.size());
  for (std::size_t i = 0; i < shells.size(); ++i) {
    if (shells[i].triangles == 0 || !is_pocket(shells[i])) continue;
    filled[i] = true;
    ++result.pockets;
    result.volume_mm3 -= shells[i].volume_mm3();
    result.max_depth_mm = std::max(result.max_depth_mm, shells[i].depth_mm());
  }
  std::vector<std::uint32_t> kept(mesh.points.size());
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    const std::uint32_t root = points.of(v);
    if (filled[root] || shells[root].triangles == 0) continue;
    kept[v] = static_cast<std::uint32_t>(result.mesh.points.size());
    result.mesh.points.push_back(mesh.points[v]);
    result.on_seam.push_back(on_seam[v]);
  }
  for (const auto& [a, b, c] : mesh.triangles)
    if (!filled[points.of(a)]) result.mesh.triangles.push_back({kept[a], kept[b], kept[c]});
  return result;
}

}  // namespace clay::solid::inline fallen
