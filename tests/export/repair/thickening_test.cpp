// Walls that are made around open surfaces.

#include "claystack/export/proof.hpp"
#include "claystack/export/repair.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace clay::solid {
namespace {

/// A beaker of flat walls, as an open surface: corners at `foot_mm` from the axis at the floor, and
/// at `mouth_mm` at the height.
struct Beaker {
  std::uint32_t sides = 6;
  double foot_mm = 0.0, mouth_mm = 0.0, height_mm = 0.0;

  [[nodiscard]] TriangleMesh surface() const {
    TriangleMesh mesh{{{0, 0, 0}}, {}};
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      for (const bool top : {false, true}) {
        const double radius = top ? mouth_mm : foot_mm;
        mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                 top ? height_mm : 0.0);
      }
      const std::uint32_t a = 1 + 2 * i, b = 1 + 2 * ((i + 1) % sides);
      mesh.triangles.insert(mesh.triangles.end(), {{0, b, a}, {a, b, b + 1}, {a, b + 1, a + 1}});
    }
    return mesh;
  }
};

/// The distances from the axis at which a level ray leaves or enters the mesh, in order.
std::vector<double> crossings(const TriangleMesh& mesh, double height_mm, double angle) {
  const glm::dvec3 from(0.0, 0.0, height_mm), way(std::cos(angle), std::sin(angle), 0.0);
  std::vector<double> found;
  for (const auto& [i, j, k] : mesh.triangles) {
    const glm::dvec3 a = mesh.points[i] - from, b = mesh.points[j] - from,
                     c = mesh.points[k] - from;
    const std::array sides = {glm::dot(way, glm::cross(a, b)), glm::dot(way, glm::cross(b, c)),
                              glm::dot(way, glm::cross(c, a))};
    const auto [least, most] = std::ranges::minmax(sides);
    if (least < 0.0 && most > 0.0) continue;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double mm = glm::dot(normal, a) / glm::dot(normal, way);
    if (mm > 0.0) found.push_back(mm);
  }
  std::ranges::sort(found);
  return found;
}

constexpr double kRoundingMm = 1e-3;

TEST(Thickening, AFlatWallHasTheThicknessEverywhere) {
  for (const std::uint32_t sides : {4U, 6U, 12U, 48U})
    for (const double mm : {1.0, 4.0}) {
      const Beaker beaker{sides, 35.0, 35.0, 80.0};
      const auto thick = repair_mesh(beaker.surface(), {.thicken_mm = mm});
      ASSERT_TRUE(thick) << thick.error().message;
      EXPECT_TRUE(check_mesh(thick->mesh).value().sound());
      // A prism of this distance between axis and sides, with a cavity that opens at the top.
      const double near = 35.0 * std::cos(std::numbers::pi / sides), half = 0.5 * mm;
      const auto base = [&](double inner) {
        return sides * std::tan(std::numbers::pi / sides) * inner * inner;
      };
      const double mm3 = base(near + half) * (80.0 + half) - base(near - half) * (80.0 - half);
      EXPECT_NEAR(signed_volume(thick->mesh), mm3, 1e-4 * mm3) << sides << " " << mm;
      for (std::uint32_t side = 0; side < sides; ++side) {
        // Not along an edge between two triangles.
        const double angle = 2.0 * std::numbers::pi * (side + 0.5) / sides;
        const auto at = crossings(thick->mesh, 41.3, angle);
        ASSERT_EQ(at.size(), 2U) << sides << " " << mm << " " << side;
        EXPECT_NEAR(at[0], near - half, kRoundingMm);
        EXPECT_NEAR(at[1], near + half, kRoundingMm);
      }
      ASSERT_TRUE(thick->thickened);
      EXPECT_FALSE(thick->thickened->wrapped);
      EXPECT_GE(thick->thickened->least_mm, mm);
      EXPECT_NEAR(thick->thickened->least_mm, mm, kRoundingMm);
      EXPECT_NEAR(thick->thickened->median_mm, mm, kRoundingMm);
    }
}

TEST(Thickening, ASlantedWallHasTheThicknessAcrossIt) {
  const Beaker beaker{48, 30.0, 35.0, 80.0};
  const auto thick = repair_mesh(beaker.surface(), {.thicken_mm = 4.0});
  ASSERT_TRUE(thick) << thick.error().message;
  const double slope = 5.0 * std::cos(std::numbers::pi / 48.0) / 80.0;
  const double level_mm = 4.0 * std::hypot(1.0, slope);
  for (int side = 0; side < 48; ++side) {
    const auto at = crossings(thick->mesh, 41.3, std::numbers::pi * (2 * side + 1) / 48.0);
    ASSERT_EQ(at.size(), 2U);
    EXPECT_NEAR(at[1] - at[0], level_mm, kRoundingMm);
  }
}

