#pragma once
#include "claystack/export/solid.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <iterator>
#include <vector>

namespace clay::solid {

/// Twice the area of a triangle, as a vector along its outward normal [mm2].
[[nodiscard]] inline glm::dvec3 doubled_area(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return glm::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
}

/// Triangles by their shares of the area, for samples that are evenly distributed by area.
class AreaShares {
 public:
  void add(const glm::dvec3& doubled) { up_to_.push_back(area() + glm::length(doubled)); }

  /// Twice the area of all [mm2].
  [[nodiscard]] double area() const { return up_to_.empty() ? 0.0 : up_to_.back(); }
  /// The number of the triangle at the middle of the share of a sample of `count`. Requires a
  /// triangle.
  [[nodiscard]] std::size_t triangle(std::size_t sample, std::size_t count) const {
    const double share = (static_cast<double>(sample) + 0.5) / static_cast<double>(count);
    const auto at = std::upper_bound(up_to_.begin(), std::prev(up_to_.end()), share * area());
    return static_cast<std::size_t>(at - up_to_.begin());
  }

 private:
  std::vector<double> up_to_;
};

}  // namespace clay::solid
