// Shells beside, within and against each other.

#include "claystack/export/mesh_check.hpp"
#include "export/mesh_verdict.hpp"
#include "export/shapes.hpp"

#include <gtest/gtest.h>

namespace clay::solid {
namespace {

using samples::find;
using samples::kSound;
using samples::names;
using samples::verdict;
using samples::Verdict;
using shapes::ball;
using shapes::cube;
using shapes::inverted;
using shapes::moved;
using shapes::together;

TEST(MeshShells, DisjointSolidsAndCavitiesAreSound) {
  const MeshReport two = check_mesh(together(cube(2.0), moved(cube(2.0), {5, 0, 0})));
  EXPECT_TRUE(two.sound()) << names(two);
  EXPECT_EQ(two.components, 2u);
  const MeshReport hollow = check_mesh(together(ball(10.0), inverted(ball(5.0))));
  EXPECT_TRUE(hollow.sound()) << names(hollow);
  EXPECT_EQ(verdict(hollow), kSound);
  // A ball in the cavity of a ball.
  const MeshReport nested =
      check_mesh(together(together(ball(10.0), inverted(ball(5.0))), ball(2.0)));
  EXPECT_TRUE(nested.sound()) << names(nested);
  EXPECT_EQ(nested.components, 3u);
}

TEST(MeshShells, CavitiesAreCountedWithWhatTheyTrap) {
  // A cube of 10 mm with cavities of 2 and 3 mm, and a solid beside it.
  const TriangleMesh cavities =
      together(inverted(moved(cube(2), {1, 1, 1})), inverted(moved(cube(3), {5, 5, 5})));
  const TriangleMesh mesh = together(together(cube(10), cavities), moved(cube(4), {20, 0, 0}));
  const MeshReport report = check_mesh(mesh);
  EXPECT_TRUE(report.sound());
  EXPECT_EQ(report.components, 4u);
  EXPECT_EQ(report.cavities, 2u);
  EXPECT_NEAR(report.trapped_mm3, 8.0 + 27.0, 1e-9);
  EXPECT_EQ(check_mesh(cube(10)).cavities, 0u);
}

TEST(MeshShells, InsideOut) {
  const MeshReport report = check_mesh(inverted(ball(5.0)));
  EXPECT_EQ(verdict(report), (Verdict{true, true, false, true, false}));
  ASSERT_EQ(report.problems.size(), 1u) << names(report);
  EXPECT_EQ(report.problems[0].what, "inside out");
  EXPECT_LT(report.volume_mm3, 0.0);
}

TEST(MeshShells, InsideOutBelowAnUnusedPoint) {
  TriangleMesh mesh = inverted(cube(2.0));
  mesh.points.insert(mesh.points.begin(), {0, 0, 99});
  for (auto& t : mesh.triangles)
    for (auto& v : t) ++v;
  EXPECT_FALSE(check_mesh(mesh).oriented);
}

TEST(MeshShells, OneOfTwoSolidsInsideOut) {
  const TriangleMesh upper = moved(cube(3.0), {0, 0, 9});
  const MeshReport below = check_mesh(together(inverted(cube(2.0)), upper));
  EXPECT_FALSE(below.bounds_volume);
  EXPECT_TRUE(find(below, "shell turned against its neighbours")) << names(below);
  const MeshReport above = check_mesh(together(cube(4.0), inverted(upper)));
  EXPECT_FALSE(above.bounds_volume);
  EXPECT_FALSE(above.sound());
}

TEST(MeshShells, NestedShellsOfOneOrientation) {
  const MeshReport report = check_mesh(together(ball(10.0), ball(5.0)));
  EXPECT_EQ(verdict(report), (Verdict{true, true, true, false, false}));
  EXPECT_TRUE(find(report, "shell turned against its neighbours")) << names(report);
}

TEST(MeshShells, CavityOutsideItsSolid) {
  const MeshReport report =
      check_mesh(together(ball(10.0), moved(inverted(ball(5.0)), {40, 0, 0})));
  EXPECT_FALSE(report.bounds_volume);
  EXPECT_FALSE(report.sound());
}

}  // namespace
}  // namespace clay::solid
