// Vertices and edges of many triangles: the same pairs as by comparing all, and in time. The sizes
// are such that a quadratic search would exceed the time limit of a test.

#include "export/proof/soup_intersections.hpp"

#include "claystack/export/proof.hpp"
#include "export/proof/intersecting_pairs.hpp"
#include "export/proof/pair_test.hpp"
#include "export/solid/cgal_versions.hpp"
#include "tests/export/solid/shapes.hpp"

#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace clay::solid {
namespace {

using shapes::together;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Triangle_3 triangle_of(const TriangleMesh& mesh, std::size_t t) {
  const auto point = [&](std::size_t corner) {
    const glm::dvec3& p = mesh.points[mesh.triangles[t][corner]];
    return Kernel::Point_3(p.x, p.y, p.z);
  };
  return {point(0), point(1), point(2)};
}

/// By the intersection that CGAL constructs: a point if one vertex is shared, a segment between two
/// corners if an edge is shared; any other intersection counts.
bool meet_by_construction(const TriangleMesh& mesh, std::size_t i, std::size_t j) {
  const Triangle &a = mesh.triangles[i], &b = mesh.triangles[j];
  const auto shared = std::count_if(a.begin(), a.end(), [&](std::uint32_t v) {
    return std::find(b.begin(), b.end(), v) != b.end();
  });
  if (shared == 3) return false;
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  const CGAL::Cartesian_converter<Kernel, Exact> exact;
  const auto common = CGAL::intersection(exact(triangle_of(mesh, i)), exact(triangle_of(mesh, j)));
  if (!common) return false;
  if (shared == 0) return true;
  if (shared == 1) return cgal::get_if<Exact::Point_3>(*common) == nullptr;
  return cgal::get_if<Exact::Segment_3>(*common) == nullptr;
}

std::vector<TrianglePair> by_construction(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> spread;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (!triangle_of(mesh, t).is_degenerate()) spread.push_back(t);
  std::vector<TrianglePair> pairs;
  for (std::size_t i = 0; i < spread.size(); ++i)
    for (std::size_t j = i + 1; j < spread.size(); ++j)
      if (meet_by_construction(mesh, spread[i], spread[j]))
        pairs.emplace_back(spread[i], spread[j]);
  return pairs;
}

Fault found(const TriangleMesh& mesh) {
  SoupIntersections search(mesh);
  for (std::size_t part = 0; part < search.parts(); ++part) search.search(part);
  return search.found();
}

/// A disc about point 0, its rim going `turns` times around; heights of the rim by `z(step)`.
template <class Height>
TriangleMesh disc(std::uint32_t steps, std::uint32_t turns, const Height& z) {
  TriangleMesh mesh{{{0, 0, 0}}, {}};
  for (std::uint32_t i = 0; i < steps; ++i) {
    const double angle = 2.0 * std::numbers::pi * turns * i / steps;
    mesh.points.emplace_back(10.0 * std::cos(angle), 10.0 * std::sin(angle), z(i));
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % steps});
  }
  return mesh;
}

std::vector<std::uint32_t> first_of(const std::vector<TrianglePair>& pairs) {
  if (pairs.empty()) return {};
  return {pairs.front().first, pairs.front().second};
}

void expect_same(const TriangleMesh& mesh, std::size_t least) {
  const std::vector<TrianglePair> expected = by_construction(mesh);
  const Fault fault = found(mesh);
  EXPECT_GE(expected.size(), least);
  EXPECT_EQ(fault.count, expected.size());
  EXPECT_EQ(fault.triangles, first_of(expected));
  EXPECT_EQ(intersecting_pairs(mesh, 1'000'000), expected);
}

TEST(FanIntersections, FindsNoneInADisc) {
  expect_same(disc(100, 1, [](auto) { return 0.0; }), 0);
  EXPECT_EQ(found(disc(100, 1, [](auto i) { return i % 2 ? 1.0 : -1.0; })).count, 0u);
}

TEST(FanIntersections, FindsThoseOfADiscWoundTwice) {
  expect_same(disc(101, 2, [](auto) { return 0.0; }), 101);
  // Like a screw: it intersects itself along at least one spoke.
  expect_same(disc(101, 2, [](auto i) { return 0.01 * i; }), 1);
}

TEST(FanIntersections, FindsThoseOfAFoldedDisc) {
  TriangleMesh mesh = disc(100, 1, [](auto) { return 0.0; });
  std::swap(mesh.points[20], mesh.points[23]);
  expect_same(mesh, 3);
}

