// Self-intersecting meshes.

#include "claystack/export/proof.hpp"
#include "tests/export/proof/mesh_verdict.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using samples::find;
using samples::names;
using samples::verdict;
using samples::Verdict;
using shapes::ball;
using shapes::cube;
using shapes::moved;
using shapes::together;

TEST(MeshCrossings, FindsOverlappingSolids) {
  const MeshReport report = check_mesh(together(cube(2.0), moved(cube(2.0), {1, 1, 1}))).value();
  EXPECT_EQ(verdict(report), (Verdict{true, true, true, false, true}));
  ASSERT_TRUE(find(report, "self-intersection")) << names(report);
}

TEST(MeshCrossings, FindsASelfIntersection) {
  TriangleMesh mesh = ball(5.0);
  mesh.points[0].z = 20.0;  // moves the lower pole through the top
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_TRUE(report.closed && report.manifold);
  EXPECT_GT(report.self_intersections, 0u);
  EXPECT_FALSE(report.bounds_volume);
}

TEST(MeshCrossings, FindsSolidsThatTouchInAnUnsharedCorner) {
  const MeshReport report = check_mesh(together(cube(2.0), moved(cube(2.0), {2, 2, 2}))).value();
  EXPECT_GT(report.self_intersections, 0u);
}

TEST(MeshCrossings, FindsSelfIntersectionsInSoups) {
  // The same overlap with and without a fin that makes it a soup: equal counts by two methods.
  const TriangleMesh overlap = together(ball(5.0), moved(ball(5.0), {1.1, 0.7, 0.3}));
  TriangleMesh soup = overlap;
  soup.points.push_back({90, 90, 90});
  const auto fin = static_cast<std::uint32_t>(soup.points.size() - 1);
  soup.triangles.push_back({fin, fin, 0});
  EXPECT_EQ(check_mesh(overlap).value().self_intersections,
            check_mesh(soup).value().self_intersections);
  EXPECT_GT(check_mesh(soup).value().self_intersections, 0u);
}

/// A soup, because its last triangle uses a vertex twice.
std::size_t crossings_in_soup(std::vector<glm::dvec3> points,
                              std::vector<std::array<std::uint32_t, 3>> triangles) {
  triangles.push_back({0, 0, 1});
  return check_mesh({std::move(points), std::move(triangles)}).value().self_intersections;
}

TEST(MeshCrossings, FindsOverlapOfTrianglesThatShareAnEdge) {
  EXPECT_EQ(crossings_in_soup({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}),
            1u);
  EXPECT_EQ(
      crossings_in_soup({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, -1, 0}}, {{0, 1, 2}, {1, 0, 3}}), 0u);
  EXPECT_EQ(
      crossings_in_soup({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 1, 1e-9}}, {{0, 1, 2}, {1, 0, 3}}),
      0u);
}

TEST(MeshCrossings, FindsCrossingOfTrianglesThatShareAVertex) {
  // A side of the second pierces the first above (1, 1), and not the reverse. The order of the
  // search depends on which reaches lower; the shear reverses it.
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

TEST(MeshCrossings, StopsCountingAtTheLimit) {
  TriangleMesh mesh = ball(5.0);
  for (int i = 1; i < 60; ++i) mesh = together(mesh, moved(ball(5.0), {i * 1e-3, i * 2e-3, 0}));
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_EQ(report.self_intersections, 100'000u);
}

}  // namespace
}  // namespace clay::solid
