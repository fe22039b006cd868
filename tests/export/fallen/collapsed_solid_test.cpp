#include "claystack/export/fallen.hpp"

#include "claystack/export/formats.hpp"
#include "tests/export/fallen/collapsed_pots.hpp"
#include "tests/export/formats/refused.hpp"
#include "tests/export/solid/mesh_surface.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <string>

namespace clay::solid {
namespace {

using shapes::fallen;
using shapes::stack_of;
using shapes::surface_mm2;
constexpr double kPi = std::numbers::pi;

Result<CollapsedSolid> united(const Pot& pot, std::size_t segments,
                              Smoothing smoothing = Smoothing::none, double tolerance_mm = 0.02) {
  return collapsed_parts(pot, smoothing, tolerance_mm).and_then([&](const CollapsedParts& parts) {
    return collapsed_solid(parts, *pot.collapse, segments, tolerance_mm);
  });
}

glm::dvec3 centroid_of(const TriangleMesh& mesh) {
  glm::dvec3 moment{0.0};
  for (const auto& [i, j, k] : mesh.triangles) {
    const glm::dvec3 a = mesh.points[i], b = mesh.points[j], c = mesh.points[k];
    moment += glm::dot(a, glm::cross(b, c)) / 24.0 * (a + b + c);
  }
  return moment / signed_volume(mesh);
}

::testing::AssertionResult refused(const Pot& pot, ErrorKind kind, const std::string& because) {
  return samples::refused(united(pot, 8), kind, because);
}

TEST(CollapsedSolid, ZeroRotationGivesTheStandingPot) {
  const auto solid = united(fallen(stack_of(10, {{10, 0}, {10, 0}}), 0, {3, 4, 5}, 0.0), 16);
  ASSERT_TRUE(solid) << solid.error().message;
  EXPECT_EQ(solid->overlap_mm3, 0.0);
  EXPECT_NEAR(solid->union_mm3, kPi * 100 * 20, 1e-9);
  EXPECT_EQ(solid->pieces, 1u);
  // Two storeys of walls and two caps: the faces where the parts touch are gone.
  EXPECT_EQ(solid->check.triangles, 6u * 16);
}

TEST(CollapsedSolid, HalfTurnAboutTheCutOverlapsEqualHalves) {
  for (const double toward : {0.0, 0.5 * kPi, 1.234}) {
    const auto solid = united(
        fallen(stack_of(10, {{12, 0}, {9, 5}, {9, 5}, {12, 0}}), 1, {0, 20, 0}, kPi, toward), 16);
    ASSERT_TRUE(solid) << solid.error().message;
    // Rotated against each other, facets overlap by the chord's height at most.
    const double half = kPi * 10 * (144 + 81 - 25), facets = half * (1.0 - std::cos(kPi / 16));
    EXPECT_NEAR(solid->lower_mm3, half, 1e-9);
    EXPECT_NEAR(solid->union_mm3, half, facets);
    EXPECT_NEAR(solid->overlap_mm3, half, facets);
    // A half turn about a corner's direction maps the polygon to itself, to the last bit.
    if (toward == 0.0) {
      EXPECT_NEAR(solid->overlap_mm3, half, 1e-9);
      EXPECT_LT(solid->max_move_mm, 1e-5);
    }
  }
}

TEST(CollapsedSolid, SquareBarsIntersectInTwoPyramids) {
  // Four segments make square bars, on edge, with half diagonal d; their axes are perpendicular. At
  // the distance t from the plane of the axes both are 2 (d - t) wide: 8 d^3 / 3 in all.
  const auto solid = united(fallen(stack_of(40, {{10, 0}, {10, 0}}), 0, {20, 40, 0}, kPi / 2), 4);
  ASSERT_TRUE(solid) << solid.error().message;
  const double d = 10 * std::sqrt(kPi / 2);
  EXPECT_NEAR(solid->overlap_mm3 / (8 * d * d * d / 3), 1.0, 1e-9);
  EXPECT_NEAR(solid->union_mm3 / (2 * kPi * 100 * 40 - 8 * d * d * d / 3), 1.0, 1e-9);
}

TEST(CollapsedSolid, CylindersIntersectInASteinmetzSolid) {
  const glm::dvec3 pivot{20 * std::cos(0.3), 40, 20 * std::sin(0.3)};
  const auto solid = united(fallen(stack_of(40, {{10, 0}, {10, 0}}), 0, pivot, kPi / 2, 0.3), 128);
  ASSERT_TRUE(solid) << solid.error().message;
  // 16 R^3 / 3, except for the facets: both polygons have the circle's area.
  EXPECT_NEAR(solid->overlap_mm3 / (16.0 / 3 * 1000), 1.0, 1e-3);
}

TEST(CollapsedSolid, AppliesTheShift) {
  // Shifted by its radius and down by 5 mm: the overlap is a lens of two circles at that distance.
  Pot pot = fallen(stack_of(40, {{10, 0}, {10, 0}}), 0, {20, 40, 0}, 0.0);
  pot.collapse->shift_mm = {-6.0, -5.0, 8.0};
  const auto solid = united(pot, 128);
  ASSERT_TRUE(solid) << solid.error().message;
  const double lens = 100 * (2 * kPi / 3 - std::sqrt(3.0) / 2);
  EXPECT_NEAR(solid->overlap_mm3 / (5 * lens), 1.0, 2e-3);
  EXPECT_NEAR(solid->union_mm3, 2 * kPi * 100 * 40 - solid->overlap_mm3, 1e-6);
  // A half turn, then back over the original foot.
  pot = fallen(stack_of(10, {{12, 0}, {9, 5}, {9, 5}, {12, 0}}), 1, {0, 20, 0}, kPi);
  pot.collapse->shift_mm = {0.0, 20.0, 0.0};
  EXPECT_EQ(united(pot, 16)->overlap_mm3, 0.0);
}

TEST(CollapsedSolid, SeparatePartsAreTwoBodies) {
  const auto solid = united(fallen(stack_of(10, {{10, 0}, {8, 4}}), 0, {40, 10, 0}, kPi), 20);
  ASSERT_TRUE(solid) << solid.error().message;
  EXPECT_EQ(solid->pieces, 2u);
  EXPECT_EQ(solid->check.components, 2u);
  EXPECT_EQ(solid->overlap_mm3, 0.0);
  EXPECT_NEAR(solid->union_mm3, kPi * 10 * (100 + 64 - 16), 1e-9);
  EXPECT_NEAR(solid->volume_mm3 / solid->union_mm3, 1.0, 1e-6);
}

TEST(CollapsedSolid, ReportsTrappedAirAsAVoid) {
  // A bell placed on a slab: a room of 15 mm radius and 8 mm height.
  const auto solid =
      united(fallen(stack_of(8, {{20, 0}, {20, 15}, {20, 0}}), 0, {20, 8, 0}, 0.0), 24);
  ASSERT_TRUE(solid) << solid.error().message;
  EXPECT_EQ(solid->voids, 1u);
  EXPECT_NEAR(solid->voids_mm3, kPi * 225 * 8, 0.01);
  EXPECT_EQ(solid->pieces, 1u);
  EXPECT_EQ(solid->pockets, 0u);
}

TEST(CollapsedSolid, KeepsCavitiesOfTheParts) {
  const auto solid =
      united(fallen(stack_of(5, {{20, 0}, {20, 10}, {20, 0}, {9, 0}, {9, 4}, {9, 0}}), 2,
                    {60, 15, 0}, 1.5),
             16);
  ASSERT_TRUE(solid) << solid.error().message;
  EXPECT_EQ(solid->voids, 2u);
  EXPECT_NEAR(solid->voids_mm3, kPi * 5 * (100 + 16), 0.01);
}

TEST(CollapsedSolid, CrownFallsAlone) {
  const Quanta third = quanta_from_radius(6.0) / 3;
  const auto alone = united(fallen(stack_of(3, {{9, 0}, {6, 0}}, third), 1, {30, 6, 0}, kPi), 8);
  ASSERT_TRUE(alone) << alone.error().message;
  EXPECT_NEAR(alone->upper_mm3, kPi * 36, 1e-6);
  EXPECT_EQ(alone->pieces, 2u);
  const auto with_a_ring =
      united(fallen(stack_of(3, {{9, 0}, {6, 0}}, third), 0, {30, 6, 0}, kPi), 8);
  EXPECT_NEAR(with_a_ring->upper_mm3, kPi * 36 * 4, 1e-6);
}

TEST(CollapsedSolid, WithoutClayAboveTheFailedRingThePotStands) {
  for (const WideQuanta crown : {WideQuanta{0}, WideQuanta{100}}) {
    const auto solid = united(fallen(stack_of(3, {{9, 0}, {6, 0}}, crown), 1, {6, 6, 0}, 2.0), 8);
    ASSERT_TRUE(solid) << solid.error().message;
    EXPECT_EQ(solid->upper_mm3, 0.0);
    EXPECT_EQ(solid->overlap_mm3, 0.0);
    EXPECT_NEAR(solid->volume_mm3 / (kPi * 3 * (81 + 36)), 1.0, 1e-6);
  }
}

TEST(CollapsedSolid, ClosesAGapBelowFloat32) {
  // Placed upside down, 2e-13 mm above the lower part.
  const Pot pot = fallen(stack_of(10, {{20, 0}, {20, 0}, {6, 0}}), 1, {0, 25 + 1e-13, 0}, kPi);
  const auto solid = united(pot, 16);
  ASSERT_TRUE(solid) << solid.error().message;
  EXPECT_EQ(solid->pieces, 1u);
  EXPECT_NEAR(solid->volume_mm3 / (kPi * 10 * (400 + 400 + 36)), 1.0, 1e-5);
  EXPECT_LT(solid->max_move_mm, 1e-3);
}

TEST(CollapsedSolid, KeepsPocketsDeeperThanTheTolerance) {
  // The bell sinks into the slab as it tilts, by half a millimetre at its axis. The remaining room,
  // 7.5 mm high, has a depth (three times volume over area) of 7.5 mm too.
  const double slope = 0.02, radius = 15, height = 8 - 25 * std::tan(slope);
  const Pot pot = fallen(stack_of(8, {{30, 0}, {20, radius}, {20, 0}}), 0, {-25, 8, 0}, -slope);
  const double room = kPi * radius * radius * height;
  const auto kept = united(pot, 32, Smoothing::none, 7.0);
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_EQ(kept->voids, 1u);
  EXPECT_EQ(kept->pockets, 0u);
  EXPECT_NEAR(kept->voids_mm3 / room, 1.0, 1e-3);
  const auto filled = united(pot, 32, Smoothing::none, 8.0);
  EXPECT_EQ(filled->voids, 0u);
  EXPECT_EQ(filled->pockets, 1u);
  EXPECT_NEAR(filled->pockets_mm3 / room, 1.0, 1e-3);
  EXPECT_NEAR(filled->volume_mm3, kept->volume_mm3 + room, 1e-3 * room);
}

TEST(CollapsedSolid, IsDeterministic) {
  const Pot pot = fallen(shapes::vase(100), 40, {45, 90, 3}, 1.3, 0.1);
  const auto once = united(pot, 40, Smoothing::fair), again = united(pot, 40, Smoothing::fair);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->mesh, again->mesh);
}

TEST(CollapsedSolid, RefusesAnInvalidCollapse) {
  const ClayStack stack = stack_of(3, {{9, 0}, {6, 0}});
  EXPECT_FALSE(collapsed_parts(shapes::pot_of(stack), Smoothing::none, 0.02));
  EXPECT_TRUE(refused(fallen(stack, 2, {6, 6, 0}, 1.0), ErrorKind::bad_input, "below 2"));
  EXPECT_TRUE(refused(fallen(stack, 0, {6, std::nan(""), 0}, 1.0), ErrorKind::bad_input, "pivot"));
  Pot tilted = fallen(stack, 0, {6, 6, 0}, 1.0);
  tilted.collapse->axis = {0, 0.6, 0.8};
  EXPECT_TRUE(refused(tilted, ErrorKind::bad_input, "horizontal"));
  const auto too_fine = united(fallen(stack, 0, {6, 6, 0}, 1.0), kMaxUnitedTriangles / 8 + 1);
  ASSERT_FALSE(too_fine);
  EXPECT_NE(too_fine.error().message.find("triangles"), std::string::npos);
}

TEST(CollapsedSolid, RefusesAPartLostInFloat32) {
  EXPECT_TRUE(refused(fallen(stack_of(5, {{20, 0}, {73, 73 - 1e-6}}), 0, {200, 9, 0}, 0.7),
                      ErrorKind::unsound, "the upper part in float32"));
}

/// From the counted stack alone.
bool holds(const Pot& pot, const glm::dvec3& p) {
  const Collapse& fall = *pot.collapse;
  const auto in = [&](const glm::dvec3& q, std::size_t first, std::size_t last) {
    const double level = q.y / pot.stack.ring_height_mm(), rho = std::hypot(q.x, q.z);
    if (!(level >= static_cast<double>(first) && level < static_cast<double>(last + 1)))
      return false;
    const Ring& ring = pot.stack.rings()[static_cast<std::size_t>(level)];
    return rho >= ring.inner_mm() && rho < ring.outer_mm();
  };
  return in(p, 0, fall.failed_ring) ||
         in(shapes::point_before_fall(fall, p), fall.failed_ring + 1, pot.stack.size() - 1);
}

TEST(CollapsedSolid, ContainsThePointsOfTheStack) {
  const Pot pot = fallen(shapes::vase(50), 22, {30, 95, 38}, 1.25, 0.9);
  const auto solid = united(pot, 256);
  ASSERT_TRUE(solid) << solid.error().message;
  glm::dvec3 low{1e9}, high{-1e9};
  for (const glm::dvec3& p : solid->mesh.points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  std::mt19937_64 random(20);
  constexpr int kPoints = 400'000;
  int inside = 0;
  glm::dvec3 sum{0.0};
  for (int i = 0; i < kPoints; ++i) {
    glm::dvec3 p{0.0};
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = std::uniform_real_distribution<double>(low[axis], high[axis])(random);
    if (!holds(pot, {p.x, p.z, -p.y})) continue;
    ++inside;
    sum += p;
  }
  const glm::dvec3 box = high - low;
  const double share = static_cast<double>(inside) / kPoints;
  const double sigma = std::sqrt(share * (1.0 - share) / kPoints) / share;
  EXPECT_NEAR(solid->union_mm3 / (box.x * box.y * box.z * share), 1.0, 4.0 * sigma);
  const glm::dvec3 away = sum / static_cast<double>(inside) - centroid_of(solid->mesh);
  EXPECT_LT(glm::length(away), 4.0 * glm::length(box) / std::sqrt(12.0 * inside));
}

RC_GTEST_PROP(CollapsedSolid, VolumesAddUpAndTheMeshIsSound, ()) {
  const Pot pot = *shapes::any_fallen_pot();
  const auto smoothing = *rc::gen::element(Smoothing::none, Smoothing::fair);
  const auto segments = *rc::gen::inRange<std::size_t>(3, 24);
  const auto solid = united(pot, segments, smoothing, 0.3);
  RC_CLASSIFY(solid.has_value());
  if (!solid) {
    // Rings that touch in a circle, or walls of at most 1e-4 mm.
    RC_ASSERT(solid.error().kind == ErrorKind::unsound);
    return;
  }
  const double parts = solid->lower_mm3 + solid->upper_mm3;
  // Walls of 1e-6 mm hold less clay than the rounding error of the cylinders that bound them.
  RC_ASSERT(std::abs(parts - solid->overlap_mm3 - solid->union_mm3) <=
            1e-9 * solid->union_mm3 + shapes::volume_rounding(pot.stack));
  const double levelled = 1e-6 * (20.0 + pot.stack.height_mm() + 2.0 * 25.0);
  RC_ASSERT(std::abs(parts - pot.stack.volume_mm3()) <=
            shapes::volume_rounding(pot.stack, levelled));
  RC_ASSERT(solid->mesh == rounded_to_float(solid->mesh));
  RC_ASSERT(check_mesh(solid->mesh).value().sound());
  // No ball in the filled pockets is larger than one of their volume.
  const double ball_mm = std::cbrt(0.75 * solid->pockets_mm3 / kPi);
  RC_ASSERT(solid->max_move_mm < ball_mm + 0.02);
  RC_ASSERT(solid->reshaped_mm <= solid->max_move_mm);
  RC_ASSERT(std::abs(solid->volume_mm3 - solid->pockets_mm3 - solid->union_mm3) <=
            surface_mm2(solid->mesh) * solid->max_move_mm);
}

}  // namespace
}  // namespace clay::solid
