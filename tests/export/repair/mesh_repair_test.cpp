#include "claystack/export/repair.hpp"

#include "claystack/export/proof.hpp"
#include "export/formats/file_floats.hpp"
#include "tests/export/repair/repair_counts.hpp"
#include "tests/export/solid/mesh_surface.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using shapes::ball;
using shapes::cube;
using shapes::inverted;
using shapes::moved;
using shapes::surface_mm2;
using shapes::together;

std::string names(const RepairedMesh& result) {
  std::string all;
  for (const Repair& repair : result.repaired)
    all += repair.what + " (" + std::to_string(repair.count) + "); ";
  for (const MeshProblem& p : check_mesh(result.mesh).problems)
    all += "REMAINS " + p.what + " " + p.where + "; ";
  return all;
}

double reach_of(const TriangleMesh& mesh) {
  double reach = 0.0;
  for (const glm::dvec3& p : mesh.points)
    reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return reach;
}

/// The farthest that float32 moves a point: half a unit of the last place along each axis.
double rounding_mm(const TriangleMesh& mesh) { return std::sqrt(3.0) * 0x1p-24 * reach_of(mesh); }

/// Upper bound of the change of volume if every point moves by the rounding (or by `units` of the
/// last place); 1 % more for the area that this adds, and the summation in double.
double rounding_mm3(const TriangleMesh& mesh, double units = 0.5) {
  return 1.01 * 2.0 * units * rounding_mm(mesh) * surface_mm2(mesh) +
         1e-15 * reach_of(mesh) * surface_mm2(mesh);
}

/// The mesh is sound again with that volume, and only these repairs were made.
void expect_repaired(const TriangleMesh& broken, double volume_mm3, const std::vector<Repair>& as) {
  ASSERT_FALSE(check_mesh(broken).sound());
  const auto result = repair_mesh(broken);
  ASSERT_TRUE(result) << result.error().message;
  const MeshReport report = check_mesh(result->mesh);
  EXPECT_TRUE(report.sound()) << names(*result);
  // Touching parts are pulled apart by 64 units of the last place, rounded once more.
  const double units = times(*result, "vertex pulled apart where surfaces touch") > 0 ? 64.5 : 0.5;
  EXPECT_NEAR(report.volume_mm3, volume_mm3, rounding_mm3(result->mesh, units)) << names(*result);
  EXPECT_EQ(result->repaired.size(), as.size()) << names(*result);
  for (const Repair& expected : as)
    EXPECT_EQ(times(*result, expected.what), expected.count)
        << expected.what << ": " << names(*result);
}

constexpr double kCrack = 4.0 * std::numeric_limits<float>::epsilon();

TEST(Repair, LeavesASoundMeshUnchanged) {
  TriangleMesh mesh = together(ball(10.0), inverted(ball(5.0)));
  mesh.points.push_back({50, 50, 50});
  const auto result = repair_mesh(mesh);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->mesh, mesh);
  EXPECT_TRUE(result->repaired.empty());
}

TEST(Repair, FillsAHole) {
  TriangleMesh mesh = cube(2.0);
  mesh.triangles.pop_back();
  expect_repaired(mesh, 8.0, {{"hole filled", 1}});
}

TEST(Repair, CapsWideOpeningsOnRequestOnly) {
  // A tube of 400 sides without its two ends.
  TriangleMesh tube = revolve({{{{0, 0}, {30, 0}, {30, 50}, {0, 50}}}}, 400);
  const double volume = signed_volume(tube);
  std::erase_if(tube.triangles, [&](const auto& t) {
    return tube.points[t[0]].z == tube.points[t[1]].z && tube.points[t[1]].z == tube.points[t[2]].z;
  });
  const auto refused = repair_mesh(tube);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::unsound);
  EXPECT_NE(refused.error().message.find("opening"), std::string::npos) << refused.error().message;
  const auto capped = repair_mesh(tube, {.cap_openings = true});
  ASSERT_TRUE(capped) << capped.error().message;
  EXPECT_NEAR(signed_volume(capped->mesh), volume, rounding_mm3(capped->mesh));
  ASSERT_EQ(capped->holes.size(), 2u);
  for (const FilledHole& hole : capped->holes) {
    EXPECT_EQ(hole.edges, 400u);
    EXPECT_NEAR(hole.area_mm2, volume / 50.0, 1e-3);
    EXPECT_NEAR(hole.place.x, 0.0, 1e-3);
  }
}

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
      EXPECT_TRUE(check_mesh(repaired->mesh).sound());
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
    EXPECT_TRUE(check_mesh(repaired->mesh).sound());
    EXPECT_NEAR(signed_volume(repaired->mesh), 2000.0, 1e-3) << turned;
    EXPECT_TRUE(repaired->holes.empty());
    // Faces with the same diagonal cancel.
    EXPECT_EQ(times(*repaired, "solids with common edges united"), turned ? 1U : 0U)
        << names(*repaired);
  }
}

