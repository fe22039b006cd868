// Solids that share faces, edges or space, and shells that are inside out.

#include "claystack/export/repair.hpp"

#include "claystack/export/proof.hpp"
#include "tests/export/repair/repaired_mesh.hpp"
#include "tests/export/solid/mesh_surface.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using shapes::ball;
using shapes::cube;
using shapes::inverted;
using shapes::moved;
using shapes::together;

/// A cup of two parts, one upon the other, whose common ring has other diagonals in each part.
TEST(Repair, KeepsTheInsideOfAStackedCup) {
  const TriangleMesh lower =
      revolve({{{{0, 0}, {40, 0}, {40, 50}, {36, 50}, {36, 5}, {0, 5}}}}, 48);
  const TriangleMesh upper = revolve({{{{36, 50}, {40, 50}, {40, 90}, {36, 90}}}}, 48);
  const double clay = signed_volume(lower) + signed_volume(upper);
  for (const TriangleMesh& cup : {together(lower, upper), together(upper, lower)})
    for (const TriangleMesh& mesh : {cup, inverted(cup)}) {
      const auto repaired = repair_mesh(mesh);
      ASSERT_TRUE(repaired) << repaired.error().message;
      EXPECT_TRUE(check_mesh(repaired->mesh).value().sound());
      EXPECT_NEAR(signed_volume(repaired->mesh), clay, 1e-4 * clay) << names(*repaired);
      EXPECT_EQ(times(*repaired, "solids with common edges united"), 1u) << names(*repaired);
      EXPECT_LT(repaired->change.added_mm, 0.01);
    }
}

/// As of a cup and its lid in one file: the shared face has other diagonals in each.
TEST(Repair, JoinsSolidsThatShareAFace) {
  const auto add_box = [](TriangleMesh& mesh, double from, bool turned) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (int corner = 0; corner < 8; ++corner)
      mesh.points.emplace_back(from + ((corner & 1) != 0 ? 10.0 : 0.0),
                               (corner & 2) != 0 ? 10.0 : 0.0, (corner & 4) != 0 ? 10.0 : 0.0);
    const std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
      const std::uint32_t a = first + f[turned ? 1 : 0], b = first + f[turned ? 2 : 1],
                          c = first + f[turned ? 3 : 2], d = first + f[turned ? 0 : 3];
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  };
  for (const bool turned : {false, true}) {
    TriangleMesh boxes;
    add_box(boxes, 0.0, false);
    add_box(boxes, 10.0, turned);
    const auto repaired = repair_mesh(boxes);
    ASSERT_TRUE(repaired) << repaired.error().message;
    EXPECT_TRUE(check_mesh(repaired->mesh).value().sound());
    EXPECT_NEAR(signed_volume(repaired->mesh), 2000.0, 1e-3) << turned;
    EXPECT_TRUE(repaired->holes.empty());
    // Faces with the same diagonal cancel.
    EXPECT_EQ(times(*repaired, "solids with common edges united"), turned ? 1U : 0U)
        << names(*repaired);
  }
}

TEST(Repair, ReorientsShells) {
  expect_repaired(inverted(cube(2.0)), 8.0, {{"shell turned", 1}});
  const double outer = signed_volume(ball(10.0)), inner = signed_volume(ball(5.0));
  expect_repaired(inverted(together(ball(10.0), inverted(ball(5.0)))), outer - inner,
                  {{"shell turned", 2}});
  expect_repaired(together(cube(2.0), moved(inverted(cube(3.0)), {9, 0, 0})), 35.0,
                  {{"shell turned", 1}});
}

// Slicers fill it, so the verdict on the input is that it prints as one solid body.
TEST(Repair, UnitesANestedShellOfTheSameOrientation) {
  const TriangleMesh outer = ball(10.0), inner = ball(5.0), innermost = inverted(ball(2.0));
  const std::size_t triangles = inner.triangles.size();
  const double volume = signed_volume(outer);
  expect_repaired(together(outer, inner), volume,
                  {{"triangle inside the solid removed", triangles}});
  expect_repaired(inverted(together(outer, inner)), volume,
                  {{"shell turned", 2}, {"triangle inside the solid removed", triangles}});
  // Two sheets of clay around a cavity of one are clay.
  expect_repaired(together(outer, together(inner, innermost)), volume,
                  {{"triangle inside the solid removed", 2 * triangles}});
}

