#include "export/solid/mesh_bodies.hpp"

#include "export/solid/mesh_topology.hpp"
#include "export/solid/shell_volumes.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <numeric>

namespace clay::solid {
namespace {

struct ShellExtent {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
  double volume_mm3 = 0.0;
  std::vector<std::uint32_t> triangles;

  [[nodiscard]] bool contains(const ShellExtent& other) const {
    return glm::all(glm::lessThanEqual(low, other.low)) &&
           glm::all(glm::greaterThanEqual(high, other.high));
  }
};

std::vector<ShellExtent> shells_of(const TriangleMesh& mesh,
                                   const std::vector<std::uint32_t>& component_of) {
  std::map<std::uint32_t, std::size_t> number;
  std::vector<ShellExtent> shells;
  const auto volumes_mm3 = volumes_of_shells(mesh, mesh.triangles.size(),
                                             [&](std::size_t t) { return component_of[t]; });
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [found, is_new] = number.try_emplace(component_of[t], shells.size());
    if (is_new) shells.emplace_back().volume_mm3 = volumes_mm3[component_of[t]];
    ShellExtent& shell = shells[found->second];
    const auto& [a, b, c] = mesh.triangles[t];
    for (const std::uint32_t i : {a, b, c}) {
      shell.low = glm::min(shell.low, mesh.points[i]);
      shell.high = glm::max(shell.high, mesh.points[i]);
    }
    shell.triangles.push_back(t);
  }
  return shells;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> bodies_of(const TriangleMesh& mesh) {
  const MeshTopology topology = topology_of(mesh.points.size(), mesh.triangles);
  if (topology.component_of.empty()) {
    std::vector<std::uint32_t> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    return {std::move(all)};
  }
  std::vector<ShellExtent> shells = shells_of(mesh, topology.component_of);
  for (ShellExtent& cavity : shells) {
    if (cavity.volume_mm3 >= 0.0) continue;
    ShellExtent* around = nullptr;
    for (ShellExtent& shell : shells)
      if (shell.volume_mm3 > 0.0 && shell.contains(cavity) &&
          (around == nullptr || shell.volume_mm3 < around->volume_mm3))
        around = &shell;
    if (around == nullptr) continue;
    around->triangles.insert(around->triangles.end(), cavity.triangles.begin(),
                             cavity.triangles.end());
    cavity.triangles.clear();
  }
  std::vector<std::vector<std::uint32_t>> bodies;
  for (ShellExtent& shell : shells)
    if (!shell.triangles.empty()) {
      std::ranges::sort(shell.triangles);
      bodies.push_back(std::move(shell.triangles));
    }
  return bodies;
}

}  // namespace clay::solid
