#pragma once
#include "export/solid/area_shares.hpp"
#include "export/solid/mesh_topology.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace clay::solid::inline check {

/// The n-th van der Corput number: its digits mirrored at the point.
inline double radical_inverse(std::size_t n, std::size_t base) {
  double value = 0.0, digit = 1.0;
  for (; n > 0; n /= base) {
    digit /= static_cast<double>(base);
    value += digit * static_cast<double>(n % base);
  }
  return value;
}

/// Points on the surface, evenly distributed by area.
class SurfaceSampling {
 public:
  /// The mesh outlives this.
  SurfaceSampling(const TriangleMesh& mesh, std::size_t samples) : mesh_(mesh), samples_(samples) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) shares_.add(doubled_area(mesh, t));
  }

  [[nodiscard]] double area() const { return shares_.area(); }

  /// The triangle at the middle of the sample's share of the area.
  [[nodiscard]] std::uint32_t triangle(std::size_t sample) const {
    return static_cast<std::uint32_t>(shares_.triangle(sample, samples_));
  }

  [[nodiscard]] glm::dvec3 place(std::size_t sample) const {
    const auto& [a, b, c] = mesh_.triangles[triangle(sample)];
    double u = radical_inverse(sample + 1, 2), v = radical_inverse(sample + 1, 3);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const glm::dvec3 &p = mesh_.points[a], &q = mesh_.points[b], &r = mesh_.points[c];
    return p + u * (q - p) + v * (r - p);
  }

 private:
  const TriangleMesh& mesh_;
  std::size_t samples_;
  AreaShares shares_;
};

}  // namespace clay::solid::inline check
