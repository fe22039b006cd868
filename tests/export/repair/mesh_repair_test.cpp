#include "claystack/export/repair.hpp"

#include "claystack/export/proof.hpp"
#include "export/formats/file_floats.hpp"
#include "tests/export/repair/repaired_mesh.hpp"
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
  EXPECT_TRUE(check_mesh(result->mesh).value().sound()) << names(*result);
  EXPECT_EQ(times(*result, "hole filled"), 1u) << names(*result);
  EXPECT_NEAR(signed_volume(result->mesh), volume, 0.01 * volume);
}

TEST(Repair, WeldsPointsJitteredByAMicrometre) {
  // Every triangle has separate corners, each displaced by up to 1 um.
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

TEST(Repair, KeepsOneOfDuplicates) {
  TriangleMesh mesh = cube(2.0);
  mesh.triangles.push_back(mesh.triangles[4]);
  expect_repaired(mesh, 8.0, {{"duplicate triangle removed", 1}});
  // Two in one orientation, one in the other: the majority is right.
  mesh.triangles.push_back({mesh.triangles[4][1], mesh.triangles[4][0], mesh.triangles[4][2]});
  expect_repaired(mesh, 8.0, {{"duplicate triangle removed", 2}});
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

TEST(Repair, OpensAPinchedEdge) {
  // Two prisms share an edge that ends inside the clay of a plate above and one below.
  const TriangleMesh a = cube(2.0), b = moved(cube(2.0), {2, 2, 0});
  TriangleMesh plate = cube(6.0);
  for (glm::dvec3& p : plate.points) p.z /= 6.0;
  const auto result = repair_mesh(
      together(together(a, b), together(moved(plate, {-1, -1, -1}), moved(plate, {-1, -1, 2}))));
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_TRUE(check_mesh(result->mesh).value().sound()) << names(*result);
  EXPECT_EQ(check_mesh(result->mesh).value().components, 1u);
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
  EXPECT_TRUE(check_mesh(lost_corner->mesh).value().sound()) << names(*lost_corner);
  EXPECT_EQ(times(*lost_corner, "hole filled"), 1u);
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
  if (!check_mesh(mesh).value().sound()) {
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
  RC_ASSERT(check_mesh(result->mesh).value().sound());
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
  const MeshReport report = check_mesh(once->mesh).value();
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
  ASSERT_TRUE(check_mesh(sound).value().sound());
  ASSERT_GE(sound.triangles.size(), 20'000U);
  TriangleMesh crossed = sound;
  const auto moved = static_cast<std::size_t>(
      std::find_if(sound.points.begin(), sound.points.end(),
                   [](const glm::dvec3& p) { return p.z == 10.0 && p.x > 19.9; }) -
      sound.points.begin());
  crossed.points[moved] *= glm::dvec3(0.875, 0.875, 1.0);
  const MeshReport before = check_mesh(crossed).value();
  ASSERT_GE(before.self_intersections, 1U);
  ASSERT_LE(before.self_intersections, 20U);
  const auto repaired = repair_mesh(crossed);
  ASSERT_TRUE(repaired) << repaired.error().message;
  EXPECT_TRUE(check_mesh(repaired->mesh).value().sound());
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