TEST(FanIntersections, FindsATriangleThroughAFan) {
  TriangleMesh mesh = disc(100, 1, [](auto) { return 3.0; });
  for (const glm::dvec3& tip : {glm::dvec3(3, 4, 2), {3, 4, 1.4}, {3, 4, 1.6}})
    mesh.points.push_back(tip);
  TriangleMesh through = mesh, clear = mesh;
  through.triangles.push_back({0, 101, 102});  // from the vertex of the fan
  expect_same(through, 1);
  clear.triangles.push_back({0, 101, 103});
  expect_same(clear, 0);
}

TEST(FanIntersections, FindsThoseOfTrianglesOnOneEdge) {
  TriangleMesh book{{{0, 0, 0}, {1, 2, 3}}, {}};
  for (std::uint32_t i = 0; i < 60; ++i) {
    const double angle = 0.1 * i;
    book.points.emplace_back(std::round(1e3 * std::cos(angle)), std::round(1e3 * std::sin(angle)),
                             500);
    book.triangles.push_back({0, 1, 2 + i});
  }
  expect_same(book, 0);
  // Two triangles in the half-plane of the eleventh, one opposite, and a duplicate, which does not
  // count.
  const glm::dvec3 way = book.points[12];
  book.points.insert(book.points.end(), {way * 2.0, way + book.points[1], way * -1.0});
  book.triangles.insert(book.triangles.end(), {{62, 1, 0}, {0, 1, 63}, {1, 0, 64}, {12, 0, 1}});
  expect_same(book, 5);
}

RC_GTEST_PROP(FanIntersections, MatchCgalOnRandomSoups, ()) {
  // On a small grid many triangles are coplanar, collinear or equal; most share few vertices.
  const int side = *rc::gen::inRange(3, 12);
  TriangleMesh mesh;
  const std::uint32_t points = *rc::gen::inRange<std::uint32_t>(6, 60);
  for (std::uint32_t i = 0; i < points; ++i) {
    const auto coordinate = rc::gen::inRange(0, side);
    mesh.points.emplace_back(*coordinate, *coordinate, *coordinate);
  }
  const auto any = rc::gen::inRange<std::uint32_t>(0, points);
  const auto few = rc::gen::inRange<std::uint32_t>(0, 3);
  for (int i = 0; i < 90; ++i) {
    const int kind = *rc::gen::inRange(0, 8);
    Triangle t{kind < 6 ? *few : *any, kind < 3 ? *few : *any, *any};
    std::rotate(t.begin(), t.begin() + i % 3, t.end());
    mesh.triangles.push_back(t);
  }
  const std::vector<TrianglePair> expected = by_construction(mesh);
  RC_ASSERT(found(mesh).count == expected.size());
  RC_ASSERT(found(mesh).triangles == first_of(expected));
  RC_ASSERT(intersecting_pairs(mesh, 1'000'000) == expected);
}

/// Both orders of two triangles, in each of the planes between two axes.
void expect_exact(TriangleMesh mesh) {
  for (int turn = 0; turn < 3; ++turn) {
    const PairTest test(mesh);
    const bool expected = meet_by_construction(mesh, 0, 1);
    EXPECT_EQ(test.meet(mesh.triangles[0], mesh.triangles[1]), expected);
    EXPECT_EQ(test.meet(mesh.triangles[1], mesh.triangles[0]), expected);
    for (glm::dvec3& p : mesh.points) p = {p.z, p.x, p.y};
  }
}

TEST(PairTest, IsExactNearALineThroughTheSharedSide) {
  // From Kettner et al., "Classroom examples of robustness problems in geometric computations"
  // (2008): near the line through these two points, floating point gets many sides wrong.
  const glm::dvec3 from{17.300000000000001, 17.300000000000001, 0.0};
  const glm::dvec3 to{24.000000000000050, 24.000000000000051777, 0.0};
  constexpr int kPlaces = 24;
  std::size_t meeting = 0;
  for (int i = 0; i < kPlaces * kPlaces; ++i) {
    const glm::dvec3 near{0.50000000000002531 + 0x1p-53 * (i / kPlaces),
                          0.5000000000000171 + 0x1p-53 * (i % kPlaces), 0.0};
    for (const double x : {0.25, 0.75}) {  // on either side of the line
      const TriangleMesh mesh{{from, to, near, {x, 0.5, 0.0}}, {{0, 1, 2}, {0, 1, 3}}};
      if (PairTest(mesh).degenerate(mesh.triangles[0])) continue;
      meeting += meet_by_construction(mesh, 0, 1);
      expect_exact(mesh);
    }
  }
  EXPECT_GT(meeting, 100u);
}

