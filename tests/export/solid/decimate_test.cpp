#include "claystack/export/solid.hpp"

#include "claystack/export/proof.hpp"
#include "export/solid/surface_distance.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using shapes::ball;
using shapes::cube;
using shapes::moved;
using shapes::together;

/// A cube whose faces are grids of `steps` squares with shared points.
TriangleMesh grid_cube(double side_mm, int steps) {
  TriangleMesh mesh;
  const auto add = [&](glm::dvec3 origin, glm::dvec3 u, glm::dvec3 v) {
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        const auto corner = [&](int a, int b) {
          const glm::dvec3 p = origin + u * static_cast<double>(a) + v * static_cast<double>(b);
          const auto known = std::find(mesh.points.begin(), mesh.points.end(), p);
          if (known == mesh.points.end()) mesh.points.push_back(p);
          return static_cast<std::uint32_t>(std::find(mesh.points.begin(), mesh.points.end(), p) -
                                            mesh.points.begin());
        };
        const auto a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                   d = corner(i, j + 1);
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      }
  };
  const double s = side_mm / steps, l = side_mm;
  const glm::dvec3 x{s, 0, 0}, y{0, s, 0}, z{0, 0, s};
  add({0, 0, 0}, y, x);
  add({0, 0, l}, x, y);
  add({0, 0, 0}, x, z);
  add({0, l, 0}, z, x);
  add({0, 0, 0}, z, y);
  add({l, 0, 0}, y, z);
  return mesh;
}

/// A bellied vase, 200 mm high, with a floor of 6 mm and a wall of 3 mm across.
TriangleMesh smooth_vase(std::size_t bands, std::size_t segments) {
  const auto outer = [](double t) { return 50.0 + 18.0 * std::sin(6.9 * t - 0.6) - 8.0 * t; };
  Polygon section{{0.0, 0.0}};
  const auto at = [&](std::size_t i) {
    return static_cast<double>(i) / static_cast<double>(bands);
  };
  for (std::size_t i = 0; i <= bands; ++i) section.push_back({outer(at(i)), 200.0 * at(i)});
  for (std::size_t i = bands; 200.0 * at(i) > 6.0; --i)
    section.push_back({outer(at(i)) - 3.0, 200.0 * at(i)});
  section.push_back({0.0, 6.0});
  return revolve({{section}}, segments);
}

TEST(Decimate, FlatFacesHaveNoError) {
  for (const glm::dvec3& by : {glm::dvec3(0.0), glm::dvec3(4096.0, -1024.0, 512.0)}) {
    const TriangleMesh fine = moved(grid_cube(8.0, 8), by);
    ASSERT_EQ(fine.triangles.size(), 768u);
    ASSERT_TRUE(check_mesh(fine).value().sound());
    const auto coarse = decimate(fine, 12);
    ASSERT_TRUE(coarse) << coarse.error().message;
    EXPECT_EQ(coarse->mesh.triangles.size(), 12u);
    EXPECT_EQ(coarse->max_error_mm, 0.0);
    const MeshReport report = check_mesh(coarse->mesh).value();
    EXPECT_TRUE(report.sound());
    EXPECT_DOUBLE_EQ(report.volume_mm3, 512.0);
  }
}

TEST(Decimate, NamesMissingMemory) {
  const auto result =
      decimate(grid_cube(8.0, 32), 12, {.cancelled = []() -> bool { throw std::bad_alloc(); }});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::io);
  EXPECT_EQ(result.error().message, "decimation stopped: not enough memory");
}

/// An exception in the middle of the work, as OpenMesh may throw one, is no fault of the mesh.
TEST(Decimate, ReportsAFailureOfTheLibraryAsIo) {
  const auto result = decimate(grid_cube(8.0, 32), 12,
                               {.cancelled = []() -> bool { throw std::runtime_error("odd"); }});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::io);
  EXPECT_EQ(result.error().message, "decimation failed: odd");
}

