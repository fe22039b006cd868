#include "claystack/export/smoothing.hpp"

#include "claystack/export/proof.hpp"
#include "claystack/export/walls.hpp"
#include "tests/export/smoothing/smoothed_pieces.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace clay::solid {
namespace {

using shapes::options_for;
using shapes::Radii;
using shapes::smooth;
using shapes::stack_of;
using shapes::treads;

ClayStack cone(int rings, double h, double wall_mm) {
  std::vector<Radii> radii;
  for (int i = 0; i < rings; ++i) {
    const double outer = 20.0 + 0.3 * (i + 0.5);
    radii.push_back({outer, wall_mm > 0.0 ? outer - wall_mm : 0.0});
  }
  return stack_of(h, radii);
}

TEST(ProfileSmoothing, AStraightPotStaysARectangle) {
  const ClayStack pot = ClayStack::cylinder(100, 1.0, 40, 30, 100).value();
  for (const Smoothing mode : {Smoothing::fair, Smoothing::exact}) {
    const SmoothedProfile made = smooth(pot, options_for(mode));
    ASSERT_EQ(made.section.profile.pieces.size(), 1u);
    ASSERT_EQ(made.section.profile.pieces[0].size(), 4u);
    EXPECT_NEAR(made.section.profile.pieces[0][0].rho, 40.0, 1e-9);
    EXPECT_NEAR(made.section.profile.pieces[0][3].rho, 30.0, 1e-9);
    EXPECT_TRUE(made.guard.empty());
  }
}

/// A mug whose wall has the same thickness from the floor to the rim, above a foot that is rounded
/// by a parabola; each ring has the clay of its part. The line of the wall begins in the rounding,
/// and so leans a little.
TEST(ProfileSmoothing, AnEvenWallAboveARoundedFootKeepsFewVertices) {
  constexpr int kRings = 3120, kParts = 32;
  constexpr double kHeightMm = 100.0, kFloorMm = 10.0, kRoundMm = 6.0;
  const auto outer_mm = [](double up) {
    const double left = 1.0 - std::sqrt(std::min(up / kRoundMm, 1.0));
    return 42.0 - 4.0 * left * left;
  };
  std::vector<Radii> radii;
  for (int i = 0; i < kRings; ++i) {
    double squares = 0.0;
    for (int part = 0; part < kParts; ++part)
      squares += std::pow(outer_mm((i + (part + 0.5) / kParts) * kHeightMm / kRings), 2.0);
    radii.push_back({std::sqrt(squares / kParts), i * kHeightMm < kFloorMm * kRings ? 0.0 : 36.0});
  }
  SmoothingOptions options = options_for(Smoothing::fair);
  options.smooth_length_mm = 0.0;
  for (int percent = 80; percent <= 120; ++percent) {
    const double size = 0.01 * percent;
    std::vector<Radii> scaled = radii;
    for (Radii& ring : scaled) ring = {size * ring.outer_mm, size * ring.inner_mm};
    const SmoothedProfile made = smooth(stack_of(size * kHeightMm / kRings, scaled), options);
    EXPECT_LE(made.section.profile.pieces.at(0).size(), 60u) << percent << " %";
  }
}

TEST(ProfileSmoothing, NoneKeepsTheSteps) {
  const ClayStack stack = shapes::vase(60);
  const SmoothedProfile made = smooth(stack, options_for(Smoothing::none));
  EXPECT_EQ(made.section.profile.pieces, profile_of(stack)->profile.pieces);
  EXPECT_LT(made.volume_error_relative, 1e-12);
}

TEST(ProfileSmoothing, AConeInStepsBecomesACone) {
  for (const Smoothing mode : {Smoothing::fair, Smoothing::exact}) {
    SmoothingOptions options = options_for(mode);
    options.min_wall_mm = 1.0;  // less than twice the foot, which gets narrower than its ring
    const SmoothedProfile made = smooth(cone(100, 1.0, 0.0), options);
    EXPECT_TRUE(made.guard.empty());
    const Polygon& polygon = made.section.profile.pieces.at(0);
    if (mode == Smoothing::fair) {
      EXPECT_LE(polygon.size(), 6u);  // two on the axis, and the half rings at both ends
    }
    for (const ProfilePoint& p : polygon) {
      if (p.rho > 0.0 && p.y > 1.0 && p.y < 99.0) {
        EXPECT_NEAR(p.rho, 20.0 + 0.3 * p.y, 0.02);
      }
    }
  }
}

TEST(ProfileSmoothing, ExactExtrapolatesTheWallAtItsEnds) {
  SmoothingOptions options = options_for(Smoothing::exact);
  options.min_wall_mm = 1.0;
  const Polygon polygon = smooth(cone(100, 1.0, 0.0), options).section.profile.pieces.at(0);
  EXPECT_NEAR(polygon.front().rho, 20.0, 0.01);
  for (const ProfilePoint& p : polygon) {
    if (p.y == 100.0 && p.rho > 0.0) {
      EXPECT_NEAR(p.rho, 50.0, 0.01);
    }
  }
}

TEST(ProfileSmoothing, KeepsFloorsAndLids) {
  std::vector<Radii> radii(30, {40.0, 25.0});
  for (const std::size_t i : {0u, 1u, 2u, 3u, 27u, 28u, 29u}) radii[i].inner_mm = 0.0;
  for (const Smoothing mode : {Smoothing::fair, Smoothing::exact}) {
    const SmoothedProfile made = smooth(stack_of(1.5, radii), options_for(mode));
    ASSERT_EQ(made.section.shapes.at(0).topology, Topology::cavity);
    EXPECT_NEAR(min_wall_mm(made.section.profile), 3 * 1.5, 1e-12);
    EXPECT_EQ(certify(made.section.profile).value().axis_segments, 2u);
    EXPECT_EQ(made.section.profile.pieces[0].size(), 8u);
  }
}

/// A gentle slope outside and in, with a gallery for a lid inside and a foot outside.
ClayStack with_ledges() {
  std::vector<Radii> radii;
  for (int i = 0; i < 60; ++i)
    radii.push_back({(i < 8 ? 30.0 : 34.0) + 0.1 * i, (i < 50 ? 20.0 : 24.0) + 0.1 * i});
  return stack_of(1.0, radii);
}

TEST(ProfileSmoothing, LedgesStayCorners) {
  const SmoothedProfile fair = smooth(with_ledges(), options_for(Smoothing::fair));
  const auto walls = oracles::walls_of(fair.section.profile.pieces.at(0));
  ASSERT_EQ(treads(walls.outer).size(), 1u);
  EXPECT_EQ(treads(walls.outer)[0].first, 8.0);
  EXPECT_NEAR(treads(walls.outer)[0].second, 4.1, 1e-3);
  ASSERT_EQ(treads(walls.bore).size(), 1u);
  EXPECT_EQ(treads(walls.bore)[0].first, 50.0);
  EXPECT_NEAR(treads(walls.bore)[0].second, 4.1, 1e-12);
  EXPECT_TRUE(fair.guard.empty());
  // In `exact` each side goes on half a step: 4.1 - 0.1.
  const SmoothedProfile exact = smooth(with_ledges(), options_for(Smoothing::exact));
  const auto exact_walls = oracles::walls_of(exact.section.profile.pieces.at(0));
  ASSERT_EQ(treads(exact_walls.outer).size(), 1u);
  EXPECT_NEAR(treads(exact_walls.outer)[0].second, 4.0, 1e-2);
}

TEST(ProfileSmoothing, AFlangeOfOneRingStaysARectangle) {
  std::vector<Radii> radii(40, {30.0, 25.0});
  radii[20].outer_mm = 38.0;
  const SmoothedProfile made = smooth(stack_of(1.0, radii), options_for(Smoothing::fair));
  EXPECT_EQ(made.section.profile.pieces.at(0).size(), 8u);
}

TEST(ProfileSmoothing, SlopesAndNoiseAreNoLedges) {
  std::mt19937_64 random(7);
  std::vector<Radii> radii;
  for (int i = 0; i < 200; ++i) {
    const double slope = i < 20 ? 2.0 * i : 40.0 + 0.2 * (i - 20);  // a bowl's, then a wall's
    const double noise = 0.5 * (samples::uniform(random) - 0.5);
    radii.push_back({20.0 + slope + noise, 0.0});
  }
  const SmoothedProfile made = smooth(stack_of(0.5, radii), options_for(Smoothing::fair));
  EXPECT_TRUE(treads(oracles::walls_of(made.section.profile.pieces.at(0)).outer).empty());
}

TEST(ProfileSmoothing, AThinWallWithinAWideToleranceIsNotCrossed) {
  std::vector<Radii> radii;
  for (int i = 0; i < 300; ++i) {
    const double middle = 40.0 + 6.0 * std::sin(0.05 * i) + 0.4 * std::sin(0.9 * i);
    radii.push_back({middle + 0.05, middle - 0.05});
  }
  const ClayStack stack = stack_of(1.0, radii);
  SmoothingOptions options = options_for(Smoothing::fair, 1.0);
  // The least, more than the walls have (their own counts), and none: walls may be as thin as
  // can be, but not cross.
  for (const std::optional<double> limit : {std::optional<double>{}, {0.2}, {0.0}}) {
    options.min_wall_mm = limit;
    const SmoothedProfile made = smooth(stack, options);
    EXPECT_TRUE(certify(made.section.profile));
    EXPECT_TRUE(made.guard.empty() || made.guard.back().reason != KeptFor::certificate);
    EXPECT_LT(made.section.profile.pieces.at(0).size(), 4u * radii.size());
  }
}

TEST(ProfileSmoothing, AJumpOvershootsNoFurtherThanAllowedAndIsReported) {
  std::vector<Radii> radii(40, {40.0, 36.0});
  for (std::size_t i = 20; i < 40; ++i) radii[i] = {28.3 - 0.2 * static_cast<double>(i % 2), 24.0};
  radii[19] = {34.0, 30.0};  // no single step, so that no feature is found
  radii[18] = {37.0, 33.0};
  radii[20] = {31.0, 27.0};
  SmoothingOptions options = options_for(Smoothing::exact);
  options.overshoot_limit_mm = 0.1;
  const SmoothedProfile made = smooth(stack_of(2.0, radii), options);
  EXPECT_LE(made.overshoot_mm, 0.1);
  ASSERT_FALSE(made.guard.empty());
  EXPECT_EQ(made.guard[0].reason, KeptFor::overshoot);
  EXPECT_GT(made.guard[0].smoothed_mm, 0.1);
  options.overshoot_limit_mm = 100.0;
  EXPECT_GT(smooth(stack_of(2.0, radii), options).overshoot_mm, 0.1);
}

TEST(ProfileSmoothing, ReportsKeptSteps) {
  // The bore widens to its very end, so its last ring has to bulge to stay exact: a theorem.
  std::vector<Radii> radii;
  for (int i = 0; i < 20; ++i) radii.push_back({40.0, 36.0 + 0.05 * i});
  SmoothingOptions options = options_for(Smoothing::exact);
  const ClayStack stack = stack_of(1.0, radii);
  const SmoothedProfile made = smooth(stack, options);
  ASSERT_EQ(made.guard.size(), 1u);
  EXPECT_EQ(made.guard[0].reason, KeptFor::wall);
  EXPECT_EQ(made.guard[0].from_mm, 19.0);
  EXPECT_EQ(made.guard[0].to_mm, 19.0);
  EXPECT_LT(made.guard[0].smoothed_mm, 3.05 - 0.01);
  EXPECT_NEAR(made.guard[0].kept_mm, 3.05, 1e-9);
  options.min_wall_mm = 2.0;
  EXPECT_TRUE(smooth(stack, options).guard.empty());
}

TEST(ProfileSmoothing, ReportsClayRemovedFromWallsAtTheirLimit) {
  // Chords fill half of the bore's ripple, so clay has to be taken, and every ring of the outer
  // wall stands before a place at the limit.
  std::vector<Radii> radii;
  for (int i = 0; i < 40; ++i) radii.push_back({40.0, i % 2 == 0 ? 36.9 : 37.1});
  const SmoothedProfile made = smooth(stack_of(1.0, radii), options_for(Smoothing::fair));
  // A step s costs h s^2 / 6: over R^2 h a share, and half of it of R.
  EXPECT_NEAR(made.taken_mm, 0.5 * 0.2 * 0.2 / 6.0 / 40.0, 2e-5);
  EXPECT_LT(made.volume_error_relative, 1e-12);
  EXPECT_NEAR(min_wall_mm(made.section.profile), 2.9 - made.taken_mm, 1e-9);
}

/// A tube with a plate whose edge is one ring thick and slopes on both sides.
ClayStack with_sloped_flange(bool at_the_lip) {
  std::vector<Radii> radii(at_the_lip ? 25 : 40, {30.0, 25.0});
  for (std::size_t i = 0; i < 4; ++i) {
    const double wide = 30.0 + 5.0 * static_cast<double>(i + 1);
    radii[21 + i].outer_mm = wide;
    if (!at_the_lip) radii[27 - i].outer_mm = wide;
  }
  return stack_of(0.5, radii);
}

TEST(ProfileSmoothing, ASlopedFlangeKeepsItsThickness) {
  for (const bool at_the_lip : {false, true}) {
    const ClayStack stack = with_sloped_flange(at_the_lip);
    const double steps = min_wall_mm(profile_of(stack)->profile);
    EXPECT_NEAR(steps, 0.5, 1e-9);  // one ring
    for (const Smoothing mode : {Smoothing::fair, Smoothing::exact})
      for (const std::optional<double> limit : {std::optional<double>{}, {0.4}, {3.0}}) {
        SmoothingOptions options = options_for(mode);
        options.min_wall_mm = limit;
        options.overshoot_limit_mm = 100.0;
        const SmoothedProfile made = smooth(stack, options);
        EXPECT_GE(min_wall_mm(made.section.profile), std::min(limit.value_or(5.0), steps) - 1e-9);
        if (mode == Smoothing::exact) continue;  // rings keep their clay, so the edge stays blunt
        EXPECT_TRUE(std::ranges::any_of(made.guard, [](const KeptSteps& kept) {
          return kept.reason == KeptFor::wall && kept.smoothed_mm < 0.4;
        }));
      }
  }
}

/// A wall of 5 mm that tapers to 0.1 um at the rim: thinner than the volume correction moves it.
TEST(ProfileSmoothing, AWallThatEndsInAKnifeEdgeIsSmoothed) {
  std::vector<Radii> radii(10, {20.0, 0.0});
  for (int i = 0; i <= 30; ++i) radii.push_back({20.0, 15.0 + 4.9999 * i / 30.0});
  const ClayStack stack = stack_of(0.2, radii);
  for (const double tolerance_mm : {0.02, 0.5})
    for (const double length_mm : {0.0, 9.0}) {
      SmoothingOptions options = options_for(Smoothing::fair, tolerance_mm);
      options.smooth_length_mm = length_mm;
      const SmoothedProfile made = smooth(stack, options);
      EXPECT_TRUE(certify(made.section.profile));
      EXPECT_LT(made.volume_error_relative, 1e-12);
      EXPECT_TRUE(std::ranges::none_of(
          made.guard, [](const KeptSteps& kept) { return kept.reason == KeptFor::certificate; }))
          << tolerance_mm << " " << length_mm;
    }
}

TEST(ProfileSmoothing, RefusesUnsupportedRequests) {
  const ClayStack stack = shapes::vase(20);
  const auto refused = [&](SmoothingOptions options, const char* name) {
    const auto made = smooth_profile_of(stack, options);
    return !made && made.error().kind == ErrorKind::bad_input &&
           made.error().message.find(name) != std::string::npos;
  };
  SmoothingOptions options = options_for(Smoothing::exact);
  options.lip_fillet_mm = 0.5;
  EXPECT_TRUE(refused(options, "lip fillet: expected fair smoothing, found exact"));
  options.mode = Smoothing::fair;
  EXPECT_FALSE(refused(options, ""));
  options.lip_fillet_mm = -1.0;
  EXPECT_TRUE(refused(options, "lip fillet"));
  options = options_for(Smoothing::fair, 0.0);
  EXPECT_TRUE(refused(options, "tolerance"));
  options = options_for(Smoothing::fair);
  options.min_wall_mm = std::nan("");
  EXPECT_TRUE(refused(options, "minimum wall"));
  options = options_for(Smoothing::exact);
  options.overshoot_limit_mm = -0.1;
  EXPECT_TRUE(refused(options, "overshoot limit"));
}

}  // namespace
}  // namespace clay::solid
