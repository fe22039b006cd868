#include "claystack/export/section.hpp"

#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <numbers>

namespace clay::solid {
namespace {

using shapes::stack_of;
constexpr double kPi = std::numbers::pi;

double exact_radius(double mm) { return radius_from_quanta(quanta_from_radius(mm)); }

TEST(ProfileOf, SolidCylinderIsOneRectangleWithoutRingMarks) {
  const auto found = profile_of(stack_of(2.0, {{10, 0}, {10, 0}, {10, 0}}));
  ASSERT_TRUE(found);
  ASSERT_EQ(found->profile.pieces.size(), 1u);
  EXPECT_EQ(found->profile.pieces[0], (Polygon{{10, 0}, {10, 6}, {0, 6}, {0, 0}}));
  EXPECT_EQ(found->shapes[0].topology, Topology::solid);
}

TEST(ProfileOf, CupRunsUpOutsideAndDownTheBoreToTheAxis) {
  const auto found = profile_of(stack_of(2.0, {{10, 0}, {12, 8}, {12, 8}}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->profile.pieces.at(0),
            (Polygon{{10, 0}, {10, 2}, {12, 2}, {12, 6}, {8, 6}, {8, 2}, {0, 2}, {0, 0}}));
  EXPECT_EQ(found->shapes[0].topology, Topology::cup);
  EXPECT_TRUE(found->shapes[0].cavities.empty());
}

TEST(ProfileOf, CrownRaisesTheTopRing) {
  const auto half = stack_of(2.0, {{10, 0}, {8, 0}}).rings().back().volume() / 2;
  const auto found = profile_of(stack_of(2.0, {{10, 0}, {8, 0}}, half));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->profile.pieces.at(0),
            (Polygon{{10, 0}, {10, 2}, {8, 2}, {8, 5}, {0, 5}, {0, 0}}));
}

TEST(ProfileOf, TubeNeverMeetsTheAxis) {
  const auto found = profile_of(stack_of(1.0, {{10, 5}, {9, 6}}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->profile.pieces.at(0),
            (Polygon{{10, 0}, {10, 1}, {9, 1}, {9, 2}, {6, 2}, {6, 1}, {5, 1}, {5, 0}}));
  EXPECT_EQ(found->shapes[0].topology, Topology::tube);
}

TEST(ProfileOf, BoreOpenAtBothEndsWithAFloorBetweenIsACup) {
  const auto found = profile_of(stack_of(1.0, {{10, 5}, {10, 0}, {10, 5}}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->shapes.at(0).topology, Topology::cup);
}

TEST(ProfileOf, ListsCavitiesWithTheirVolume) {
  const auto found =
      profile_of(stack_of(2.0, {{10, 0}, {10, 3}, {10, 4}, {10, 0}, {10, 5}, {10, 0}}));
  ASSERT_TRUE(found);
  const PieceShape& shape = found->shapes.at(0);
  EXPECT_EQ(shape.topology, Topology::cavity);
  ASSERT_EQ(shape.cavities.size(), 2u);
  EXPECT_EQ(shape.cavities[0].bottom_mm, 2.0);
  EXPECT_EQ(shape.cavities[0].top_mm, 6.0);
  EXPECT_NEAR(shape.cavities[0].volume_mm3, kPi * (9 + 16) * 2, 1e-9);
  EXPECT_EQ(shape.cavities[1].bottom_mm, 8.0);
  EXPECT_NEAR(shape.cavities[1].volume_mm3, kPi * 25 * 2, 1e-9);
}

TEST(ProfileOf, CupMayHaveACavityBelowItsFloor) {
  const auto found = profile_of(stack_of(1.0, {{9, 0}, {9, 4}, {9, 0}, {9, 6}}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->shapes.at(0).topology, Topology::cup);
  EXPECT_EQ(found->shapes[0].cavities.size(), 1u);
}

TEST(ProfileOf, SeparatesRingsWithoutCommonAnnulus) {
  const auto found = profile_of(stack_of(1.0, {{10, 8}, {6, 0}, {6, 2}, {20, 10}}));
  ASSERT_TRUE(found);
  ASSERT_EQ(found->profile.pieces.size(), 3u);
  EXPECT_EQ(found->shapes[1].first_ring, 1u);
  EXPECT_EQ(found->shapes[1].last_ring, 2u);
  EXPECT_EQ(found->profile.pieces[2], (Polygon{{20, 3}, {20, 4}, {10, 4}, {10, 3}}));
}

TEST(ProfileOf, RefusesRingsThatTouchInACircle) {
  for (const auto& radii : {std::vector<shapes::Radii>{{9, 2}, {5, 0}, {9, 5}},
                            std::vector<shapes::Radii>{{5, 2}, {9, 5}, {5, 0}}}) {
    const auto found = profile_of(stack_of(1.0, radii));
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().kind, ErrorKind::unsound);
    EXPECT_NE(found.error().message.find("circle of radius 5 mm"), std::string::npos)
        << found.error().message;
  }
  const auto upper = profile_of(stack_of(1.0, {{9, 2}, {5, 0}, {9, 5}}));
  EXPECT_NE(upper.error().message.find("rings 1 and 2"), std::string::npos);
}

TEST(ProfileOf, OneQuantumDecidesBetweenTouchOverlapAndSeparation) {
  const Quanta r2 =
      quanta_from_radius(5000.0);  // here neighbouring counts round to the same double
  const auto pieces = [&](Quanta bore2) {
    std::vector<Ring> rings{{r2 - 4, 0}, {r2, bore2}};
    return profile_of(ClayStack::from_rings(1.0, rings, 0).value());
  };
  EXPECT_EQ(pieces(r2 - 5)->profile.pieces.size(), 1u);
  EXPECT_FALSE(pieces(r2 - 4));
  EXPECT_EQ(pieces(r2 - 3)->profile.pieces.size(), 2u);
}

TEST(ProfileOf, RefusesAnEmptyStack) { EXPECT_FALSE(profile_of(ClayStack{})); }

TEST(VolumeOf, IsExactForAFrustum) {
  const Profile frustum{{{{3, 0}, {1, 6}, {0, 6}, {0, 0}}}};
  EXPECT_NEAR(volume_of(frustum), kPi * 6.0 / 3.0 * (9 + 3 + 1), 1e-12);
}

TEST(VolumeOf, IsNegativeForAClockwiseTube) {
  const Profile tube{{{{5, 0}, {5, 4}, {3, 4}, {3, 0}}}};
  EXPECT_NEAR(volume_of(tube), kPi * (25 - 9) * 4, 1e-12);
  const Profile clockwise{{{{3, 0}, {3, 4}, {5, 4}, {5, 0}}}};
  EXPECT_NEAR(volume_of(clockwise), -kPi * (25 - 9) * 4, 1e-12);
}

RC_GTEST_PROP(VolumeOf, ProfileHoldsTheCountedClay, (const ClayStack& stack)) {
  const auto found = profile_of(stack);
  if (!found) RC_DISCARD("touching rings");
  RC_ASSERT(std::abs(volume_of(found->profile) - stack.volume_mm3()) <=
            shapes::volume_rounding(stack));
}

RC_GTEST_PROP(ProfileOf, UsesOnlyRadiiAndLevelsOfTheStack, (const ClayStack& stack)) {
  const auto found = profile_of(stack);
  if (!found) RC_DISCARD("touching rings");
  for (const Polygon& polygon : found->profile.pieces) {
    for (const ProfilePoint& p : polygon) {
      const bool known = std::any_of(
          stack.rings().begin(), stack.rings().end(),
          [&](const Ring& ring) { return p.rho == ring.outer_mm() || p.rho == ring.inner_mm(); });
      RC_ASSERT(known);
      RC_ASSERT(p.y == stack.height_mm() || std::fmod(p.y, stack.ring_height_mm()) == 0.0);
    }
  }
}

TEST(ProfileOf, ReplacesNarrowStepsByOneVertex) {
  const ClayStack stack = stack_of(2.0, {{10, 0}, {11, 5}, {12, 6}, {20, 6}});
  const auto found = profile_of(stack, 1.5);
  ASSERT_TRUE(found);
  const Polygon& polygon = found->profile.pieces.at(0);
  ASSERT_EQ(polygon.size(), 11u);
  EXPECT_DOUBLE_EQ(polygon[1].rho, std::sqrt((100.0 + 121.0) / 2));
  EXPECT_EQ(polygon[1].y, 2.0);
  EXPECT_DOUBLE_EQ(polygon[2].rho, std::sqrt((121.0 + 144.0) / 2));
  EXPECT_EQ(polygon[3], (ProfilePoint{12, 6}));  // a step of 8 mm stays
  EXPECT_EQ(polygon[9], (ProfilePoint{0, 2}));   // and so does the floor
}

TEST(ProfileOf, NarrowBoreStillEndsOnAFloor) {
  // Levelled, the floor would shrink to the tip of a cone, which no certificate accepts.
  const auto found = profile_of(stack_of(1.0, {{10, 0}, {10, 5e-4}}), 1e-3);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->profile.pieces.at(0).size(), 6u);
  EXPECT_TRUE(certify(found->profile));
}

RC_GTEST_PROP(ProfileOf, LevellingNarrowStepsKeepsTheProofAndTheVolume, (const ClayStack& stack)) {
  const double step = std::pow(10.0, -*rc::gen::inRange(3, 9));
  const auto found = profile_of(stack, step);
  if (!found) RC_DISCARD("touching rings");
  RC_ASSERT(certify(found->profile).has_value());
  RC_ASSERT(std::abs(volume_of(found->profile) - stack.volume_mm3()) <=
            shapes::volume_rounding(stack, step));
}

TEST(ProfileOf, LevellingKeepsTheVolumeToSecondOrder) {
  // Runs of one to three rings and a crown: a plain mean of the squares would be off by 1e-8.
  std::vector<shapes::Radii> radii;
  for (int run = 0; run < 50; ++run)
    radii.insert(radii.end(), static_cast<std::size_t>(run % 3 + 1),
                 {40.0 + 1e-4 * (run * 7 % 5), 0});
  const WideQuanta crown = 2 * stack_of(1.0, radii).rings().back().volume() / 3;
  const ClayStack stack = stack_of(1.0, radii, crown);
  const auto found = profile_of(stack, 1e-3);
  EXPECT_EQ(found->profile.pieces.at(0).size(), 53u);
  EXPECT_NEAR(volume_of(found->profile) / stack.volume_mm3(), 1.0, 1e-11);
}

TEST(ProfileOf, RadiiEqualTheCounts) {
  const auto found = profile_of(stack_of(1.0, {{7.3, 0.1}}));
  EXPECT_EQ(found->profile.pieces.at(0).front().rho, exact_radius(7.3));
}

}  // namespace
}  // namespace clay::solid
