#include "export/solid/seam_cure.hpp"

#include "claystack/export/proof.hpp"
#include "export/fallen/pockets.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <vector>

namespace clay::solid {
namespace {

/// A cube with an additional point at `x` on its edge from (0, 0, 0) to (8, 0, 0), displaced by
/// `off`.
TriangleMesh cube_with_a_point_on_its_edge(double x, glm::dvec3 off = glm::dvec3{0.0}) {
  TriangleMesh mesh = shapes::cube(8);
  mesh.points.push_back(glm::dvec3{x, 0, 0} + off);
  std::erase(mesh.triangles, std::array<std::uint32_t, 3>{0, 2, 1});
  std::erase(mesh.triangles, std::array<std::uint32_t, 3>{0, 1, 5});
  for (const auto& t :
       std::vector<std::array<std::uint32_t, 3>>{{0, 2, 8}, {8, 2, 1}, {0, 8, 5}, {8, 1, 5}})
    mesh.triangles.push_back(t);
  return mesh;
}

std::vector<bool> only(std::size_t count, std::size_t point) {
  std::vector<bool> flags(count, false);
  flags.at(point) = true;
  return flags;
}

TEST(SeamCure, CollapsesShortEdgesToThePointOfThePart) {
  const TriangleMesh mesh = cube_with_a_point_on_its_edge(1e-4);
  ASSERT_TRUE(check_mesh(mesh).value().sound());
  const auto cured = cure_seam(mesh, only(9, 8), 1e-3);
  ASSERT_TRUE(cured);
  EXPECT_TRUE(check_mesh(cured->mesh).value().sound());
  EXPECT_EQ(cured->mesh.points.size(), 8u);
  EXPECT_EQ(cured->mesh.triangles.size(), 12u);
  EXPECT_EQ(signed_volume(cured->mesh), 512.0);
  EXPECT_DOUBLE_EQ(cured->max_move_mm, 1e-4);
}

TEST(SeamCure, KeepsLongEdgesAndEdgesOffTheSeam) {
  const TriangleMesh mesh = cube_with_a_point_on_its_edge(1e-4);
  for (const auto& cured :
       {cure_seam(mesh, only(9, 6), 1e-3), cure_seam(mesh, only(9, 8), 0.9e-4)}) {
    ASSERT_TRUE(cured);
    EXPECT_EQ(cured->mesh.points, mesh.points);
    EXPECT_EQ(cured->mesh.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(cured->max_move_mm, 0.0);
  }
}

TEST(SeamCure, FlipsTheLongestEdgeOfFlatTriangles) {
  // A point beside the diagonal of the bottom: a triangle 1e-5 mm high on an edge of 11 mm.
  TriangleMesh mesh = shapes::cube(8);
  mesh.points.emplace_back(4 + 1e-5, 4, 0);
  std::erase(mesh.triangles, std::array<std::uint32_t, 3>{0, 2, 1});
  for (const auto& t : std::vector<std::array<std::uint32_t, 3>>{{0, 2, 8}, {2, 1, 8}, {1, 0, 8}})
    mesh.triangles.push_back(t);
  ASSERT_TRUE(check_mesh(mesh).value().sound());
  const auto cured = cure_seam(mesh, only(9, 8), 1e-3);
  ASSERT_TRUE(cured);
  EXPECT_TRUE(check_mesh(cured->mesh).value().sound());
  EXPECT_EQ(cured->mesh.triangles.size(), mesh.triangles.size());
  EXPECT_NEAR(signed_volume(cured->mesh), 512.0, 1e-9);
  double lowest = 1e9;
  for (const auto& [a, b, c] : cured->mesh.triangles) {
    const glm::dvec3 p = cured->mesh.points[a], q = cured->mesh.points[b],
                     r = cured->mesh.points[c];
    const double longest =
        std::max({glm::distance(p, q), glm::distance(q, r), glm::distance(r, p)});
    lowest = std::min(lowest, glm::length(glm::cross(q - p, r - p)) / longest);
  }
  EXPECT_GT(lowest, 1.0);
}

TEST(SeamCure, NeverFoldsTheSurface) {
  // The bottom, with a short edge from 8 to 9. Collapsing 8 to 9 would flip a wedge beside it (8 10
  // 11), but collapsing 9 to 8 would not.
  TriangleMesh mesh = shapes::cube(8);
  for (const glm::dvec2 p : {glm::dvec2{4, 4}, {4.00095, 4}, {4.0006, 4.01}, {4.0006, 6}, {4.5, 5}})
    mesh.points.emplace_back(p, 0.0);
  std::erase(mesh.triangles, std::array<std::uint32_t, 3>{0, 2, 1});
  std::erase(mesh.triangles, std::array<std::uint32_t, 3>{0, 3, 2});
  for (const auto& [a, b, c] : std::vector<std::array<std::uint32_t, 3>>{{8, 9, 10},
                                                                         {8, 10, 11},
                                                                         {9, 12, 10},
                                                                         {10, 12, 11},
                                                                         {8, 11, 3},
                                                                         {0, 8, 3},
                                                                         {0, 1, 8},
                                                                         {8, 1, 9},
                                                                         {9, 1, 2},
                                                                         {9, 2, 12},
                                                                         {12, 2, 11},
                                                                         {11, 2, 3}})
    mesh.triangles.push_back({c, b, a});
  ASSERT_TRUE(check_mesh(mesh).value().sound()) << check_mesh(mesh).value().problems.front().where;
  const auto cured = cure_seam(mesh, only(13, 8), 1e-3);
  ASSERT_TRUE(cured);
  EXPECT_EQ(cured->mesh.points.size(), 12u);
  EXPECT_TRUE(check_mesh(cured->mesh).value().sound());
}

TEST(SeamCure, KeepsATetrahedron) {
  const TriangleMesh mesh{{{0, 0, 0}, {1e-4, 0, 0}, {0, 5, 0}, {0, 0, 5}},
                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  ASSERT_TRUE(check_mesh(mesh).value().sound());
  EXPECT_TRUE(check_mesh(cure_seam(mesh, std::vector<bool>(4, true), 1e-3)->mesh).value().sound());
}

TEST(SeamCure, RefusesANonManifoldMesh) {
  TriangleMesh open = shapes::cube(8);
  open.triangles.pop_back();
  EXPECT_FALSE(cure_seam(open, only(8, 0), 1e-3));
}

TEST(Pockets, FillsShallowPocketsOfTheSeam) {
  const TriangleMesh hole = shapes::inverted(shapes::moved(shapes::cube(0.1), {4, 4, 4}));
  TriangleMesh mesh = shapes::together(shapes::cube(8), hole);
  mesh.points.emplace_back(1, 2, 3);  // unused
  const auto fill = [&](std::size_t seam, double deepest) {
    return fill_pockets(mesh, only(mesh.points.size(), seam), deepest);
  };
  // The depth of a cube by this measure is half its side: the radius of its inscribed ball.
  const FilledPockets filled = fill(10, 0.051);
  EXPECT_EQ(filled.mesh, shapes::cube(8));
  EXPECT_EQ(filled.on_seam, std::vector<bool>(8, false));
  EXPECT_EQ(filled.pockets, 1u);
  EXPECT_NEAR(filled.volume_mm3, 1e-3, 1e-12);
  EXPECT_NEAR(filled.max_ball_mm, 0.05, 1e-12);
  for (const FilledPockets& kept : {fill(10, 0.049), fill(3, 0.051)}) {
    EXPECT_EQ(kept.pockets, 0u);
    EXPECT_EQ(kept.mesh.triangles.size(), 24u);
    EXPECT_EQ(kept.mesh.points.size(), 16u);
  }
}

/// A cube of 2 mm with a thin plate at one corner: its volume over its area is that of the plate,
/// but the cube holds a ball of 1 mm.
TEST(Pockets, BoundsTheBallInAPocketThatIsNotConvex) {
  TriangleMesh pocket = shapes::cube(2);
  TriangleMesh plate = shapes::cube(20);
  for (glm::dvec3& p : plate.points) p = glm::dvec3{2.0} + p * glm::dvec3{1.0, 1.0, 5e-4};
  pocket = shapes::together(pocket, plate);
  const auto corner = [&](std::size_t from) {
    const auto at = std::find(pocket.points.begin() + static_cast<std::ptrdiff_t>(from),
                              pocket.points.end(), glm::dvec3{2.0});
    return static_cast<std::uint32_t>(at - pocket.points.begin());
  };
  for (auto& triangle : pocket.triangles)
    std::replace(triangle.begin(), triangle.end(), corner(8), corner(0));
  const double volume = 8.0 + 20.0 * 20.0 * 0.01, area = 24.0 + 800.0 + 0.8;
  const FilledPockets filled = fill_pockets(shapes::inverted(pocket), std::vector<bool>(16, true),
                                            3.0 * volume / area + 1e-9);
  ASSERT_EQ(filled.pockets, 1u);
  EXPECT_GE(filled.max_ball_mm, 1.0);
  EXPECT_LE(filled.max_ball_mm, std::cbrt(0.75 * volume / std::numbers::pi) + 1e-9);
}

TEST(Pockets, ComputesVolumesOfShells) {
  const TriangleMesh mesh = shapes::together(
      shapes::cube(8), shapes::inverted(shapes::moved(shapes::cube(2), {3, 3, 3})));
  std::vector<double> volumes = shell_volumes(mesh);
  std::sort(volumes.begin(), volumes.end());
  ASSERT_EQ(volumes.size(), 2u);
  EXPECT_DOUBLE_EQ(volumes[0], -8.0);
  EXPECT_DOUBLE_EQ(volumes[1], 512.0);
}

}  // namespace
}  // namespace clay::solid
