// Shells beside, inside and against each other.

#include "claystack/export/proof.hpp"
#include "export/solid/mesh_geometry.hpp"
#include "tests/export/proof/mesh_verdict.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <cmath>

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
  const MeshReport two = check_mesh(together(cube(2.0), moved(cube(2.0), {5, 0, 0}))).value();
  EXPECT_TRUE(two.sound()) << names(two);
  EXPECT_EQ(two.components, 2u);
  const MeshReport hollow = check_mesh(together(ball(10.0), inverted(ball(5.0)))).value();
  EXPECT_TRUE(hollow.sound()) << names(hollow);
  EXPECT_EQ(verdict(hollow), kSound);
  // A ball in the cavity of a ball.
  const MeshReport nested =
      check_mesh(together(together(ball(10.0), inverted(ball(5.0))), ball(2.0))).value();
  EXPECT_TRUE(nested.sound()) << names(nested);
  EXPECT_EQ(nested.components, 3u);
}

TEST(MeshShells, CountsCavitiesAndTheirVolume) {
  // A cube of 10 mm with cavities of 2 and 3 mm, and a solid beside it.
  const TriangleMesh cavities =
      together(inverted(moved(cube(2), {1, 1, 1})), inverted(moved(cube(3), {5, 5, 5})));
  const TriangleMesh mesh = together(together(cube(10), cavities), moved(cube(4), {20, 0, 0}));
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_TRUE(report.sound());
  EXPECT_EQ(report.components, 4u);
  EXPECT_EQ(report.cavities, 2u);
  EXPECT_NEAR(report.trapped_mm3, 8.0 + 27.0, 1e-9);
  EXPECT_EQ(check_mesh(cube(10)).value().cavities, 0u);
}

TEST(MeshShells, TrapsNoVolumeWhereBodiesLieInCavities) {
  // A cavity of 8 mm with a body of 6 mm in it, which has a cavity of 4 mm with a body of 2 mm.
  TriangleMesh mesh = together(cube(10), moved(inverted(cube(8)), {1, 1, 1}));
  mesh = together(mesh, moved(cube(6), {2, 2, 2}));
  const MeshReport three = check_mesh(mesh).value();
  EXPECT_TRUE(three.sound()) << names(three);
  EXPECT_EQ(three.cavities, 1u);
  EXPECT_NEAR(three.trapped_mm3, 512.0 - 216.0, 1e-9);
  mesh = together(mesh, moved(inverted(cube(4)), {3, 3, 3}));
  mesh = together(mesh, moved(cube(2), {4, 4, 4}));
  const MeshReport five = check_mesh(together(mesh, moved(cube(5), {20, 0, 0}))).value();
  EXPECT_TRUE(five.sound()) << names(five);
  EXPECT_EQ(five.cavities, 2u);
  EXPECT_NEAR(five.trapped_mm3, 512.0 - 216.0 + 64.0 - 8.0, 1e-9);
}

TEST(MeshShells, ReportsAMeshWithoutVolumeNotAsInsideOut) {
  // Two cubes, one of them inside out; and a cube that is pressed flat.
  const MeshReport opposed =
      check_mesh(together(cube(2), moved(inverted(cube(2)), {5, 0, 0}))).value();
  ASSERT_EQ(opposed.problems.size(), 1u) << names(opposed);
  EXPECT_EQ(opposed.problems[0].what, "shell turned against its neighbours");
  EXPECT_FALSE(opposed.oriented);
  TriangleMesh flat = cube(2);
  for (glm::dvec3& p : flat.points) p.z = 0.0;
  const MeshReport pressed = check_mesh(flat).value();
  EXPECT_TRUE(find(pressed, "no volume")) << names(pressed);
  EXPECT_FALSE(find(pressed, "inside out")) << names(pressed);
  EXPECT_FALSE(pressed.sound());
}

TEST(MeshShells, ReportsAnInsideOutSolid) {
  const MeshReport report = check_mesh(inverted(ball(5.0))).value();
  EXPECT_EQ(verdict(report), (Verdict{true, true, false, true, false}));
  ASSERT_EQ(report.problems.size(), 1u) << names(report);
  EXPECT_EQ(report.problems[0].what, "inside out");
  EXPECT_LT(report.volume_mm3, 0.0);
}

TEST(MeshShells, ReportsAnInsideOutSolidBelowAnUnusedPoint) {
  TriangleMesh mesh = inverted(cube(2.0));
  mesh.points.insert(mesh.points.begin(), {0, 0, 99});
  for (auto& t : mesh.triangles)
    for (auto& v : t) ++v;
  EXPECT_FALSE(check_mesh(mesh).value().oriented);
}

TEST(MeshShells, ReportsOneInsideOutSolidOfTwo) {
  const TriangleMesh upper = moved(cube(3.0), {0, 0, 9});
  const MeshReport below = check_mesh(together(inverted(cube(2.0)), upper)).value();
  EXPECT_FALSE(below.bounds_volume);
  EXPECT_FALSE(below.oriented);
  EXPECT_TRUE(find(below, "shell turned against its neighbours")) << names(below);
  const MeshReport above = check_mesh(together(cube(4.0), inverted(upper))).value();
  EXPECT_FALSE(above.bounds_volume);
  EXPECT_FALSE(above.oriented);
  EXPECT_FALSE(above.sound());
}

