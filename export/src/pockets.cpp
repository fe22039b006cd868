#include "pockets.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

namespace clay::solid {
namespace {

/// Points joined by triangles, as a forest whose roots stand for shells.
class Shells {
 public:
  explicit Shells(const TriangleMesh& mesh) : parent_(mesh.points.size()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    for (const auto& [a, b, c] : mesh.triangles) {
      join(a, b);
      join(a, c);
    }
  }
  std::uint32_t of(std::uint32_t point) {
    while (parent_[point] != point) point = parent_[point] = parent_[parent_[point]];
    return point;
  }

 private:
  void join(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }
  std::vector<std::uint32_t> parent_;
};

struct Shell {
  double volume = 0.0;  ///< [mm^3], negative where it faces inward
  double area = 0.0;    ///< [mm^2]
  bool on_seam = false;
  glm::dvec3 origin{0.0};
  bool seen = false;
};

}  // namespace

FilledPockets fill_pockets(const TriangleMesh& mesh, const std::vector<bool>& on_seam,
                           double deepest_mm) {
  Shells shells(mesh);
  std::vector<Shell> measured(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    Shell& shell = measured[shells.of(a)];
    // A pocket is small and far from the origin: about a point of its own nothing cancels.
    if (!shell.seen) shell.origin = mesh.points[a], shell.seen = true;
    const glm::dvec3 p = mesh.points[a] - shell.origin, q = mesh.points[b] - shell.origin,
                     r = mesh.points[c] - shell.origin;
    shell.volume += glm::dot(p, glm::cross(q, r)) / 6.0;
    shell.area += 0.5 * glm::length(glm::cross(q - p, r - p));
    shell.on_seam = shell.on_seam || on_seam[a] || on_seam[b] || on_seam[c];
  }
  FilledPockets result;
  const auto depth = [](const Shell& shell) { return -3.0 * shell.volume / shell.area; };
  const auto is_pocket = [&](const Shell& shell) {
    return shell.on_seam && shell.volume < 0.0 && depth(shell) <= deepest_mm;
  };
  for (const Shell& shell : measured) {
    if (!is_pocket(shell)) continue;
    ++result.pockets;
    result.volume_mm3 -= shell.volume;
    result.max_depth_mm = std::max(result.max_depth_mm, depth(shell));
  }
  std::vector<std::uint32_t> kept(mesh.points.size());
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    const Shell& shell = measured[shells.of(v)];
    if (!shell.seen || is_pocket(shell)) continue;
    kept[v] = static_cast<std::uint32_t>(result.mesh.points.size());
    result.mesh.points.push_back(mesh.points[v]);
    result.on_seam.push_back(on_seam[v]);
  }
  for (const auto& [a, b, c] : mesh.triangles)
    if (!is_pocket(measured[shells.of(a)]))
      result.mesh.triangles.push_back({kept[a], kept[b], kept[c]});
  return result;
}

}  // namespace clay::solid
