#pragma once
// Meshes shared by the tests of the formats and the fuzzers' initial corpus.

#include "claystack/export/solid.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace clay::solid::samples {

/// Corners at the origin and 10 mm along each axis; volume 1000/6 mm^3.
inline TriangleMesh tetrahedron() {
  return {.points = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}},
          .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

/// A closed torus about z of around * across * 2 triangles, facing outward.
inline TriangleMesh torus(std::uint32_t around, std::uint32_t across, double radius_mm = 40.0,
                          double tube_mm = 15.0) {
  TriangleMesh mesh;
  const double turn = 2.0 * std::numbers::pi;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double a = turn * i / around;
      const double b = turn * j / across;
      const double rho = radius_mm + tube_mm * std::cos(b);
      mesh.points.push_back({rho * std::cos(a), rho * std::sin(a), tube_mm * std::sin(b)});
      const auto point = [=](std::uint32_t di, std::uint32_t dj) {
        return (i + di) % around * across + (j + dj) % across;
      };
      mesh.triangles.push_back({point(0, 0), point(1, 0), point(1, 1)});
      mesh.triangles.push_back({point(0, 0), point(1, 1), point(0, 1)});
    }
  }
  return mesh;
}

}  // namespace clay::solid::samples
