#include "export/repair/surface_samples.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numeric>
#include <utility>

namespace clay::solid::inline repair {
namespace {

std::vector<std::uint32_t> all_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

}  // namespace

SurfaceSamples::SurfaceSamples(const TriangleMesh& mesh, std::size_t count)
    : SurfaceSamples(mesh, all_of(mesh), count) {}

SurfaceSamples::SurfaceSamples(const TriangleMesh& mesh, std::vector<std::uint32_t> triangles,
                               std::size_t count)
    : mesh_(mesh), count_(count), triangles_(std::move(triangles)) {
  double area = 0.0;
  for (const std::uint32_t t : triangles_) {
    const auto& [a, b, c] = mesh.triangles[t];
    area +=
        glm::length(glm::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]));
    area_to_.push_back(area);
  }
}

std::uint32_t SurfaceSamples::triangle(std::size_t sample) const {
  const double share = (static_cast<double>(sample) + 0.5) / static_cast<double>(count_);
  const auto at =
      std::upper_bound(area_to_.begin(), std::prev(area_to_.end()), share * area_to_.back());
  return triangles_[static_cast<std::size_t>(at - area_to_.begin())];
}

glm::dvec2 SurfaceSamples::weights(std::size_t sample) {
  constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;
  const auto part = [&](double step) {
    const double all = 0.5 + step * static_cast<double>(sample);
    return all - std::floor(all);
  };
  const double u = part(kFirst), v = part(kSecond);
  return u + v > 1.0 ? glm::dvec2(1.0 - u, 1.0 - v) : glm::dvec2(u, v);
}

glm::dvec3 SurfaceSamples::place(std::size_t sample) const {
  const auto& [a, b, c] = mesh_.triangles[triangle(sample)];
  const glm::dvec2 w = weights(sample);
  return mesh_.points[a] + w.x * (mesh_.points[b] - mesh_.points[a]) +
         w.y * (mesh_.points[c] - mesh_.points[a]);
}

}  // namespace clay::solid::inline repair
