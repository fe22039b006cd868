#include "claystack/export/proof.hpp"
#include "claystack/export/smoothing.hpp"
#include "tests/export/smoothing/smoothing_oracles.hpp"
#include "tests/export/smoothing/smoothing_stacks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace clay::solid {
namespace {

using shapes::options_for;
using shapes::Radii;
using shapes::stack_of;

constexpr double kTop = 60.0;

SmoothedProfile rounded(const ClayStack& stack, double fillet_mm, double tolerance_mm = 0.02) {
  SmoothingOptions options = options_for(Smoothing::fair, tolerance_mm);
  options.lip_fillet_mm = fillet_mm;
  return smooth_profile_of(stack, options).value();
}

/// Points of a wall above `low`.
oracles::Line above(const oracles::Line& line, double low) {
  oracles::Line points;
  for (const oracles::Point& p : line)
    if (p.y >= low) points.push_back(p);
  return points;
}

TEST(LipFillet, OfAStraightWallIsAQuarterCircleAtEachEdge) {
  const ClayStack tube = ClayStack::cylinder(60, 1.0, 40, 34, 60).value();
  const SmoothedProfile made = rounded(tube, 2.0);
  EXPECT_EQ(made.lip_fillet_mm, 2.0);
  EXPECT_EQ(made.lip_fillet_limit, FilletLimit::none);
  EXPECT_LT(made.volume_error_relative, 1e-12);
  EXPECT_TRUE(certify(made.section.profile));
  const auto walls = oracles::walls_of(made.section.profile.pieces.at(0));
  const oracles::Real outer = walls.outer.front().rho, bore = walls.bore.front().rho;
  EXPECT_EQ(bore, 34.0L);
  EXPECT_GT(outer, 40.0L);  // the clay that the arcs took is added again
  const auto check_arc = [&](const oracles::Line& arc, oracles::Real centre) {
    ASSERT_GE(arc.size(), 4u);
    EXPECT_NEAR(static_cast<double>(arc.back().rho - centre), 0.0, 1e-9);
    EXPECT_NEAR(static_cast<double>(arc.front().y), kTop - 2.0, 1e-9);
    for (const oracles::Point& p : arc)
      EXPECT_NEAR(static_cast<double>(std::hypot(p.rho - centre, p.y - (kTop - 2.0L))), 2.0, 1e-9);
    for (std::size_t i = 0; i + 1 < arc.size(); ++i) {
      const auto mid_rho = (arc[i].rho + arc[i + 1].rho) / 2, mid_y = (arc[i].y + arc[i + 1].y) / 2;
      EXPECT_GT(std::hypot(mid_rho - centre, mid_y - (kTop - 2.0L)), 2.0L - 0.02L);
    }
  };
  check_arc(above(walls.outer, kTop - 2.0 - 1e-9), outer - 2.0L);
  check_arc(above(walls.bore, kTop - 2.0 - 1e-9), bore + 2.0L);
}

TEST(LipFillet, TouchesALeaningWall) {
  // 45 degrees outward: the outer arc turns by 135 degrees, the inner one by 45.
  std::vector<Radii> radii;
  for (int i = 0; i < 120; ++i) radii.push_back({30.0 + 0.5 * (i + 0.5), 24.0 + 0.5 * (i + 0.5)});
  const SmoothedProfile made = rounded(stack_of(0.5, radii), 1.5, 0.002);
  EXPECT_EQ(made.lip_fillet_mm, 1.5);
  const auto walls = oracles::walls_of(made.section.profile.pieces.at(0));
  // Within the last half ring the wall is upright, and the circle touches the bend below it or
  // the slope; either way it leaves no corner sharper than the sampling's.
  const oracles::Line outer = above(walls.outer, kTop - 3.0);
  double sharpest = 0.0;
  for (std::size_t i = 1; i + 1 < outer.size(); ++i) {
    const auto before = std::atan2(outer[i].y - outer[i - 1].y, outer[i].rho - outer[i - 1].rho);
    const auto after = std::atan2(outer[i + 1].y - outer[i].y, outer[i + 1].rho - outer[i].rho);
    sharpest = std::max(sharpest, static_cast<double>(after - before));
  }
  EXPECT_LT(sharpest, 0.25 * M_PI + 2.0 * std::acos(1.0 - 0.001 / 1.5));
  const oracles::Real centre = outer.back().rho;
  for (const oracles::Point& p : outer)
    EXPECT_LE(std::hypot(std::max(p.rho - centre, 0.0L), std::max(p.y - (kTop - 1.5L), 0.0L)),
              1.5L + 1e-9L);
}

TEST(LipFillet, IsAtMostHalfTheLip) {
  const ClayStack tube = ClayStack::cylinder(60, 1.0, 40, 37, 60).value();
  const SmoothedProfile made = rounded(tube, 5.0);
  EXPECT_LE(made.lip_fillet_mm, 1.5);
  EXPECT_GT(made.lip_fillet_mm, 1.45);
  EXPECT_EQ(made.lip_fillet_asked_mm, 5.0);
  EXPECT_EQ(made.lip_fillet_limit, FilletLimit::lip_width);
  EXPECT_TRUE(certify(made.section.profile));
}

/// A lip of 2 mm on a wall of 6 mm, which tapers by 45 degrees.
TEST(LipFillet, OfATaperedLipIsWiderThanHalfItsTop) {
  std::vector<Radii> radii(240, {40.0, 34.0});
  for (std::size_t i = 0; i < 8; ++i) {
    const double taper = 0.25 * (static_cast<double>(i) + 0.5);
    radii[232 + i] = {40.0 - taper, 34.0 + taper};
  }
  const SmoothedProfile made = rounded(stack_of(0.25, radii), 2.0);
  EXPECT_EQ(made.lip_fillet_mm, 2.0);
  EXPECT_EQ(made.lip_fillet_limit, FilletLimit::none);
  const auto walls = oracles::walls_of(made.section.profile.pieces.at(0));
  // The circle of 2 mm in a corner of 135 degrees takes 2 tan(22.5 degrees) of the flat of 1 mm
  // on each side, so that 0.17 mm of it remain; the taper of the steps ends half a ring below.
  EXPECT_NEAR(static_cast<double>(walls.outer.back().rho - walls.bore.back().rho),
              2.0 * (1.0 - 2.0 * std::tan(M_PI / 8.0)), 0.3);
  // The arc ends where it touches the taper, 2 sin(45 degrees) above its centre.
  for (const oracles::Point& p : above(walls.outer, kTop - 2.0 + 1.45))
    EXPECT_LE(std::hypot(p.rho - walls.outer.back().rho, p.y - (kTop - 2.0L)), 2.0L + 1e-9L);
}

TEST(LipFillet, IsAtMostHalfOfAFlange) {
  std::vector<Radii> radii(60, {40.0, 30.0});
  radii[58].outer_mm = radii[59].outer_mm = 46.0;
  const SmoothedProfile made = rounded(stack_of(1.0, radii), 4.0);
  EXPECT_LE(made.lip_fillet_mm, 1.0);
  EXPECT_GT(made.lip_fillet_mm, 0.95);
  EXPECT_EQ(made.lip_fillet_limit, FilletLimit::height_below);
}

RC_GTEST_PROP(LipFillet, KeepsTheVolumeAndTheWallsBelowIt, ()) {
  auto random = *samples::random_engine();
  const ClayStack stack = shapes::wandering(random, *rc::gen::inRange<std::size_t>(2, 60), 0.7);
  RC_PRE(profile_of(stack).has_value());
  const double asked = *rc::gen::element(0.1, 1.0, 30.0);
  const SmoothedProfile made = rounded(stack, asked);
  RC_ASSERT(made.lip_fillet_mm > 0.0 && made.lip_fillet_mm <= asked);
  RC_ASSERT((made.lip_fillet_mm < asked) == (made.lip_fillet_limit != FilletLimit::none));
  RC_ASSERT(std::abs(volume_of(made.section.profile) - stack.volume_mm3()) <=
            shapes::volume_rounding(stack));
  RC_ASSERT(certify(made.section.profile).has_value());
}

}  // namespace
}  // namespace clay::solid
