#include "claystack/export/mesh_check.hpp"

#include "export/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using shapes::ball;
using shapes::cube;
using shapes::inverted;
using shapes::moved;
using shapes::together;

/// The verdicts of a report, in one value to compare.
struct Verdict {
  bool closed, manifold, oriented, bounds_volume, crosses;
  friend bool operator==(const Verdict&, const Verdict&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Verdict& v) {
    return out << "closed " << v.closed << " manifold " << v.manifold << " oriented " << v.oriented
               << " bounds_volume " << v.bounds_volume << " crosses " << v.crosses;
  }
};
Verdict verdict(const MeshReport& r) {
  return {r.closed, r.manifold, r.oriented, r.bounds_volume, r.self_intersections > 0};
}
constexpr Verdict kSound{true, true, true, true, false};

const MeshProblem* find(const MeshReport& report, const std::string& what) {
  const auto found = std::find_if(report.problems.begin(), report.problems.end(),
                                  [&](const MeshProblem& p) { return p.what == what; });
  return found == report.problems.end() ? nullptr : &*found;
}
std::string names(const MeshReport& report) {
  std::string all;
  for (const MeshProblem& p : report.problems)
    all += p.what + " (" + std::to_string(p.count) + ") " + p.where + "; ";
  return all;
}

TEST(CheckMesh, CubeIsSound) {
  const MeshReport report = check_mesh(cube(2.0));
  EXPECT_TRUE(report.sound()) << names(report);
  EXPECT_EQ(verdict(report), kSound);
  EXPECT_EQ(report.triangles, 12u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.degenerate, 0u);
  EXPECT_DOUBLE_EQ(report.volume_mm3, 8.0);
}

