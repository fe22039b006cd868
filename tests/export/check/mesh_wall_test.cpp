#include "claystack/export/check.hpp"
#include "claystack/export/walls.hpp"

#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace clay::solid {
namespace {

using shapes::cube;
using shapes::inverted;
using shapes::moved;
using shapes::together;

constexpr std::size_t kSegments = 48;

/// A revolve of `segments` steps is wider than its profile by the equal-volume factor, and its
/// facets are nearer to the axis than its corners.
double facet_scale(std::size_t segments) {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(segments);
  return std::sqrt(step / std::sin(step)) * std::cos(step / 2.0);
}

TriangleMesh cup(double outer_mm, double wall_mm, double height_mm, double floor_mm) {
  const double inner_mm = outer_mm - wall_mm;
  return revolve({{{{0, 0},
                    {outer_mm, 0},
                    {outer_mm, height_mm},
                    {inner_mm, height_mm},
                    {inner_mm, floor_mm},
                    {0, floor_mm}}}},
                 kSegments);
}

SampledWall wall_of(const TriangleMesh& mesh, std::size_t samples = 10'000) {
  return sampled_wall(mesh, samples).value();
}

TEST(SampledWall, EqualsTheSideOfACube) {
  const SampledWall wall = wall_of(cube(2.0));
  EXPECT_DOUBLE_EQ(wall.least_mm, 2.0);
  EXPECT_EQ(wall.rays, 10'000u);
  EXPECT_EQ(wall.escaped, 0u);
}

TEST(SampledWall, IsInvariantUnderTranslationAndScale) {
  for (const double side : {1e-3, 1.0, 1e5}) {
    const SampledWall wall = wall_of(moved(cube(side), glm::dvec3(-3.0, 7.0, 0.5) * side));
    EXPECT_NEAR(wall.least_mm, side, 1e-14 * side);
    EXPECT_EQ(wall.escaped, 0u);
  }
}

TEST(SampledWall, EqualsTheThinnerOfWallAndFloorOfACup) {
  const SampledWall by_wall = wall_of(cup(40.0, 2.5, 60.0, 6.0));
  EXPECT_NEAR(by_wall.least_mm, 2.5 * facet_scale(kSegments), 1e-9);
  EXPECT_EQ(by_wall.escaped, 0u);
  const double axis_distance = std::hypot(by_wall.place.x, by_wall.place.y);
  EXPECT_GT(axis_distance, 37.0);  // on the wall
  const SampledWall by_floor = wall_of(cup(40.0, 5.0, 60.0, 1.75));
  EXPECT_NEAR(by_floor.least_mm, 1.75, 1e-9);
  EXPECT_NEAR(by_floor.place.z, by_floor.place.z > 1.0 ? 1.75 : 0.0, 1e-9);  // on the floor
}

TEST(SampledWall, OfASphericalShellLiesBetweenFacetAndCornerThickness) {
  // Facets of both balls are parallel, those of the inner one nearer to the middle.
  const auto shell = [](double outer, double inner) {
    return together(shapes::ball(outer), inverted(shapes::ball(inner)));
  };
  const SampledWall wall = wall_of(shell(10.0, 8.0), 100'000);
  // A facet's plane is at least cos(pi/16) cos(pi/12) of the radius away, at most all of it.
  const double flat = std::cos(std::numbers::pi / 16.0) * std::cos(std::numbers::pi / 12.0);
  EXPECT_GT(wall.least_mm, 2.0 * flat * 0.999);
  EXPECT_LT(wall.least_mm, 2.0 * std::sqrt(1.05));
  EXPECT_EQ(wall.escaped, 0u);
}

TEST(SampledWall, IgnoresTheEdgeOfALeaningRim) {
  // A rim at 80 degrees to a wall of 3 mm: rays from near the edge leave through the wall after a
  // short distance, which is no wall thickness.
  const double lean = std::tan(10.0 * std::numbers::pi / 180.0);
  const double height = 60.0, horizontal = 3.0;
  const auto at = [&](double y) { return 30.0 + lean * y; };
  const TriangleMesh flaring = revolve({{{{0, 0},
                                          {at(0), 0},
                                          {at(height), height},
                                          {at(height) - horizontal, height},
                                          {at(8) - horizontal, 8},
                                          {0, 8}}}},
                                       kSegments);
  const SampledWall wall = wall_of(flaring);
  EXPECT_GT(wall.oblique, 0u);
  // Across: the horizontal width times the cosine of the inclination, on the cut through the
  // facets.
  EXPECT_GT(wall.least_mm, 2.8);
  EXPECT_LT(wall.least_mm, 3.0);
}

TEST(SampledWall, IgnoresTheWedgeBetweenALevelRimAndALeaningWall) {
  // At 39 to 44 degrees between rim and wall, a ray from the rim meets the wall at an acute angle.
  for (const double lean : {-51.0, -49.0, -47.0, -45.5, 45.5, 47.0, 49.0, 51.0}) {
    const double slope = std::tan(lean * std::numbers::pi / 180.0);
    const double wide = 2.0 / std::cos(lean * std::numbers::pi / 180.0);  // 2 mm, seen level
    const Profile pot{{{{68, 0},
                        {70, 0},
                        {70, 15},
                        {70 + 15 * slope, 30},
                        {70 + 15 * slope - wide, 30},
                        {68, 15 + (wide - 2) / slope}}}};
    EXPECT_NEAR(min_wall_mm(pot), 2.0, 1e-9) << lean;
    EXPECT_NEAR(wall_of(revolve(pot, kSegments)).least_mm, 2.0, 2.0 * 0.01) << lean;
  }
}

TEST(SampledWall, FindsASharpBevelAndNotABluntOne) {
  // A wall of 4 mm whose lip is bevelled to 0.2 mm. A blunt wedge is thin nowhere.
  const auto bevelled = [](double degrees) {
    const double high = 3.8 / std::tan(degrees * std::numbers::pi / 180.0);
    const Profile pot{{{{36, 0}, {40, 0}, {40, 40}, {36.2, 40 + high}, {36, 40 + high}}}};
    return wall_of(revolve(pot, kSegments)).least_mm;
  };
  EXPECT_LT(bevelled(10.0), 0.5);
  EXPECT_LT(bevelled(20.0), 0.8);
  for (const double blunt : {39.0, 41.0, 43.0, 44.5, 50.0, 70.0}) {
    EXPECT_NEAR(bevelled(blunt), 4.0, 4.0 * 0.01) << blunt;
  }
}

TEST(SampledWall, FindsTheThinnestPlace) {
  // A slab with a dent that leaves 0.4 of 5 mm, on a twentieth of its area.
  const TriangleMesh dented =
      revolve({{{{0, 0}, {20, 0}, {20, 5}, {6, 5}, {6, 0.4}, {0, 0.4}}}}, kSegments);
  const SampledWall wall = wall_of(dented, 1000);
  EXPECT_NEAR(wall.least_mm, 0.4, 1e-12);
  const auto& [a, b, c] = dented.triangles[wall.triangle];
  const double z = (dented.points[a].z + dented.points[b].z + dented.points[c].z) / 3.0;
  EXPECT_NEAR(z, wall.place.z, 1e-9);
}

TEST(SampledWall, IgnoresTheEndOfALip) {
  // A tube of 4 mm whose lip is rounded to 2 mm over the last 1.5 mm, and one that stays at 2 mm
  // for another 8 mm.
  const auto lip = [](double narrow) {
    return wall_of(revolve({{{{36, 0},
                              {40, 0},
                              {40, 40},
                              {39, 41.5},
                              {39, 41.6 + narrow},
                              {37, 41.6 + narrow},
                              {37, 41.5},
                              {36, 40}}}},
                           kSegments));
  };
  // The middle of a facet is nearer to the axis than its sides.
  EXPECT_NEAR(lip(0.0).least_mm, 4.0, 4.0 * 0.02);
  EXPECT_NEAR(lip(8.0).least_mm, 2.0, 2.0 * 0.02);
}

TEST(SampledWall, IgnoresAFootBelowALeaningNeck) {
  // Straight up from the middle of the foot, a line soon meets the neck; the clay goes on beside
  // it.
  const Profile pot{{{{40, 0},
                      {44, 0},
                      {44, 0.3},
                      {42.2, 1.8},
                      {41.6, 4},
                      {46, 12},
                      {46, 40},
                      {34, 40},
                      {34, 12},
                      {36, 4},
                      {40, 0.3}}}};
  EXPECT_GT(wall_of(revolve(pot, kSegments)).least_mm, min_wall_mm(pot) * 0.98);
  EXPECT_GT(min_wall_mm(pot), 5.0);
}

TEST(SampledWall, OfARodIsItsDiameter) {
  const SampledWall rod = wall_of(revolve({{{{0, 0}, {3, 0}, {3, 40}, {0, 40}}}}, kSegments));
  EXPECT_NEAR(rod.least_mm, 6.0, 6.0 * 0.02);
}

TEST(SampledWall, OfABarIsItsThinnerSide) {
  const auto bar = [](double a, double b, double c) {
    TriangleMesh mesh = cube(1.0);
    for (glm::dvec3& p : mesh.points) p *= glm::dvec3(a, b, c);
    return mesh;
  };
  for (const double ratio : {1.0, 1.1, 1.3, 1.41, 1.5, 1.7, 1.99, 2.0, 2.1, 2.2, 2.5, 3.0, 10.0})
    for (const double length : {2.0, 20.0, 50.0}) {
      EXPECT_NEAR(wall_of(bar(2.0, 2.0 * ratio, 2.0 * length)).least_mm, 2.0, 1e-9) << ratio;
      EXPECT_NEAR(wall_of(bar(2.0 * length, 2.0, 2.0 * ratio)).least_mm, 2.0, 1e-9) << ratio;
    }
  // A bar beside a thick block is found.
  const TriangleMesh both = together(cube(20.0), moved(bar(2.0, 3.0, 40.0), {40.0, 0.0, 0.0}));
  EXPECT_NEAR(wall_of(both, 50'000).least_mm, 2.0, 1e-9);
}

TEST(SampledWall, OfARingIsItsThinnerSide) {
  const double scale = facet_scale(kSegments);
  for (const double high : {2.0, 2.5, 3.0, 4.0, 5.0}) {
    const Profile flat{{{{20, 0}, {22, 0}, {22, high}, {20, high}}}};
    EXPECT_NEAR(wall_of(revolve(flat, kSegments)).least_mm, 2.0 * scale, 0.02) << high;
    EXPECT_NEAR(min_wall_mm(flat), 2.0, 1e-9);
    const Profile wide{{{{20, 0}, {20.0 + high, 0}, {20.0 + high, 2}, {20, 2}}}};
    EXPECT_NEAR(wall_of(revolve(wide, kSegments)).least_mm, 2.0, 0.02) << high;
  }
}

TEST(SampledWall, CountsRaysThatEscapeThroughAHole) {
  TriangleMesh mesh = cube(2.0);
  std::erase(mesh.triangles, (std::array<std::uint32_t, 3>{4, 5, 6}));
  std::erase(mesh.triangles, (std::array<std::uint32_t, 3>{4, 6, 7}));
  const SampledWall wall = wall_of(mesh);
  // The open side is an end of every ray; the thickest place is about the middle.
  EXPECT_NEAR(wall.least_mm, 2.0, 0.01);
  EXPECT_LE(wall.least_mm, 2.0);
  EXPECT_NEAR(static_cast<double>(wall.escaped), 2000.0, 5.0);  // one of five sides
}

TEST(SampledWall, FindsNoWallOnAnOpenSheet) {
  const SampledWall wall = wall_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 100);
  EXPECT_EQ(wall.escaped, 100u);
  EXPECT_TRUE(std::isinf(wall.least_mm));
}

TEST(SampledWall, RaysPassCoplanarNeighbours) {
  // A fine grid on top of a cube: every ray starts in the plane of hundreds of triangles.
  Polygon disc{{0, 0}};
  for (int i = 1; i <= 40; ++i) disc.push_back({0.25 * i, 0.0});
  for (int i = 40; i >= 1; --i) disc.push_back({0.25 * i, 3.0});
  disc.push_back({0.0, 3.0});
  TriangleMesh mesh = revolve({{disc}}, kSegments);
  // Tilted, so that no coordinate is exact.
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (glm::dvec3& p : mesh.points) p = {c * p.x - s * p.z, p.y + 0.1, s * p.x + c * p.z};
  const SampledWall wall = wall_of(mesh);
  EXPECT_NEAR(wall.least_mm, 3.0, 1e-12);
  EXPECT_EQ(wall.escaped, 0u);
}

TEST(SampledWall, FollowsFewerRaysBeyondTheStepLimit) {
  const TriangleMesh mesh = cup(40.0, 2.5, 60.0, 6.0);
  std::size_t reported = 0;
  const auto half = sampled_wall(mesh, 10'000, 400'000, [&](std::size_t rays) {
                      EXPECT_GT(rays, reported);
                      reported = rays;
                    }).value();
  EXPECT_GT(half.rays, 1'000u);
  EXPECT_LT(half.rays, 9'000u);
  EXPECT_EQ(reported, 10'000u);
  // The remaining rays cover all of the surface, and find the same minimum wall.
  EXPECT_NEAR(half.least_mm, 2.5 * facet_scale(kSegments), 1e-9);
  const SampledWall all = wall_of(mesh);
  EXPECT_EQ(all.rays, 10'000u);
  EXPECT_NEAR(static_cast<double>(half.oblique) / static_cast<double>(half.rays),
              static_cast<double>(all.oblique) / 10'000.0, 0.05);
}

TEST(SampledWall, RespectsTheStepLimitOnASoup) {
  // Every ray passes nearly all of these.
  TriangleMesh soup;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const auto at = [&](double k) {
      const double t = k + 0.001 * i;
      return glm::dvec3(50.0 * std::sin(7.0 * t), 50.0 * std::sin(11.0 * t), 50.0 * std::cos(t));
    };
    soup.points.insert(soup.points.end(), {at(0.0), at(1.0), at(2.0)});
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const auto wall = sampled_wall(soup, 1'000, 100'000).value();
  EXPECT_LT(wall.rays, 500u);
  EXPECT_GT(wall.rays, 20u);
}

TEST(SampledWall, IsDeterministic) {
  const TriangleMesh mesh = cup(40.0, 2.5, 60.0, 6.0);
  const SampledWall once = wall_of(mesh), again = wall_of(mesh);
  EXPECT_EQ(once.least_mm, again.least_mm);
  EXPECT_EQ(once.place, again.place);
  EXPECT_EQ(once.triangle, again.triangle);
  EXPECT_EQ(once.oblique, again.oblique);
}

TEST(SampledWall, ReportsAFailureOfTheLibraryAsIo) {
  const auto wall =
      sampled_wall(cube(1.0), 10, 1'000'000, [](std::size_t) { throw std::runtime_error("odd"); });
  ASSERT_FALSE(wall);
  EXPECT_EQ(wall.error().kind, ErrorKind::io);
  EXPECT_EQ(wall.error().message, "wall not measured: odd");
}

TEST(SampledWall, RefusesAMeshWithoutArea) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const TriangleMesh& mesh :
       {TriangleMesh{}, TriangleMesh{{{0, 0, 0}}, {{0, 0, 0}}},
        TriangleMesh{{{0, 0, 0}}, {{0, 1, 2}}},
        TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, nan, 0}}, {{0, 1, 2}}}}) {
    const auto wall = sampled_wall(mesh, 10);
    ASSERT_FALSE(wall);
    EXPECT_EQ(wall.error().kind, ErrorKind::bad_input);
  }
  EXPECT_FALSE(sampled_wall(cube(1.0), 0));
  EXPECT_FALSE(sampled_wall(cube(1.0), kMostWallSamples + 1));
}

}  // namespace
}  // namespace clay::solid
