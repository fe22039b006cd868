#include "export/fallen/pockets.hpp"

#include "export/solid/disjoint_sets.hpp"
#include "export/solid/shell_volumes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

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

/// By the point that names the set of a shell; 0 for all other points.
std::vector<double> volumes_of(const TriangleMesh& mesh, DisjointSets& points) {
  return volumes_of_shells(mesh, mesh.points.size(),
                           [&](std::size_t t) { return points.of(mesh.triangles[t][0]); });
}

struct Shell {
  std::size_t triangles = 0;
  double area_mm2 = 0.0, volume_mm3 = 0.0;
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-low};
  bool on_seam = false;

  /// Three times volume over area.
  [[nodiscard]] double depth_mm() const { return -3.0 * volume_mm3 / area_mm2; }
  /// Upper bound of the radius of a ball inside: half of the shortest side of the box, and the
  /// radius of a ball of the same volume.
  [[nodiscard]] double ball_mm() const {
    const glm::dvec3 sides = high - low;
    return std::min(0.5 * std::min({sides.x, sides.y, sides.z}),
                    std::cbrt(-0.75 * volume_mm3 / std::numbers::pi));
  }
  void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    ++triangles;
    area_mm2 += 0.5 * glm::length(glm::cross(b - a, c - a));
    low = glm::min(low, glm::min(a, glm::min(b, c)));
    high = glm::max(high, glm::max(a, glm::max(b, c)));
  }
};

/// The shell of each point that names a set.
std::vector<Shell> shells_of(const TriangleMesh& mesh, DisjointSets& points) {
  std::vector<Shell> shells(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles)
    shells[points.of(a)].add(mesh.points[a], mesh.points[b], mesh.points[c]);
  const std::vector<double> volumes = volumes_of(mesh, points);
  for (std::size_t i = 0; i < shells.size(); ++i) shells[i].volume_mm3 = volumes[i];
  return shells;
}

}  // namespace

std::vector<double> shell_volumes(const TriangleMesh& mesh) {
  DisjointSets points = joined_points(mesh);
  const std::vector<Shell> shells = shells_of(mesh, points);
  std::vector<double> volumes;
  for (const Shell& shell : shells)
    if (shell.triangles > 0) volumes.push_back(shell.volume_mm3);
  return volumes;
}

FilledPockets fill_pockets(const TriangleMesh& mesh, const std::vector<bool>& on_seam,
                           double deepest_mm) {
  DisjointSets points = joined_points(mesh);
  std::vector<Shell> shells = shells_of(mesh, points);
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v)
    if (on_seam[v]) shells[points.of(v)].on_seam = true;
  const auto is_pocket = [&](const Shell& shell) {
    return shell.on_seam && shell.volume_mm3 < 0.0 && shell.depth_mm() <= deepest_mm;
  };

  FilledPockets result;
  std::vector<bool> filled(shells.size());
  for (std::size_t i = 0; i < shells.size(); ++i) {
    if (shells[i].triangles == 0 || !is_pocket(shells[i])) continue;
    filled[i] = true;
    ++result.pockets;
    result.volume_mm3 -= shells[i].volume_mm3;
    result.max_ball_mm = std::max(result.max_ball_mm, shells[i].ball_mm());
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