TEST(CheckMesh, DisjointSolidsAndCavitiesAreSound) {
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

TEST(CheckMesh, CavitiesAreCountedWithWhatTheyTrap) {
  using shapes::cube;
  // A cube of 10 mm with cavities of 2 and 3 mm, and a solid beside it.
  const TriangleMesh cavities =
      shapes::together(shapes::inverted(shapes::moved(cube(2), {1, 1, 1})),
                       shapes::inverted(shapes::moved(cube(3), {5, 5, 5})));
  const TriangleMesh mesh =
      shapes::together(shapes::together(cube(10), cavities), shapes::moved(cube(4), {20, 0, 0}));
  const MeshReport report = check_mesh(mesh);
  EXPECT_TRUE(report.sound());
  EXPECT_EQ(report.components, 4u);
  EXPECT_EQ(report.cavities, 2u);
  EXPECT_NEAR(report.trapped_mm3, 8.0 + 27.0, 1e-9);
  EXPECT_EQ(check_mesh(cube(10)).cavities, 0u);
}

TEST(CheckMesh, EmptyMeshIsNotSound) {
  EXPECT_FALSE(check_mesh({}).sound());
  EXPECT_FALSE(check_mesh({{{1, 2, 3}}, {}}).sound());
}

TEST(CheckMesh, Hole) {
  TriangleMesh mesh = cube(2.0);
  mesh.triangles.pop_back();
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(verdict(report), (Verdict{false, true, true, false, false}));
  ASSERT_EQ(report.problems.size(), 1u) << names(report);
  EXPECT_EQ(report.problems[0].what, "open edge");
  EXPECT_EQ(report.problems[0].count, 3u);
}

TEST(CheckMesh, OneFlippedFace) {
  TriangleMesh mesh = cube(2.0);
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(verdict(report), (Verdict{true, true, false, false, false}));
  ASSERT_EQ(report.problems.size(), 1u) << names(report);
  EXPECT_EQ(report.problems[0].count, 3u);
  EXPECT_NE(report.problems[0].where.find("3"), std::string::npos);
}

TEST(CheckMesh, InsideOut) {
  const MeshReport report = check_mesh(inverted(ball(5.0)));
  EXPECT_EQ(verdict(report), (Verdict{true, true, false, true, false}));
  ASSERT_EQ(report.problems.size(), 1u) << names(report);
  EXPECT_EQ(report.problems[0].what, "inside out");
  EXPECT_LT(report.volume_mm3, 0.0);
}

TEST(CheckMesh, InsideOutBelowAnUnusedPoint) {
  TriangleMesh mesh = inverted(cube(2.0));
  mesh.points.insert(mesh.points.begin(), {0, 0, 99});
  for (auto& t : mesh.triangles)
    for (auto& v : t) ++v;
  EXPECT_FALSE(check_mesh(mesh).oriented);
}

TEST(CheckMesh, OneOfTwoSolidsInsideOut) {
  const TriangleMesh upper = moved(cube(3.0), {0, 0, 9});
  const MeshReport below = check_mesh(together(inverted(cube(2.0)), upper));
  EXPECT_FALSE(below.bounds_volume);
  EXPECT_TRUE(find(below, "shell turned against its neighbours")) << names(below);
  const MeshReport above = check_mesh(together(cube(4.0), inverted(upper)));
  EXPECT_FALSE(above.bounds_volume);
  EXPECT_FALSE(above.sound());
}

TEST(CheckMesh, NestedShellsOfOneOrientation) {
  const MeshReport report = check_mesh(together(ball(10.0), ball(5.0)));
  EXPECT_EQ(verdict(report), (Verdict{true, true, true, false, false}));
  EXPECT_TRUE(find(report, "shell turned against its neighbours")) << names(report);
}

TEST(CheckMesh, CavityOutsideItsSolid) {
  const MeshReport report =
      check_mesh(together(ball(10.0), moved(inverted(ball(5.0)), {40, 0, 0})));
  EXPECT_FALSE(report.bounds_volume);
  EXPECT_FALSE(report.sound());
}

TEST(CheckMesh, OverlappingSolids) {
  const MeshReport report = check_mesh(together(cube(2.0), moved(cube(2.0), {1, 1, 1})));
  EXPECT_EQ(verdict(report), (Verdict{true, true, true, false, true}));
  ASSERT_TRUE(find(report, "self-intersection")) << names(report);
}

TEST(CheckMesh, SelfCrossing) {
  TriangleMesh mesh = ball(5.0);
  mesh.points[0].z = 20.0;  // the lower pole through the top
  const MeshReport report = check_mesh(mesh);
  EXPECT_TRUE(report.closed && report.manifold);
  EXPECT_GT(report.self_intersections, 0u);
  EXPECT_FALSE(report.bounds_volume);
}

TEST(CheckMesh, Fin) {
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back({3, -3, 1});
  mesh.triangles.push_back({0, 1, 8});
  const MeshReport report = check_mesh(mesh);
  EXPECT_FALSE(report.closed);
  EXPECT_FALSE(report.manifold);
  EXPECT_EQ(report.self_intersections, 0u);
  ASSERT_TRUE(find(report, "non-manifold edge")) << names(report);
  EXPECT_EQ(find(report, "non-manifold edge")->count, 1u);
  EXPECT_EQ(find(report, "open edge")->count, 2u);
  EXPECT_NE(find(report, "non-manifold edge")->where.find("(1, 0, 0) mm"), std::string::npos);
}

TEST(CheckMesh, DuplicateFace) {
  TriangleMesh mesh = cube(2.0);
  mesh.triangles.push_back(mesh.triangles[4]);
  const MeshReport report = check_mesh(mesh);
  EXPECT_FALSE(report.manifold);
  ASSERT_TRUE(find(report, "duplicate triangle")) << names(report);
  EXPECT_EQ(find(report, "duplicate triangle")->count, 1u);
  EXPECT_NE(find(report, "duplicate triangle")->where.find("4, 12"), std::string::npos);
}

TEST(CheckMesh, TwoSidedTriangleIsNoSolid) {
  const MeshReport report = check_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}});
  EXPECT_FALSE(report.sound());
  EXPECT_TRUE(find(report, "duplicate triangle")) << names(report);
}

TEST(CheckMesh, CrackOfOneUlp) {
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back(mesh.points[6]);
  mesh.points.back().z = std::nextafter(2.0, 3.0);
  for (const std::size_t t : {2u, 3u})
    std::replace(mesh.triangles[t].begin(), mesh.triangles[t].end(), 6u, 8u);
  const MeshReport report = check_mesh(mesh);
  EXPECT_FALSE(report.closed);
  EXPECT_TRUE(report.manifold);
  EXPECT_TRUE(report.oriented);
  EXPECT_EQ(find(report, "open edge")->count, 4u) << names(report);
}