TEST(Decimate, InclinedFlatFacesHaveNoError) {
  TriangleMesh fine = grid_cube(8.0, 8);
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (glm::dvec3& p : fine.points) {
    p = {c * p.x - s * p.z, p.y, s * p.x + c * p.z};
    p = {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
  }
  const auto coarse = decimate(fine, 12);
  ASSERT_TRUE(coarse) << coarse.error().message;
  EXPECT_LT(coarse->max_error_mm, 1e-13);
  EXPECT_NEAR(signed_volume(coarse->mesh), 512.0, 1e-10);
}

TEST(Decimate, VaseAtATenthStaysSoundAndClose) {
  const TriangleMesh fine = smooth_vase(60, 64);
  const std::size_t tenth = fine.triangles.size() / 10;
  const auto coarse = decimate(fine, tenth);
  ASSERT_TRUE(coarse) << coarse.error().message;
  EXPECT_LE(coarse->mesh.triangles.size(), tenth);
  EXPECT_TRUE(check_mesh(coarse->mesh).value().sound());
  EXPECT_GT(coarse->max_error_mm, 0.0);
  EXPECT_LT(coarse->max_error_mm, 3.0);  // the wall
  // Every remaining point is an original one.
  for (const glm::dvec3& p : coarse->mesh.points)
    ASSERT_NE(std::find(fine.points.begin(), fine.points.end(), p), fine.points.end());
}

/// A bowl whose lip is that of a thrown one.
TriangleMesh bowl_with_lip(std::size_t segments) {
  return revolve(
      {{{{0.0, 0.0},    {34.0, 0.0},   {87.15, 88.4}, {87.17, 88.5}, {87.21, 88.7}, {87.26, 88.9},
         {87.30, 89.1}, {87.25, 89.3}, {87.16, 89.5}, {87.00, 89.7}, {86.84, 89.9}, {86.68, 90.1},
         {86.47, 90.3}, {86.25, 90.5}, {86.02, 90.7}, {85.71, 90.9}, {84.92, 91.1}, {84.92, 91.2},
         {82.92, 91.2}, {82.92, 91.1}, {83.06, 90.9}, {82.71, 90.7}, {82.49, 90.5}, {82.27, 90.3},
         {82.04, 90.1}, {81.88, 89.9}, {81.76, 89.7}, {81.64, 89.5}, {81.50, 89.3}, {81.36, 89.1},
         {81.22, 88.9}, {81.12, 88.7}, {81.02, 88.5}, {80.97, 88.4}, {28.6, 7.0},   {0.0, 7.0}}}},
      segments);
}

/// The least cosine between the normals of neighbouring triangles.
double sharpest_cosine(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, glm::dvec3> beside;
  double least = 1.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto& p = mesh.points;
    const glm::dvec3 normal = glm::normalize(glm::cross(p[b] - p[a], p[c] - p[a]));
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      beside[{from, to}] = normal;
      if (const auto other = beside.find({to, from}); other != beside.end())
        least = std::min(least, glm::dot(normal, other->second));
    }
  }
  return least;
}

TEST(Decimate, FoldsNoTriangleOverItsNeighbour) {
  const TriangleMesh fine = bowl_with_lip(120);
  ASSERT_GT(sharpest_cosine(fine), -0.34);
  for (const std::size_t share : {2u, 3u, 5u, 8u}) {
    const auto coarse = decimate(fine, fine.triangles.size() / share);
    ASSERT_TRUE(coarse) << coarse.error().message;
    EXPECT_GE(sharpest_cosine(coarse->mesh), -0.34) << share;
  }
}

TEST(Decimate, MeasuresTheErrorFromRemovedVertices) {
  // A ball reduced to a few triangles: the largest error is from a removed vertex to the surface,
  // found here by testing all points of a dense grid on it.
  const TriangleMesh fine = ball(10.0);
  const auto coarse = decimate(fine, 12);
  ASSERT_TRUE(coarse) << coarse.error().message;
  double farthest = 0.0;
  for (const glm::dvec3& p : fine.points) {
    double nearest = 1e300;
    for (const auto& [a, b, c] : coarse->mesh.triangles)
      for (int i = 0; i <= 60; ++i)
        for (int j = 0; i + j <= 60; ++j) {
          const double u = i / 60.0, v = j / 60.0;
          const auto& q = coarse->mesh.points;
          nearest = std::min(nearest, glm::distance(p, q[a] * (1.0 - u - v) + q[b] * u + q[c] * v));
        }
    farthest = std::max(farthest, nearest);
  }
  EXPECT_LE(coarse->max_error_mm, farthest);
  EXPECT_GE(coarse->max_error_mm, farthest - 0.25);  // the grid's half-width: sides of 20 mm by 60
}