TEST(Repair, KeepsAnIslandInACavity) {
  const TriangleMesh cavity = inverted(ball(8.0));
  const double expected =
      signed_volume(ball(10.0)) - signed_volume(ball(8.0)) + signed_volume(ball(5.0));
  expect_repaired(together(ball(10.0), together(cavity, inverted(ball(5.0)))), expected,
                  {{"shell turned", 1}});
}

/// A box from corner to corner, outward.
TriangleMesh box(const glm::dvec3& low, const glm::dvec3& high) {
  TriangleMesh mesh = cube(1.0);
  for (glm::dvec3& p : mesh.points) p = low + p * (high - low);
  return mesh;
}

/// In the six poses that put each axis up or down: even permutations of the axes, and half turns.
void expect_volume_in_all_poses(const TriangleMesh& mesh, double volume_mm3) {
  for (int shift = 0; shift < 3; ++shift)
    for (const double sign : {1.0, -1.0}) {
      TriangleMesh posed = mesh;
      for (glm::dvec3& p : posed.points)
        p = glm::dvec3(p[shift], sign * p[(shift + 1) % 3], sign * p[(shift + 2) % 3]);
      const auto result = repair_mesh(posed);
      ASSERT_TRUE(result) << result.error().message;
      EXPECT_TRUE(check_mesh(result->mesh).value().sound()) << shift << sign;
      EXPECT_EQ(times(*result, "shell turned"), 0U) << shift << sign;
      EXPECT_NEAR(signed_volume(result->mesh), volume_mm3, rounding_mm3(result->mesh, 64.5))
          << shift << sign;
    }
}

