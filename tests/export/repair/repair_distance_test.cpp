#include "export/repair/repair_distance.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace clay::solid {
namespace {

/// A level square of 100 mm, in `parts` by `parts` squares of two triangles.
TriangleMesh square(std::uint32_t parts, double height_mm) {
  TriangleMesh mesh;
  const double part_mm = 100.0 / parts;
  for (std::uint32_t i = 0; i <= parts; ++i)
    for (std::uint32_t j = 0; j <= parts; ++j)
      mesh.points.emplace_back(part_mm * i, part_mm * j, height_mm);
  for (std::uint32_t i = 0; i < parts; ++i)
    for (std::uint32_t j = 0; j < parts; ++j) {
      const std::uint32_t a = i * (parts + 1) + j, b = a + parts + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

TEST(RepairDistance, IsCloseBetweenManySmallTrianglesAndAFewLargeOnes) {
  const auto change = surface_change(square(140, 0.0), square(1, 1.0), 1e-3);
  for (const double mm : {change.added_mm, change.removed_mm}) {
    EXPECT_GE(mm, 1.0);
    EXPECT_LE(mm, 1.0 * 1.02 + 1e-3);
  }
}

}  // namespace
}  // namespace clay::solid
