#include "claystack/export/proof.hpp"

#include "tests/export/proof/mesh_verdict.hpp"
#include "tests/export/solid/shapes.hpp"

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

TEST(CheckMesh, CubeIsSound) {
  const MeshReport report = check_mesh(cube(2.0)).value();
  EXPECT_TRUE(report.sound()) << names(report);
  EXPECT_EQ(verdict(report), kSound);
  EXPECT_EQ(report.triangles, 12u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.degenerate, 0u);
  EXPECT_DOUBLE_EQ(report.volume_mm3, 8.0);
}

TEST(CheckMesh, EmptyMeshIsNotSound) {
  EXPECT_FALSE(check_mesh({}).value().sound());
  EXPECT_FALSE(check_mesh({{{1, 2, 3}}, {}}).value().sound());
}

TEST(CheckMesh, ReportsAHole) {
  TriangleMesh mesh = cube(2.0);
  mesh.triangles.pop_back();
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_EQ(verdict(report), (Verdict{false, true, true, false, false}));
  ASSERT_EQ(report.problems.size(), 1u) << names(report);
  EXPECT_EQ(report.problems[0].what, "open edge");
  EXPECT_EQ(report.problems[0].count, 3u);
}

TEST(CheckMesh, ReportsAFlippedFace) {
  TriangleMesh mesh = cube(2.0);
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_EQ(verdict(report), (Verdict{true, true, false, false, false}));
  ASSERT_EQ(report.problems.size(), 1u) << names(report);
  EXPECT_EQ(report.problems[0].count, 3u);
  EXPECT_NE(report.problems[0].where.find("3"), std::string::npos);
}

TEST(CheckMesh, ReportsAFin) {
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back({3, -3, 1});
  mesh.triangles.push_back({0, 1, 8});
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_FALSE(report.closed);
  EXPECT_FALSE(report.manifold);
  EXPECT_EQ(report.self_intersections, 0u);
  ASSERT_TRUE(find(report, "non-manifold edge")) << names(report);
  EXPECT_EQ(find(report, "non-manifold edge")->count, 1u);
  EXPECT_EQ(find(report, "open edge")->count, 2u);
  EXPECT_NE(find(report, "non-manifold edge")->where.find("(1, 0, 0) mm"), std::string::npos);
}

TEST(CheckMesh, ReportsADuplicateFace) {
  TriangleMesh mesh = cube(2.0);
  mesh.triangles.push_back(mesh.triangles[4]);
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_FALSE(report.manifold);
  ASSERT_TRUE(find(report, "duplicate triangle")) << names(report);
  EXPECT_EQ(find(report, "duplicate triangle")->count, 1u);
  EXPECT_NE(find(report, "duplicate triangle")->where.find("5, 13"), std::string::npos);
}

/// The sum over the triangles then depends on the origin: it was negative here, and the cube was
/// reported as inside out.
TEST(CheckMesh, StatesNoVolumeWhereAPartOfTheFacesIsThereTwice) {
  TriangleMesh mesh = together(cube(8.0), inverted(moved(cube(4.0), {2.0, 2.0, 2.0})));
  ASSERT_TRUE(check_mesh(mesh).value().sound());
  const std::vector<std::array<std::uint32_t, 3>> cavity(mesh.triangles.begin() + 12,
                                                         mesh.triangles.end() - 2);
  for (int copy = 0; copy < 20; ++copy)
    mesh.triangles.insert(mesh.triangles.end(), cavity.begin(), cavity.end());
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_FALSE(report.has_volume);
  EXPECT_TRUE(find(report, "duplicate triangle")) << names(report);
  EXPECT_FALSE(find(report, "inside out")) << names(report);
  EXPECT_TRUE(report.oriented);
  EXPECT_FALSE(enclosure_of(mesh).volume_mm3);
  EXPECT_FALSE(enclosure_of(mesh).inward());
  // If all faces are there twice, the volume is twice that of one copy, for any position of the
  // mesh.
  const TriangleMesh all = moved(together(cube(2.0), cube(2.0)), {40.0, 0.0, 0.0});
  TriangleMesh twice{{all.points.begin(), all.points.begin() + 8}, all.triangles};
  for (auto& triangle : twice.triangles)
    for (std::uint32_t& v : triangle) v %= 8;
  EXPECT_TRUE(check_mesh(twice).value().has_volume);
  EXPECT_DOUBLE_EQ(check_mesh(twice).value().volume_mm3, 16.0);
}