TEST(CheckMesh, DegenerateSliver) {
  // A vertex in the middle of an edge: the face beside it is split, the sliver closes the gap.
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back({1, 0, 0});
  std::erase(mesh.triangles, (std::array<std::uint32_t, 3>{0, 1, 5}));
  mesh.triangles.insert(mesh.triangles.end(), {{0, 8, 5}, {8, 1, 5}, {0, 1, 8}});
  const MeshReport report = check_mesh(mesh);
  // The faces on both sides of the sliver touch along it, which no two faces may.
  EXPECT_EQ(verdict(report), (Verdict{true, true, true, false, true})) << names(report);
  EXPECT_EQ(report.degenerate, 1u);
  ASSERT_EQ(report.problems.size(), 2u) << names(report);
  EXPECT_EQ(report.problems[0].what, "degenerate triangle");
  EXPECT_EQ(report.problems[0].where.substr(0, 11), "triangle 13");
}

TEST(CheckMesh, TriangleThatNamesAVertexTwiceLeavesTheRestClosed) {
  TriangleMesh mesh = cube(2.0);
  mesh.triangles.push_back({0, 0, 1});
  const MeshReport report = check_mesh(mesh);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.degenerate, 1u);
  EXPECT_FALSE(report.sound());
}

TEST(CheckMesh, ConesThatTouchInAPoint) {
  TriangleMesh mesh = together(cube(2.0), moved(cube(2.0), {2, 2, 2}));
  for (auto& t : mesh.triangles)
    for (auto& v : t)
      if (v == 8) v = 6;  // the corner (2, 2, 2) that both have
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(verdict(report), (Verdict{true, false, true, false, false})) << names(report);
  ASSERT_EQ(report.problems.size(), 1u) << names(report);
  EXPECT_EQ(report.problems[0].what, "non-manifold vertex");
  EXPECT_NE(report.problems[0].where.find("(2, 2, 2) mm"), std::string::npos);
  EXPECT_EQ(report.components, 2u);
}

TEST(CheckMesh, SolidsThatTouchInACornerButShareNoIndex) {
  const MeshReport report = check_mesh(together(cube(2.0), moved(cube(2.0), {2, 2, 2})));
  EXPECT_GT(report.self_intersections, 0u);
}

TEST(CheckMesh, PointsThatAreNoNumbers) {
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = cube(2.0);
    mesh.points[5].y = x;
    const MeshReport report = check_mesh(mesh);
    ASSERT_TRUE(find(report, "non-finite point")) << names(report);
    EXPECT_EQ(find(report, "non-finite point")->where, "point 5");
    EXPECT_FALSE(report.bounds_volume);
  }
}

TEST(CheckMesh, IndexOutOfRange) {
  TriangleMesh mesh = cube(2.0);
  mesh.triangles[7][1] = 8;
  const MeshReport report = check_mesh(mesh);
  ASSERT_EQ(report.problems.size(), 1u) << names(report);
  EXPECT_EQ(report.problems[0].what, "index out of range");
  EXPECT_EQ(report.problems[0].where, "triangle 7");
}

TEST(CheckMesh, UnusedPointsDoNoHarm) {
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back({50, 50, 50});
  EXPECT_TRUE(check_mesh(mesh).sound());
}

TEST(CheckMesh, SelfIntersectionsAreFoundInSoupsToo) {
  // The same overlap with and without a fin that makes it a soup: one count, two ways.
  const TriangleMesh overlap = together(ball(5.0), moved(ball(5.0), {1.1, 0.7, 0.3}));
  TriangleMesh soup = overlap;
  soup.points.push_back({90, 90, 90});
  const auto fin = static_cast<std::uint32_t>(soup.points.size() - 1);
  soup.triangles.push_back({fin, fin, 0});
  EXPECT_EQ(check_mesh(overlap).self_intersections, check_mesh(soup).self_intersections);
  EXPECT_GT(check_mesh(soup).self_intersections, 0u);
}