TEST(Thickening, ABellyHasAtLeastTheThicknessAndLittleMore) {
  // The lower part of a ball of 30 mm, cut above its middle.
  TriangleMesh bowl = shapes::ball(30.0);
  std::erase_if(bowl.triangles, [&](const auto& t) {
    return std::ranges::any_of(t, [&](auto p) { return bowl.points[p].z > 15.0; });
  });
  const auto thick = repair_mesh(bowl, {.thicken_mm = 3.0});
  ASSERT_TRUE(thick) << thick.error().message;
  EXPECT_FALSE(thick->thickened->wrapped);
  for (int side = 0; side < 12; ++side) {
    const double angle = std::numbers::pi * (2 * side + 1) / 12.0;
    const auto at = crossings(thick->mesh, 0.01, angle);
    ASSERT_EQ(at.size(), 2U);
    // The facets at the middle lean by up to 11.25 degrees.
    EXPECT_GE(at[1] - at[0], 3.0);
    EXPECT_LE(at[1] - at[0], 1.1 * 3.0 / std::cos(std::numbers::pi / 16.0));
  }
}

TEST(Thickening, FillsASmallHoleOfTheSurface) {
  TriangleMesh beaker = Beaker{48, 35.0, 35.0, 80.0}.surface();
  beaker.triangles.erase(beaker.triangles.begin() + 31);
  const auto thick = repair_mesh(beaker, {.thicken_mm = 4.0});
  ASSERT_TRUE(thick) << thick.error().message;
  EXPECT_EQ(thick->holes.size(), 1U);
  const auto& mesh = thick->mesh;
  // Points, less edges, plus triangles are 2 for a ball, and 0 for a ring, as a wall with a hole.
  EXPECT_EQ(mesh.points.size(), mesh.triangles.size() / 2 + 2);
}

TEST(Thickening, AClosedPartDoesNotBecomeHollow) {
  const TriangleMesh both = shapes::together(Beaker{48, 35.0, 35.0, 80.0}.surface(),
                                             shapes::moved(shapes::cube(20.0), {100, 0, 0}));
  const auto thick = repair_mesh(both, {.thicken_mm = 6.0});
  ASSERT_TRUE(thick) << thick.error().message;
  EXPECT_TRUE(thick->thickened->wrapped);
  EXPECT_EQ(check_mesh(thick->mesh).value().cavities, 0U);
}

TEST(Thickening, AWrapIsThickerThanRequestedByABoundedShare) {
  // The foot is narrower than half the wall, so that moved vertices cross.
  const Beaker funnel{12, 0.5, 30.0, 60.0};
  const auto thick = repair_mesh(funnel.surface(), {.thicken_mm = 4.0});
  ASSERT_TRUE(thick) << thick.error().message;
  EXPECT_TRUE(thick->thickened->wrapped);
  EXPECT_GE(thick->thickened->median_mm, 4.0);
  EXPECT_LE(thick->thickened->median_mm, 1.16 * 4.0);
  const auto at = crossings(thick->mesh, 41.3, std::numbers::pi / 12.0);
  ASSERT_EQ(at.size(), 2U);
  const double level_mm = 4.0 * std::hypot(1.0, 29.5 * std::cos(std::numbers::pi / 12.0) / 60.0);
  EXPECT_GE(at[1] - at[0], 0.95 * level_mm);
  EXPECT_LE(at[1] - at[0], 1.16 * level_mm);
}

TEST(Thickening, MissingPartsKeepAWideHoleOpen) {
  // The opening of a ball at 45 degrees has no rim: cap and ball meet at less than 60 degrees.
  TriangleMesh bowl = shapes::ball(20.0);
  std::erase_if(bowl.triangles, [&](const auto& t) {
    return std::ranges::all_of(t, [&](auto p) { return bowl.points[p].z > 14.0; });
  });
  EXPECT_TRUE(repair_mesh(bowl));
  const auto refused = repair_mesh(bowl, {.parts_missing = true});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::unsound);
  // Opposite corners of the border: 20 sqrt(2) mm apart, times sqrt(pi/3), because a ring of 12
  // corners has the area of its circle.
  EXPECT_NE(refused.error().message.find("found one 28.94 mm wide"), std::string::npos)
      << refused.error().message;
  EXPECT_TRUE(repair_mesh(bowl, {.cap_openings = true, .parts_missing = true}));
}

}  // namespace
}  // namespace clay::solid