TEST(CheckMesh, ReportsATwoSidedTriangle) {
  const MeshReport report =
      check_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}).value();
  EXPECT_FALSE(report.sound());
  EXPECT_TRUE(find(report, "duplicate triangle")) << names(report);
}

TEST(CheckMesh, ReportsACrackOfOneUlp) {
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back(mesh.points[6]);
  mesh.points.back().z = std::nextafter(2.0, 3.0);
  for (const std::size_t t : {2u, 3u})
    std::replace(mesh.triangles[t].begin(), mesh.triangles[t].end(), 6u, 8u);
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_FALSE(report.closed);
  EXPECT_TRUE(report.manifold);
  EXPECT_TRUE(report.oriented);
  EXPECT_EQ(find(report, "open edge")->count, 4u) << names(report);
}

TEST(CheckMesh, ReportsADegenerateSliver) {
  // A vertex in the middle of an edge: the face beside it is split, and the sliver closes the gap.
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back({1, 0, 0});
  std::erase(mesh.triangles, (std::array<std::uint32_t, 3>{0, 1, 5}));
  mesh.triangles.insert(mesh.triangles.end(), {{0, 8, 5}, {8, 1, 5}, {0, 1, 8}});
  const MeshReport report = check_mesh(mesh).value();
  // The faces on both sides of the sliver touch along it, which is an intersection.
  EXPECT_EQ(verdict(report), (Verdict{true, true, true, false, true})) << names(report);
  EXPECT_EQ(report.degenerate, 1u);
  ASSERT_EQ(report.problems.size(), 2u) << names(report);
  EXPECT_EQ(report.problems[0].what, "degenerate triangle");
  EXPECT_EQ(report.problems[0].where.substr(0, 11), "triangle 14");
}

TEST(CheckMesh, ReportsATriangleWithARepeatedVertexAndClosedRest) {
  TriangleMesh mesh = cube(2.0);
  mesh.triangles.push_back({0, 0, 1});
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.degenerate, 1u);
  EXPECT_FALSE(report.sound());
}

TEST(CheckMesh, ReportsConesThatTouchInAPoint) {
  TriangleMesh mesh = together(cube(2.0), moved(cube(2.0), {2, 2, 2}));
  for (auto& t : mesh.triangles)
    for (auto& v : t)
      if (v == 8) v = 6;  // the corner (2, 2, 2) that both have
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_EQ(verdict(report), (Verdict{true, false, true, false, false})) << names(report);
  ASSERT_EQ(report.problems.size(), 1u) << names(report);
  EXPECT_EQ(report.problems[0].what, "non-manifold vertex");
  EXPECT_NE(report.problems[0].where.find("(2, 2, 2) mm"), std::string::npos);
  EXPECT_EQ(report.components, 2u);
}

TEST(CheckMesh, ReportsNonFinitePoints) {
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = cube(2.0);
    mesh.points[5].y = x;
    const MeshReport report = check_mesh(mesh).value();
    ASSERT_TRUE(find(report, "non-finite point")) << names(report);
    EXPECT_EQ(find(report, "non-finite point")->where, "point 6");
    EXPECT_FALSE(report.bounds_volume);
  }
}

TEST(CheckMesh, ReportsAnIndexOutOfRange) {
  TriangleMesh mesh = cube(2.0);
  mesh.triangles[7][1] = 8;
  const MeshReport report = check_mesh(mesh).value();
  ASSERT_EQ(report.problems.size(), 1u) << names(report);
  EXPECT_EQ(report.problems[0].what, "index out of range");
  EXPECT_EQ(report.problems[0].where, "triangle 8");
}

TEST(CheckMesh, IgnoresUnusedPoints) {
  TriangleMesh mesh = cube(2.0);
  mesh.points.push_back({50, 50, 50});
  EXPECT_TRUE(check_mesh(mesh).value().sound());
}