/// A soup, because its last triangle names a vertex twice.
std::size_t crossings_in_soup(std::vector<glm::dvec3> points,
                              std::vector<std::array<std::uint32_t, 3>> triangles) {
  triangles.push_back({0, 0, 1});
  return check_mesh({std::move(points), std::move(triangles)}).self_intersections;
}

TEST(CheckMesh, TrianglesThatShareAnEdgeMayOverlap) {
  EXPECT_EQ(crossings_in_soup({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}),
            1u);
  EXPECT_EQ(
      crossings_in_soup({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, -1, 0}}, {{0, 1, 2}, {1, 0, 3}}), 0u);
  EXPECT_EQ(
      crossings_in_soup({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 1, 1e-9}}, {{0, 1, 2}, {1, 0, 3}}),
      0u);
}

TEST(CheckMesh, TrianglesThatShareAVertexMayCross) {
  // A side of the second pierces the first above (1, 1), and not the reverse. Which of them is
  // looked at first depends on which reaches lower: the shear turns that round.
  for (const double shear : {0.0, -3.0}) {
    const auto count = [&](double tip) {
      std::vector<glm::dvec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, tip}};
      for (glm::dvec3& p : points) p.z += shear * p.x;
      return crossings_in_soup(points, {{0, 1, 2}, {3, 4, 0}});
    };
    EXPECT_EQ(count(-1.0), 1u);
    EXPECT_EQ(count(0.25), 0u);
  }
}

TEST(CheckMesh, CountingStopsInAHopelessMesh) {
  TriangleMesh mesh = ball(5.0);
  for (int i = 1; i < 60; ++i) mesh = together(mesh, moved(ball(5.0), {i * 1e-3, i * 2e-3, 0}));
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.self_intersections, 100'000u);
}

RC_GTEST_PROP(CheckMesh, AnySoupGetsAReport, ()) {
  TriangleMesh mesh;
  const auto points = *rc::gen::inRange<std::uint32_t>(1, 9);
  for (std::uint32_t i = 0; i < points; ++i)
    mesh.points.emplace_back(*rc::gen::inRange(0, 3), *rc::gen::inRange(0, 3),
                             *rc::gen::inRange(0, 3));
  const auto count = *rc::gen::inRange(0, 16);
  const auto index = rc::gen::inRange<std::uint32_t>(0, points);
  for (int i = 0; i < count; ++i) mesh.triangles.push_back({*index, *index, *index});
  const MeshReport report = check_mesh(mesh);
  RC_ASSERT(report.triangles == mesh.triangles.size());
  const bool all_well = report.closed && report.manifold && report.oriented &&
                        report.bounds_volume && report.self_intersections == 0 &&
                        report.degenerate == 0;
  RC_ASSERT(report.sound() == all_well);
}

RC_GTEST_PROP(CheckMesh, OneTriangleLessOrTurnedIsAlwaysSeen, (const ClayStack& stack)) {
  const auto found = profile_of(stack);
  if (!found || !certify(found->profile)) RC_DISCARD("no certificate");
  const TriangleMesh mesh = revolve(found->profile, 5);
  const auto victim = *rc::gen::inRange<std::size_t>(0, mesh.triangles.size());
  TriangleMesh holed = mesh;
  holed.triangles.erase(holed.triangles.begin() + static_cast<std::ptrdiff_t>(victim));
  RC_ASSERT(!check_mesh(holed).closed);
  TriangleMesh flipped = mesh;
  std::swap(flipped.triangles[victim][0], flipped.triangles[victim][1]);
  RC_ASSERT(!check_mesh(flipped).oriented);
}

TEST(SignedVolume, IsTheSameWhereverTheMeshStands) {
  EXPECT_DOUBLE_EQ(signed_volume(cube(2.0)), 8.0);
  EXPECT_DOUBLE_EQ(signed_volume(inverted(cube(2.0))), -8.0);
  EXPECT_NEAR(signed_volume(moved(cube(2.0), {4096, -8192, 1024})), 8.0, 1e-12);
  EXPECT_EQ(signed_volume({}), 0.0);
}

}  // namespace
}  // namespace clay::solid