TEST(MeshShells, ReportsNestedShellsOfEqualOrientation) {
  const MeshReport report = check_mesh(together(ball(10.0), ball(5.0))).value();
  EXPECT_EQ(verdict(report), (Verdict{true, true, true, false, false}));
  EXPECT_TRUE(find(report, "closed shell inside another one that faces outward; a slicer fills it"))
      << names(report);
}

TEST(MeshShells, ReportsACavityOutsideItsSolid) {
  const MeshReport report =
      check_mesh(together(ball(10.0), moved(inverted(ball(5.0)), {40, 0, 0}))).value();
  EXPECT_FALSE(report.bounds_volume);
  EXPECT_FALSE(report.sound());
}

/// Nested cubes about one axis: every upward ray passes the corners of all others.
TriangleMesh nest(std::size_t shells) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < shells; ++i) {
    const double side = 2.0 * static_cast<double>(i + 1);
    const TriangleMesh shell = moved(cube(side), glm::dvec3(-side / 2.0));
    // The outermost shell faces out.
    const TriangleMesh turned = (shells - i) % 2 == 1 ? shell : inverted(shell);
    const auto offset = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), turned.points.begin(), turned.points.end());
    for (const auto& [a, b, c] : turned.triangles)
      mesh.triangles.push_back({a + offset, b + offset, c + offset});
  }
  return mesh;
}

/// Cubes beside and above each other.
TriangleMesh crowd(std::size_t side) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < side * side * side; ++i) {
    const glm::dvec3 place(i % side, i / side % side, i / side / side);
    const auto offset = static_cast<std::uint32_t>(mesh.points.size());
    for (const glm::dvec3& p : cube(1.0).points) mesh.points.push_back(p + 2.0 * place);
    for (const auto& [a, b, c] : cube(1.0).triangles)
      mesh.triangles.push_back({a + offset, b + offset, c + offset});
  }
  return mesh;
}

std::size_t steps_of(const TriangleMesh& mesh) {
  const ShellGeometry geometry =
      shell_geometry(mesh, topology_of(mesh.points.size(), mesh.triangles));
  EXPECT_TRUE(geometry.bounds_volume);
  EXPECT_TRUE(geometry.outward);
  return geometry.steps;
}

TEST(MeshShells, SearchCostGrowsWithTheNumberOfShells) {
  // Four times as many: log-linear gives less than six times, comparing pairs sixteen times.
  EXPECT_LT(steps_of(nest(2000)), 6 * steps_of(nest(500)));
  EXPECT_LT(steps_of(nest(2000)), 2000u * 400);
  EXPECT_LT(steps_of(crowd(16)), 12 * steps_of(crowd(8)));  // eight times as many
  EXPECT_LT(steps_of(crowd(16)), 4096u * 400);
}

/// A shell with its contents, each a cube in a separate octant.
struct Tree {
  bool outward = true;
  std::vector<Tree> within;
};

rc::Gen<Tree> any_tree(int depth) {
  return rc::gen::exec([depth] {
    Tree tree;
    tree.outward = *rc::gen::inRange(0, 6) > 0;  // corrected by the depth below
    const int count = depth == 0 ? 0 : *rc::gen::inRange(0, 4);
    for (int i = 0; i < count; ++i) tree.within.push_back(*any_tree(depth - 1));
    return tree;
  });
}

/// Adds the shells to the mesh; returns the number of misplaced ones. `expected`: the orientation
/// of this shell.
std::size_t build(const Tree& tree, const glm::dvec3& low, double side, bool expected, bool damaged,
                  TriangleMesh& mesh) {
  // `outward` false: the wrong orientation.
  const bool outward = tree.outward == expected;
  const TriangleMesh shell = moved(cube(side), low);
  mesh = together(std::move(mesh), outward ? shell : inverted(shell));
  damaged = damaged || !tree.outward;
  std::size_t misplaced = damaged ? 1 : 0;
  for (std::size_t i = 0; i < tree.within.size(); ++i) {
    const glm::dvec3 octant(i % 2, i / 2 % 2, i / 4);
    misplaced += build(tree.within[i], low + side * (0.1 + 0.4 * octant), 0.3 * side, !expected,
                       damaged, mesh);
  }
  return misplaced;
}

RC_GTEST_PROP(MeshShellsAtRandom, ReportsExactlyTheMisplacedShells, ()) {
  Tree tree = *any_tree(4);
  tree.outward = true;
  const bool outward = *rc::gen::arbitrary<bool>();
  TriangleMesh mesh;
  const std::size_t misplaced = build(tree, {-3.0, 1.0, 0.5}, 64.0, outward, false, mesh);
  // Rotated, so that tops are corners, or not, so that they are faces.
  if (*rc::gen::arbitrary<bool>())
    for (glm::dvec3& p : mesh.points)
      p = {0.8 * p.x - 0.6 * p.z, 0.6 * p.y + 0.48 * p.x + 0.64 * p.z,
           0.36 * p.x - 0.8 * p.y + 0.48 * p.z};
  const ShellGeometry geometry =
      shell_geometry(mesh, topology_of(mesh.points.size(), mesh.triangles));
  RC_ASSERT(geometry.outward == outward);
  RC_ASSERT(geometry.misplaced_shells.count == misplaced);
  RC_ASSERT(geometry.bounds_volume == (misplaced == 0));
}

}  // namespace
}  // namespace clay::solid