TEST(Decimate, ReturnsAMeshWithinTheLimitUnchanged) {
  const auto same = decimate(cube(2.0), 12);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->mesh, cube(2.0));
  EXPECT_EQ(same->max_error_mm, 0.0);
}

TEST(Decimate, ReportsItsProgressAndCancels) {
  const TriangleMesh fine = smooth_vase(120, 128);
  std::vector<double> shares;
  std::atomic<std::size_t> asked{0};
  DecimateOptions options;
  options.progress = [&](double share) { shares.push_back(share); };
  options.cancelled = [&] { return ++asked == 0; };
  const auto whole = decimate(fine, fine.triangles.size() / 10, options);
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_GT(shares.size(), 6U);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.front(), 0.0);
  EXPECT_EQ(shares.back(), 1.0);
  const std::size_t all = asked;
  ASSERT_GT(all, 20U);
  for (const std::size_t until : {std::size_t{0}, all / 8, all / 4, all / 2}) {
    asked = 0;
    options.cancelled = [&] { return ++asked > until; };
    const auto stopped = decimate(fine, fine.triangles.size() / 10, options);
    ASSERT_FALSE(stopped) << until << " of " << all;
    EXPECT_EQ(stopped.error().kind, ErrorKind::io);
    EXPECT_EQ(stopped.error().message, "decimation stopped: cancelled");
  }
}

TEST(Decimate, ReportsTheNumberReached) {
  // Two solids need at least four triangles each.
  const auto stuck = decimate(together(cube(2.0), moved(cube(2.0), {9, 0, 0})), 7);
  ASSERT_FALSE(stuck);
  EXPECT_EQ(stuck.error().kind, ErrorKind::bad_input);
  EXPECT_EQ(stuck.error().message,
            "expected a limit of at least 8 triangles, below which no edge of this mesh may "
            "collapse, found 7");
}

TEST(Decimate, RefusesAMeshThatIsNotAClosedManifold) {
  TriangleMesh open = ball(5.0);
  open.triangles.pop_back();
  TriangleMesh fin = cube(2.0);
  fin.points.push_back({3, -3, 1});
  fin.triangles.push_back({0, 1, 8});
  TriangleMesh flipped = ball(5.0);
  std::swap(flipped.triangles[3][0], flipped.triangles[3][1]);
  TriangleMesh beyond = cube(2.0);
  beyond.triangles[7][1] = 8;
  for (const TriangleMesh& mesh : {open, fin, flipped, beyond, TriangleMesh{}}) {
    const auto refused = decimate(mesh, 4);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::unsound);
    EXPECT_NE(refused.error().message.find("manifold mesh to decimate"), std::string::npos);
  }
  EXPECT_EQ(decimate(cube(2.0), 3).error().kind, ErrorKind::bad_input);
}

TEST(SurfaceDistance, IsTheMaximumFromBothSides) {
  EXPECT_DOUBLE_EQ(surface_distance(cube(2.0), moved(cube(2.0), {0, 0, 0.5})), 0.5);
  // A spike of 3 on one of them, measured from both sides.
  TriangleMesh spiked = cube(2.0);
  spiked.points[6] = {2, 2, 5};
  EXPECT_DOUBLE_EQ(surface_distance(cube(2.0), spiked), 3.0);
  EXPECT_DOUBLE_EQ(surface_distance(spiked, cube(2.0)), 3.0);
  // Points on the other's faces have no distance.
  EXPECT_EQ(surface_distance(grid_cube(2.0, 4), cube(2.0)), 0.0);
}

}  // namespace
}  // namespace clay::solid
