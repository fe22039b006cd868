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

/// A level square of 100 mm whose triangles have one corner in common, with `parts` along one side.
TriangleMesh fan(std::uint32_t parts) {
  TriangleMesh mesh{{{0, 0, 0}, {100, 0, 0}}, {}};
  for (std::uint32_t i = 0; i <= parts; ++i)
    mesh.points.emplace_back(100.0 - 100.0 * i / parts, 100, 0);
  for (std::uint32_t i = 1; i < mesh.points.size() - 1; ++i)
    mesh.triangles.push_back({0, i, i + 1});
  return mesh;
}

/// The boxes of such triangles overlap, so the search walks over the surface.
TEST(RepairDistance, IsCloseBetweenLongThinTrianglesInOnePlane) {
  for (const double apart_mm : {0.0, 5.0}) {
    const auto change = surface_change(fan(4'000), square(1, apart_mm), 0.01);
    // Each thin triangle lies above one large one; a large one above many thin ones.
    EXPECT_GE(change.removed_mm, apart_mm);
    EXPECT_LE(change.removed_mm, apart_mm + 0.01);
    EXPECT_GE(change.added_mm, apart_mm);
    EXPECT_LE(change.added_mm, apart_mm + 0.5);
  }
}

}  // namespace
}  // namespace clay::solid