RC_GTEST_PROP(CheckMesh, ReportsOnAnySoup, ()) {
  TriangleMesh mesh;
  const auto points = *rc::gen::inRange<std::uint32_t>(1, 9);
  for (std::uint32_t i = 0; i < points; ++i)
    mesh.points.emplace_back(*rc::gen::inRange(0, 3), *rc::gen::inRange(0, 3),
                             *rc::gen::inRange(0, 3));
  const auto count = *rc::gen::inRange(0, 16);
  const auto index = rc::gen::inRange<std::uint32_t>(0, points);
  for (int i = 0; i < count; ++i) mesh.triangles.push_back({*index, *index, *index});
  const MeshReport report = check_mesh(mesh).value();
  RC_ASSERT(report.triangles == mesh.triangles.size());
  const bool all_well = report.closed && report.manifold && report.oriented &&
                        report.bounds_volume && report.self_intersections == 0 &&
                        report.degenerate == 0;
  RC_ASSERT(report.sound() == all_well);
}

RC_GTEST_PROP(CheckMesh, DetectsEveryRemovedOrFlippedTriangle, (const ClayStack& stack)) {
  const auto found = profile_of(stack);
  if (!found || !certify(found->profile)) RC_DISCARD("no certificate");
  const TriangleMesh mesh = revolve(found->profile, 5);
  const auto victim = *rc::gen::inRange<std::size_t>(0, mesh.triangles.size());
  TriangleMesh holed = mesh;
  holed.triangles.erase(holed.triangles.begin() + static_cast<std::ptrdiff_t>(victim));
  RC_ASSERT(!check_mesh(holed).value().closed);
  TriangleMesh flipped = mesh;
  std::swap(flipped.triangles[victim][0], flipped.triangles[victim][1]);
  RC_ASSERT(!check_mesh(flipped).value().oriented);
}

TEST(SignedVolume, IsTranslationInvariant) {
  EXPECT_DOUBLE_EQ(signed_volume(cube(2.0)), 8.0);
  EXPECT_DOUBLE_EQ(signed_volume(inverted(cube(2.0))), -8.0);
  EXPECT_NEAR(signed_volume(moved(cube(2.0), {4096, -8192, 1024})), 8.0, 1e-12);
  EXPECT_EQ(signed_volume({}), 0.0);
}

TEST(MeshEnclosure, CountsEdgesAndMeasuresTheVolume) {
  const MeshEnclosure whole = enclosure_of(cube(2.0));
  EXPECT_EQ(whole.open_edges, 0u);
  EXPECT_EQ(whole.flipped_edges, 0u);
  EXPECT_DOUBLE_EQ(whole.volume_mm3.value(), 8.0);
  EXPECT_FALSE(whole.inward());
  EXPECT_TRUE(enclosure_of(inverted(cube(2.0))).inward());
  // Two cubes that intersect are not sound, but they enclose a volume.
  const MeshEnclosure two = enclosure_of(together(cube(2.0), moved(cube(2.0), {1.0, 1.0, 1.0})));
  EXPECT_DOUBLE_EQ(two.volume_mm3.value(), 16.0);
}

TEST(MeshEnclosure, NamesTheFirstOpenAndTheFirstFlippedEdge) {
  const auto on_edge = [](const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle,
                          const glm::dvec3& at) {
    bool found = false;
    for (std::size_t i = 0; i < 3; ++i)
      found |= at == 0.5 * (mesh.points[triangle[i]] + mesh.points[triangle[(i + 1) % 3]]);
    return found;
  };
  TriangleMesh open = cube(2.0);
  const auto lost = open.triangles.back();
  open.triangles.pop_back();
  const MeshEnclosure holed = enclosure_of(open);
  EXPECT_EQ(holed.open_edges, 3u);
  EXPECT_TRUE(on_edge(open, lost, holed.open_at));
  EXPECT_FALSE(holed.volume_mm3);

  TriangleMesh turned = cube(2.0);
  std::swap(turned.triangles[5][0], turned.triangles[5][1]);
  const MeshEnclosure flipped = enclosure_of(turned);
  EXPECT_EQ(flipped.flipped_edges, 3u);
  EXPECT_TRUE(on_edge(turned, turned.triangles[5], flipped.flipped_at));
  EXPECT_FALSE(flipped.volume_mm3);
}

}  // namespace
}  // namespace clay::solid
