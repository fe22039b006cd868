#pragma once
#include "claystack/export/solid.hpp"
#include "core/compensated_sum.hpp"

#include <cstddef>
#include <glm/geometric.hpp>
#include <vector>

namespace clay::solid {

/// The signed volume of each shell [mm^3], by Gauss' theorem: below 0 where the normals point
/// inward; 0 for a number that no triangle has. `shell_of(t)`: the shell of a triangle, below
/// `shells`. Each shell is measured about one of its corners: about a distant point, cancellation
/// would make the volume of a small shell inexact.
template <class ShellOf>
[[nodiscard]] std::vector<double> volumes_of_shells(const TriangleMesh& mesh, std::size_t shells,
                                                    ShellOf shell_of) {
  struct Sextuple {
    CompensatedSum sum;
    const glm::dvec3* origin = nullptr;
  };
  std::vector<Sextuple> sums(shells);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    auto& [sum, origin] = sums[shell_of(t)];
    if (origin == nullptr) origin = &mesh.points[a];
    sum.add(glm::dot(mesh.points[a] - *origin,
                     glm::cross(mesh.points[b] - *origin, mesh.points[c] - *origin)));
  }
  std::vector<double> volumes_mm3;
  volumes_mm3.reserve(shells);
  for (const Sextuple& six : sums) volumes_mm3.push_back(six.sum.value() / 6.0);
  return volumes_mm3;
}

}  // namespace clay::solid