TEST(Repair, KeepsPocketsInAllPoses) {
  const TriangleMesh block = box({0, 0, 0}, {20, 20, 20});
  const auto less = [](TriangleMesh from, const TriangleMesh& cut) {
    return together(std::move(from), inverted(cut));
  };
  expect_volume_in_all_poses(less(block, box({5, 5, 10}, {15, 15, 20})), 7'000.0);
  // Half of it in the block, so 5 mm deep.
  expect_volume_in_all_poses(less(block, box({5, 5, 15}, {15, 15, 25})), 7'500.0);
  // Two cavities with 10 x 10 x 10 mm in common.
  const TriangleMesh large = box({0, 0, 0}, {40, 40, 40});
  expect_volume_in_all_poses(
      less(less(large, box({5, 5, 5}, {20, 20, 20})), box({10, 10, 10}, {30, 30, 30})),
      64'000.0 - (3'375.0 + 8'000.0 - 1'000.0));
  // A drain hole of 10 x 10 mm through a wall of 3 mm.
  expect_volume_in_all_poses(
      less(less(large, box({3, 3, 3}, {37, 37, 37})), box({15, 15, -1}, {25, 25, 10})),
      64'000.0 - 34.0 * 34.0 * 34.0 - 300.0);
}

TEST(Repair, TurnsABodyThatOverlapsInOneCorner) {
  // An eighth of its surface lies in the other one.
  const TriangleMesh mesh =
      together(box({0, 0, 0}, {20, 20, 20}), inverted(box({10, 10, 10}, {30, 30, 30})));
  const auto result = repair_mesh(mesh);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(times(*result, "shell turned"), 1U);
  EXPECT_NEAR(signed_volume(result->mesh), 15'000.0, rounding_mm3(result->mesh));
}

/// A cube and its lower half, which share the triangles of their floor.
TEST(Repair, UnitesSolidsOnTheSameSideOfAFace) {
  TriangleMesh half = cube(2.0);
  for (glm::dvec3& p : half.points) p.z /= 2.0;
  const TriangleMesh both = together(cube(2.0), half);
  TriangleMesh doubled = both;  // a triangle of the top
  doubled.triangles.push_back(cube(2.0).triangles[2]);
  for (const auto& [mesh, duplicates] :
       {std::pair(both, 0U), std::pair(inverted(both), 0U), std::pair(doubled, 1U)}) {
    const auto repaired = repair_mesh(mesh);
    ASSERT_TRUE(repaired) << repaired.error().message;
    EXPECT_TRUE(check_mesh(repaired->mesh).value().sound()) << names(*repaired);
    EXPECT_NEAR(signed_volume(repaired->mesh), 8.0, rounding_mm3(repaired->mesh));
    EXPECT_EQ(times(*repaired, "duplicate triangle removed"), duplicates) << names(*repaired);
  }
}

glm::dvec3 rotated(glm::dvec3 p, const glm::dvec3& turns) {
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3;
    const double x = p[axis], y = p[next];
    p[axis] = x * std::cos(turns[axis]) - y * std::sin(turns[axis]);
    p[next] = x * std::sin(turns[axis]) + y * std::cos(turns[axis]);
  }
  return p;
}

/// Rounding opens the sheets of the first cuts of these boxes, of which the largest holds the
/// others.
TEST(Repair, RepeatsCutsWhereRoundingOpensSheets) {
  const TriangleMesh boxes =
      together(together(box({30, 0, 50}, {40, 60, 60}), box({30, 0, 50}, {50, 60, 60})),
               box({40, 50, 50}, {50, 60, 60}));
  for (const glm::dvec3& turns :
       {glm::dvec3(0.3, 0.6, 0.0), glm::dvec3(0.7, 3.2, 2.6), glm::dvec3(3.0, 4.0, 2.5)}) {
    TriangleMesh mesh = boxes;
    for (glm::dvec3& p : mesh.points) p = rotated(p, turns);
    const auto repaired = repair_mesh(mesh);
    ASSERT_TRUE(repaired) << repaired.error().message;
    EXPECT_TRUE(check_mesh(repaired->mesh).value().sound()) << names(*repaired);
    EXPECT_NEAR(signed_volume(repaired->mesh), 12'000.0, 1.0);
  }
}

TEST(Repair, RemovesOneOfTwoEqualSolids) {
  const TriangleMesh mesh = ball(10.0);
  expect_repaired(together(mesh, mesh), signed_volume(mesh),
                  {{"points of one place merged", mesh.points.size()},
                   {"duplicate triangle removed", mesh.triangles.size()}});
}

TEST(Repair, MergesSolidsThatShareAFace) {
  // Both contain the square between them, back to back.
  expect_repaired(
      together(cube(2.0), moved(cube(2.0), {0, 0, 2})), 16.0,
      {{"points of one place merged", 4}, {"triangle back to back with another removed", 4}});
}

TEST(Repair, PullsSolidsApartThatTouchInAVertex) {
  const auto result = repair_mesh(together(cube(2.0), moved(cube(2.0), {2, 2, 2})));
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(times(*result, "vertex pulled apart where surfaces touch"), 1u) << names(*result);
  EXPECT_EQ(check_mesh(result->mesh).value().components, 2u);
  EXPECT_NEAR(signed_volume(result->mesh), 16.0, 1e-3);
}

TEST(Repair, PullsSolidsApartThatTouchInAnEdge) {
  const auto result = repair_mesh(together(cube(2.0), moved(cube(2.0), {2, 2, 0})));
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(times(*result, "vertex pulled apart where surfaces touch"), 2u) << names(*result);
  EXPECT_EQ(check_mesh(result->mesh).value().components, 2u);
  EXPECT_NEAR(signed_volume(result->mesh), 16.0, 1e-3);
}

TEST(Repair, UnitesOverlappingBodies) {
  const TriangleMesh mesh = together(cube(2.0), moved(cube(2.0), {1, 1, 1}));
  const auto result = repair_mesh(mesh);
  ASSERT_TRUE(result) << result.error().message;
  const MeshReport report = check_mesh(result->mesh).value();
  EXPECT_TRUE(report.sound()) << names(*result);
  EXPECT_EQ(report.components, 1u);
  EXPECT_NEAR(report.volume_mm3, 15.0, 1e-12);
  EXPECT_EQ(times(*result, "pair of intersecting triangles resolved"),
            check_mesh(mesh).value().self_intersections);
}

TEST(Repair, UnitesBodiesThatShareCoplanarFaces) {
  const auto result = repair_mesh(together(cube(2.0), moved(cube(2.0), {1, 0, 0})));
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_NEAR(signed_volume(result->mesh), 12.0, 1e-12);
}

TEST(Repair, UnitesRotatedBallsAsInclusionAndExclusion) {
  // Two balls that overlap: the volume of the union is above that of one ball and below the sum of
  // both.
  const TriangleMesh a = ball(10.0);
  TriangleMesh b = ball(10.0);
  for (glm::dvec3& p : b.points)
    p = {0.8 * p.x - 0.6 * p.y + 3.0, 0.6 * p.x + 0.8 * p.y, p.z + 2.0};
  const auto result = repair_mesh(together(a, b));
  ASSERT_TRUE(result) << result.error().message;
  const double volume = signed_volume(result->mesh);
  EXPECT_GT(volume, signed_volume(a));
  EXPECT_LT(volume, signed_volume(a) + signed_volume(b));
}

}  // namespace
}  // namespace clay::solid
