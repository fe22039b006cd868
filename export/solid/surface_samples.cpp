#include "export/solid/surface_samples.hpp"

#include <cmath>
#include <numeric>
#include <utility>

namespace clay::solid {
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
  for (const std::uint32_t t : triangles_) shares_.add(doubled_area(mesh, t));
}

std::uint32_t SurfaceSamples::triangle(std::size_t sample) const {
  return triangles_[shares_.triangle(sample, count_)];
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

}  // namespace clay::solid