TEST(FanIntersections, SoundFansOfManyTrianglesAreFast) {
  constexpr std::size_t kSegments = 30'000;
  for (const Polygon& section :
       {Polygon{{0, 0}, {50, 0}, {50, 80}, {0, 80}}, Polygon{{0, 0}, {50, 0}, {0, 80}},
        Polygon{{0, 0}, {50, 20}, {0, 21}, {0, 2}}, Polygon{{30, 0}, {50, 0}, {30, 80}}}) {
    const MeshReport report = check_mesh(revolve({{section}}, kSegments)).value();
    EXPECT_TRUE(report.sound());
  }
}

/// Two cubes that cross, beside a cone.
TEST(FanIntersections, ListsPairsBesideAFanOfManyTriangles) {
  const TriangleMesh cone = revolve({{{{0, 0}, {50, 0}, {0, 80}}}}, 30'000);
  const TriangleMesh crossing =
      together(shapes::cube(2.0), shapes::moved(shapes::cube(2.0), {1, 1, 1}));
  const auto expected = by_construction(crossing);
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(intersecting_pairs(together(shapes::moved(crossing, {90, 0, 0}), cone), 1'000'000),
            expected);
}

TEST(FanIntersections, FansInSeveralShellsAreFast) {
  const TriangleMesh one = revolve({{{{0, 0}, {50, 0}, {0, 80}}}}, 30'000);
  const TriangleMesh inner = revolve({{{{0, 10}, {30, 10}, {0, 50}}}}, 30'000);
  const MeshReport report =
      check_mesh(together(together(one, shapes::inverted(inner)), shapes::moved(one, {101, 0, 0})))
          .value();
  EXPECT_TRUE(report.sound());
  EXPECT_EQ(report.components, 3u);
}

TEST(FanIntersections, EdgeOfManyTrianglesIsFast) {
  constexpr std::uint32_t kLeaves = 100'000;
  TriangleMesh book{{{0, 0, 0}, {0.1, 0.2, 1}}, {}};
  for (std::uint32_t i = 0; i < kLeaves; ++i) {
    const double angle = 6.0 * i / kLeaves;
    book.points.emplace_back(std::cos(angle), std::sin(angle), 0.5);
    book.triangles.push_back({0, 1, 2 + i});
  }
  EXPECT_EQ(found(book).count, 0u);
  for (auto& [a, b, apex] : book.triangles) book.points[apex] = {1.0 + apex, 0.0, 0.0};
  EXPECT_EQ(found(book).count, kMaxSelfIntersections);
}

TEST(FanIntersections, EqualTrianglesAreFast) {
  TriangleMesh same{{{0, 0, 0}, {1, 0.3, 0.7}, {0.2, 1, 0.1}}, {}};
  same.triangles.assign(300'000, {0, 1, 2});
  const MeshReport report = check_mesh(same).value();
  EXPECT_EQ(report.self_intersections, 0u);
  // The same with separate corners.
  TriangleMesh apart;
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    apart.points.insert(apart.points.end(), same.points.begin(), same.points.end());
    apart.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_EQ(check_mesh(apart).value().self_intersections, kMaxSelfIntersections);
}

TEST(FanIntersections, DegenerateTrianglesOnOneVertexAreFast) {
  constexpr std::uint32_t kMany = 1'000'000;
  TriangleMesh mesh{{{0, 0, 0}}, {}};
  for (std::uint32_t i = 1; i <= kMany; ++i) {
    mesh.points.emplace_back(i, 2.0 * i, 0.5 * i);
    mesh.triangles.push_back({0, i, i % kMany + 1});
  }
  EXPECT_EQ(check_mesh(mesh).value().degenerate, kMany);
}

TEST(FanIntersections, EqualBoxesAreFast) {
  // Each has all its corners beyond the plane of the previous one, on the same edges of a cube.
  constexpr std::uint32_t kMany = 100'000;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kMany; ++i) {
    const double s = 0.45 + 0.1 * i / kMany;
    mesh.points.insert(mesh.points.end(), {{0, 0, s}, {1, 1 - s, 0}, {s, 1, 1}});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_EQ(found(mesh).count, 0u);
}

}  // namespace
}  // namespace clay::solid