TEST(Repair, RefusesAHoleOfTooManyEdgesWithItsPlace) {
  TriangleMesh cup = revolve({{{{0, 0}, {30, 0}, {30, 50}, {0, 50}}}}, kMaxHoleEdges + 2);
  std::erase_if(cup.triangles, [&](const auto& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return cup.points[v].z == 50.0; });
  });
  const auto refused = repair_mesh(cup, {.cap_openings = true});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::unsound);
  for (const char* part : {"at most 10000 edges", "found one of 10002 edges", "50) mm",
                           "; wrapping makes a new surface"})
    EXPECT_NE(refused.error().message.find(part), std::string::npos) << refused.error().message;
}

TEST(Repair, FillsAPatchOfEightTrianglesWithoutIntersections) {
  // Curved in both directions; a fill in the plane of the border would fold.
  TriangleMesh mesh =
      revolve({{{{0, 0}, {20, 0}, {28, 8}, {30, 20}, {28, 32}, {20, 40}, {0, 40}}}}, 24);
  const double volume = signed_volume(mesh);
  const glm::dvec3 place(30, 0, 20);
  std::sort(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& a, const auto& b) {
    const auto far = [&](const auto& t) {
      return glm::distance((mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0,
                           place);
    };
    return far(a) < far(b);
  });
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 8);
  const auto result = repair_mesh(mesh);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_TRUE(check_mesh(result->mesh).sound()) << names(*result);
  EXPECT_EQ(times(*result, "hole filled"), 1u) << names(*result);
  EXPECT_NEAR(signed_volume(result->mesh), volume, 0.01 * volume);
}

