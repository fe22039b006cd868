// The overhang of a mesh is that of its section, and that of simple solids is known.
#include "claystack/export/check.hpp"
#include "claystack/export/walls.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace clay::solid {
namespace {

using shapes::cube;
using shapes::moved;
using shapes::together;

double overhang_of(const TriangleMesh& mesh) {
  const auto found = steepest_overhang(mesh);
  EXPECT_TRUE(found);
  return found ? found->angle_deg : -1.0;
}

TEST(MeshOverhang, IsThatOfTheSection) {
  const std::vector<Polygon> sections{
      {{0, 0}, {30, 0}, {60, 40}, {54, 40}, {28.5, 6}, {0, 6}},
      {{0, 0}, {40, 0}, {40, 40}, {20, 60}, {14, 60}, {34, 40}, {34, 6}, {0, 6}},
      {{0, 0}, {40, 0}, {40, 60}, {0, 60}, {0, 54}, {35, 54}, {35, 6}, {0, 6}},
      {{0, 0}, {40, 0}, {40, 20}, {40.5, 20}, {40.5, 40}, {34, 40}, {34, 5}, {0, 5}},
      {{0, 0}, {40, 0}, {40, 20}, {41.7, 20}, {41.7, 40}, {34, 40}, {34, 5}, {0, 5}},
      {{0, 0.6}, {30, 0.6}, {30, 0}, {40, 0}, {40, 9}, {0, 9}}};
  for (const Polygon& section : sections)
    EXPECT_NEAR(overhang_of(revolve({{section}}, 256)), steepest_overhang({{section}}).angle_deg,
                0.3);
}

TEST(MeshOverhang, OfStepsIsTheirLean) {
  for (const double lean_deg : {20.0, 60.0, 80.0}) {
    const double aside = 0.25 * std::tan(lean_deg * std::numbers::pi / 180.0);
    Polygon section{{0, 0}};
    for (int i = 0; i < 100; ++i) {
      section.push_back({30 + aside * i, 0.25 * i});
      section.push_back({30 + aside * i, 0.25 * (i + 1)});
    }
    section.push_back({0, 25});
    EXPECT_NEAR(overhang_of(revolve({{section}}, 128)), lean_deg, 0.3);
  }
}

TEST(MeshOverhang, StatesThePlace) {
  // A table on a leg, lifted: the bed is its lowest level.
  const TriangleMesh table =
      moved(together(cube(10), moved(cube(16), {-3, -3, 10})), {100, 200, 300});
  const auto found = steepest_overhang(table);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->height_mm, 10.0, 1e-9);
  EXPECT_NEAR(found->at.z, 310.0, 1e-9);
  // Its edges are 3 mm from the leg, its corners the root of 18.
  const double slope = std::tan(found->angle_deg * std::numbers::pi / 180.0);
  EXPECT_GT(slope, 3.0 / 0.5);
  EXPECT_LT(slope, std::sqrt(18.0) / 0.5);
}

TEST(MeshOverhang, IsNoneWherePartsLieOnEachOther) {
  EXPECT_EQ(overhang_of(cube(10)), 0.0);
  EXPECT_EQ(overhang_of(together(cube(10), moved(cube(6), {2, 2, 10}))), 0.0);
  EXPECT_EQ(overhang_of(together(cube(10), moved(cube(6), {2, 2, 10.3}))), 0.0);
  EXPECT_EQ(overhang_of(together(cube(10), moved(cube(6), {2, 2, 10.6}))), 90.0);
}

TEST(MeshOverhang, IsUnknownWithoutReadablePoints) {
  EXPECT_FALSE(steepest_overhang(TriangleMesh{}));
  TriangleMesh mesh = cube(10);
  mesh.points[0].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(steepest_overhang(mesh));
  mesh = cube(10);
  mesh.triangles[0][0] = 99;
  EXPECT_FALSE(steepest_overhang(mesh));
}

}  // namespace
}  // namespace clay::solid