TEST(Repair, WeldsPointsJitteredByAMicrometre) {
  // Every triangle has corners of its own, each displaced by up to 1 um.
  const TriangleMesh good = ball(20.0);
  TriangleMesh soup;
  double phase = 0.0;
  for (const auto& t : good.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (const std::uint32_t v : t) {
      phase += 1.0;
      soup.points.push_back(good.points[v] + 0.001 / std::sqrt(3.0) *
                                                 glm::dvec3(std::sin(17.0 * phase),
                                                            std::sin(29.0 * phase),
                                                            std::sin(41.0 * phase)));
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const auto result = repair_mesh(soup);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->mesh.triangles.size(), good.triangles.size());
  EXPECT_NEAR(signed_volume(result->mesh), signed_volume(good), 0.002 * surface_mm2(good));
  EXPECT_FALSE(repair_mesh(soup, {.weld_mm = 1e-6}));
}

TEST(Repair, ClosesTJunctions) {
  // Edge 0-1 of the cube has a vertex in the middle on one side only, off the edge by 2 um.
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back({1, 0.002, 0});
  std::erase(mesh.triangles, (std::array<std::uint32_t, 3>{0, 1, 5}));
  mesh.triangles.insert(mesh.triangles.end(), {{0, 8, 5}, {8, 1, 5}});
  const auto result = repair_mesh(mesh);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_NEAR(signed_volume(result->mesh), 8.0, 0.01);
}

TEST(Repair, ReorientsAFlippedFace) {
  for (const std::size_t victim : {0u, 3u}) {
    TriangleMesh mesh = cube(2.0);
    std::swap(mesh.triangles[victim][0], mesh.triangles[victim][1]);
    expect_repaired(mesh, 8.0, {{"triangle turned", 1}});
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
      EXPECT_TRUE(check_mesh(result->mesh).sound()) << shift << sign;
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

TEST(Repair, KeepsOneOfDuplicates) {
  TriangleMesh mesh = cube(2.0);
  mesh.triangles.push_back(mesh.triangles[4]);
  expect_repaired(mesh, 8.0, {{"duplicate triangle removed", 1}});
  // Two in one orientation, one in the other: the majority is right.
  mesh.triangles.push_back({mesh.triangles[4][1], mesh.triangles[4][0], mesh.triangles[4][2]});
  expect_repaired(mesh, 8.0, {{"duplicate triangle removed", 2}});
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
    EXPECT_TRUE(check_mesh(repaired->mesh).sound()) << names(*repaired);
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
TEST(Repair, CutsAnewWhereRoundingOpensSheets) {
  const auto box = [](const glm::dvec3& low, const glm::dvec3& high) {
    TriangleMesh mesh = cube(1.0);
    for (glm::dvec3& p : mesh.points) p = low + p * (high - low);
    return mesh;
  };
  const TriangleMesh boxes =
      together(together(box({30, 0, 50}, {40, 60, 60}), box({30, 0, 50}, {50, 60, 60})),
               box({40, 50, 50}, {50, 60, 60}));
  for (const glm::dvec3& turns :
       {glm::dvec3(0.3, 0.6, 0.0), glm::dvec3(0.7, 3.2, 2.6), glm::dvec3(3.0, 4.0, 2.5)}) {
    TriangleMesh mesh = boxes;
    for (glm::dvec3& p : mesh.points) p = rotated(p, turns);
    const auto repaired = repair_mesh(mesh);
    ASSERT_TRUE(repaired) << repaired.error().message;
    EXPECT_TRUE(check_mesh(repaired->mesh).sound()) << names(*repaired);
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

TEST(Repair, ClosesACrackOfOneUlp) {
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back(mesh.points[6]);
  mesh.points.back().z = std::nextafter(2.0F, 3.0F);
  for (const std::size_t t : {2u, 3u})
    std::replace(mesh.triangles[t].begin(), mesh.triangles[t].end(), 6u, 8u);
  expect_repaired(mesh, 8.0, {{"points welded across a crack", 1}});
}

TEST(Repair, MergesDuplicatePoints) {
  TriangleMesh soup;
  for (const auto& t : cube(2.0).triangles) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (const std::uint32_t v : t) soup.points.push_back(cube(2.0).points[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  expect_repaired(soup, 8.0, {{"points of one place merged", 28}});
}

TEST(Repair, RemovesFins) {
  TriangleMesh mesh = cube(2.0);
  mesh.points.insert(mesh.points.end(), {{3, -3, 1}, {4, -4, 1}});
  mesh.triangles.push_back({0, 1, 8});
  expect_repaired(mesh, 8.0, {{"triangle of a fin removed", 1}});
  mesh.triangles.push_back({8, 1, 9});
  expect_repaired(mesh, 8.0, {{"triangle of a fin removed", 2}});
  // A hole beside the fin does not make the cube a fin.
  mesh.triangles.erase(mesh.triangles.begin() + 9);
  expect_repaired(mesh, 8.0, {{"triangle of a fin removed", 2}, {"hole filled", 1}});
}

TEST(Repair, PullsSolidsApartThatTouchInAVertex) {
  const auto result = repair_mesh(together(cube(2.0), moved(cube(2.0), {2, 2, 2})));
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(times(*result, "vertex pulled apart where surfaces touch"), 1u) << names(*result);
  EXPECT_EQ(check_mesh(result->mesh).components, 2u);
  EXPECT_NEAR(signed_volume(result->mesh), 16.0, 1e-3);
}

TEST(Repair, PullsSolidsApartThatTouchInAnEdge) {
  const auto result = repair_mesh(together(cube(2.0), moved(cube(2.0), {2, 2, 0})));
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(times(*result, "vertex pulled apart where surfaces touch"), 2u) << names(*result);
  EXPECT_EQ(check_mesh(result->mesh).components, 2u);
  EXPECT_NEAR(signed_volume(result->mesh), 16.0, 1e-3);
}

TEST(Repair, OpensAPinchedEdge) {
  // Two prisms share an edge that ends inside the clay of a plate above and one below.
  const TriangleMesh a = cube(2.0), b = moved(cube(2.0), {2, 2, 0});
  TriangleMesh plate = cube(6.0);
  for (glm::dvec3& p : plate.points) p.z /= 6.0;
  const auto result = repair_mesh(
      together(together(a, b), together(moved(plate, {-1, -1, -1}), moved(plate, {-1, -1, 2}))));
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_TRUE(check_mesh(result->mesh).sound()) << names(*result);
  EXPECT_EQ(check_mesh(result->mesh).components, 1u);
  EXPECT_NEAR(signed_volume(result->mesh), 2 * 8.0 + 2 * 36.0, 0.01);
}

TEST(Repair, RemovesASliver) {
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back({1, 0, 0});
  std::erase(mesh.triangles, (std::array<std::uint32_t, 3>{0, 1, 5}));
  mesh.triangles.insert(mesh.triangles.end(), {{0, 8, 5}, {8, 1, 5}, {0, 1, 8}});
  expect_repaired(mesh, 8.0, {{"triangle without area removed", 1}});
}

TEST(Repair, DropsInvalidTriangles) {
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  mesh.triangles.push_back({0, 1, 8});
  mesh.triangles.push_back({0, 1, 99});
  expect_repaired(mesh, 8.0, {{"triangle without a place removed", 2}});
  mesh = cube(2.0);
  mesh.points[6].x = std::numeric_limits<double>::infinity();
  const auto lost_corner = repair_mesh(mesh);
  ASSERT_TRUE(lost_corner);
  EXPECT_TRUE(check_mesh(lost_corner->mesh).sound()) << names(*lost_corner);
  EXPECT_EQ(times(*lost_corner, "hole filled"), 1u);
}

TEST(Repair, UnitesOverlappingBodies) {
  const TriangleMesh mesh = together(cube(2.0), moved(cube(2.0), {1, 1, 1}));
  const auto result = repair_mesh(mesh);
  ASSERT_TRUE(result) << result.error().message;
  const MeshReport report = check_mesh(result->mesh);
  EXPECT_TRUE(report.sound()) << names(*result);
  EXPECT_EQ(report.components, 1u);
  EXPECT_NEAR(report.volume_mm3, 15.0, 1e-12);
  EXPECT_EQ(times(*result, "pair of intersecting triangles resolved"),
            check_mesh(mesh).self_intersections);
}

TEST(Repair, UnitesBodiesThatShareCoplanarFaces) {
  const auto result = repair_mesh(together(cube(2.0), moved(cube(2.0), {1, 0, 0})));
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_NEAR(signed_volume(result->mesh), 12.0, 1e-12);
}

TEST(Repair, UnitesRotatedBallsAsInclusionAndExclusion) {
  // The overlap of two balls is computed by cutting one with the planes of the other, apart from
  // the code under test: the union of a ball with itself, moved within a hair, stays in its hull.
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

TEST(Repair, KeepsThePointsOfTrianglesThatMeetNoOther) {
  const TriangleMesh apart = moved(ball(10.0), {60, 0, 0});
  const auto result =
      repair_mesh(together(together(cube(2.0), moved(cube(2.0), {1, 1, 1})), apart));
  ASSERT_TRUE(result) << result.error().message;
  for (const glm::dvec3& p : apart.points)
    EXPECT_NE(
        std::find(result->mesh.points.begin(), result->mesh.points.end(), glm::dvec3(glm::vec3(p))),
        result->mesh.points.end());
}

TEST(Repair, ReportsWhenNothingIsLeft) {
  for (const TriangleMesh& mesh :
       {TriangleMesh{}, TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 1}}},
        TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}},
        TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}}) {
    const auto result = repair_mesh(mesh);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::unsound);
  }
}

RC_GTEST_PROP(Repair, RepairsEveryRemovedOrFlippedTriangle, (const ClayStack& stack)) {
  const auto found = profile_of(stack);
  if (!found || !certify(found->profile)) RC_DISCARD("no certificate");
  TriangleMesh mesh = revolve(found->profile, 5);
  round_to_file(mesh.points);
  if (!check_mesh(mesh).sound()) {
    // Then rounding moves points by an eighth of their clearance or more.
    const Margins margins = margins_of(found->profile, 5);
    RC_ASSERT(std::min(margins.clearance_mm, margins.chord_mm) <= 8.0 * rounding_mm(mesh));
    RC_DISCARD("float32 does not hold this solid");
  }
  const auto victim = *rc::gen::inRange<std::size_t>(0, mesh.triangles.size());
  TriangleMesh broken = mesh;
  if (*rc::gen::arbitrary<bool>())
    broken.triangles.erase(broken.triangles.begin() + static_cast<std::ptrdiff_t>(victim));
  else
    std::swap(broken.triangles[victim][0], broken.triangles[victim][1]);
  const auto result = repair_mesh(broken);
  RC_ASSERT(result.has_value());
  RC_LOG() << names(*result);
  RC_ASSERT(check_mesh(result->mesh).sound());
  // A hole beside a wall as thin as a crack may close the wall.
  RC_ASSERT(std::abs(signed_volume(result->mesh) - signed_volume(mesh)) <=
            1e-9 * signed_volume(mesh) + kCrack * reach_of(mesh) * surface_mm2(mesh));
}

RC_GTEST_PROP(Repair, RepairsOrRefusesAnySoupDeterministically, ()) {
  TriangleMesh mesh;
  const auto points = *rc::gen::inRange<std::uint32_t>(1, 14);
  for (std::uint32_t i = 0; i < points; ++i)
    mesh.points.emplace_back(*rc::gen::inRange(0, 3), *rc::gen::inRange(0, 3),
                             *rc::gen::inRange(0, 3));
  const auto count = *rc::gen::inRange(0, 40);
  const auto index = rc::gen::inRange<std::uint32_t>(0, points + 1);
  for (int i = 0; i < count; ++i) mesh.triangles.push_back({*index, *index, *index});
  const auto once = repair_mesh(mesh), again = repair_mesh(mesh);
  RC_ASSERT(once.has_value() == again.has_value());
  if (!once) return;
  RC_ASSERT(once->mesh == again->mesh);
  const MeshReport report = check_mesh(once->mesh);
  RC_LOG() << names(*once);
  RC_ASSERT(report.sound());
}

/// Of 20,000 triangles one vertex is pushed through the opposite wall.
TEST(Repair, KeepsTheOrderOfTheRestOfAMesh) {
  const TriangleMesh sound = [] {
    TriangleMesh mesh = revolve({{{{0, 0},
                                   {20, 0},
                                   {20, 10},
                                   {20, 20},
                                   {20, 30},
                                   {18, 30},
                                   {18, 20},
                                   {18, 10},
                                   {18, 2},
                                   {0, 2}}}},
                                1'250);
    round_to_file(mesh.points);
    return mesh;
  }();
  ASSERT_TRUE(check_mesh(sound).sound());
  ASSERT_GE(sound.triangles.size(), 20'000U);
  TriangleMesh crossed = sound;
  const auto moved = static_cast<std::size_t>(
      std::find_if(sound.points.begin(), sound.points.end(),
                   [](const glm::dvec3& p) { return p.z == 10.0 && p.x > 19.9; }) -
      sound.points.begin());
  crossed.points[moved] *= glm::dvec3(0.875, 0.875, 1.0);
  const MeshReport before = check_mesh(crossed);
  ASSERT_GE(before.self_intersections, 1U);
  ASSERT_LE(before.self_intersections, 20U);
  const auto repaired = repair_mesh(crossed);
  ASSERT_TRUE(repaired) << repaired.error().message;
  EXPECT_TRUE(check_mesh(repaired->mesh).sound());
  // All triangles farther than 3 mm from the fault, as their corners: the same in the same order.
  const auto far_ones = [&](const TriangleMesh& mesh) {
    std::vector<std::array<glm::dvec3, 3>> corners;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::array<glm::dvec3, 3> of{mesh.points[a], mesh.points[b], mesh.points[c]};
      if (std::all_of(of.begin(), of.end(), [&](const glm::dvec3& p) {
            return glm::length((p - sound.points[moved]) * glm::dvec3(1.0, 1.0, 0.0)) > 3.0;
          }))
        corners.push_back(of);
    }
    return corners;
  };
  EXPECT_GE(far_ones(crossed).size(), 19'000U);
  EXPECT_EQ(far_ones(repaired->mesh), far_ones(crossed));
}

}  // namespace
}  // namespace clay::solid
