#include "claystack/export/walls.hpp"

#include "claystack/engine/clay.hpp"
#include "claystack/export/smoothing.hpp"
#include "tests/engine/clay/stack_samples.hpp"
#include "tests/export/section/cup_section.hpp"
#include "tests/export/solid/shapes.hpp"
#include "tests/export/walls/wall_oracle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace clay::solid {
namespace {

using shapes::cup;

double wall_of(Polygon polygon) { return min_wall_mm({{std::move(polygon)}}); }

/// Part of a circle about (rho, y), `count` chords from one angle to the other.
Polygon arc(ProfilePoint centre, double radius, double from, double to, int count) {
  Polygon points;
  for (int i = 0; i <= count; ++i) {
    const double angle = from + (to - from) * i / count;
    points.push_back({centre.rho + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return points;
}

/// Splits every edge into `parts`, so that no edge is long.
Polygon divided(const Polygon& polygon, int parts) {
  Polygon points;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ProfilePoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    for (int k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      points.push_back({a.rho + t * (b.rho - a.rho), a.y + t * (b.y - a.y)});
    }
  }
  return points;
}

TEST(WallThickness, EqualsDiameterOrHeightOfASolid) {
  EXPECT_NEAR(wall_of({{0, 0}, {30, 0}, {30, 50}, {0, 50}}), 50.0, 50.0 * 1.001e-3);
  EXPECT_NEAR(wall_of({{0, 0}, {60, 0}, {60, 50}, {0, 50}}), 50.0, 1e-12);
  EXPECT_NEAR(wall_of({{0, 0}, {20, 0}, {20, 50}, {0, 50}}), 40.0, 40.0 * 1.001e-3);
  EXPECT_NEAR(wall_of({{0, 0}, {20, 0}, {20, 90}, {0, 90}}), 40.0, 1e-12);
  EXPECT_NEAR(wall_of({{0, 0}, {20, 0}, {8, 40}, {20, 80}, {0, 80}}), 16.0, 1e-12);  // waist
}

TEST(WallThickness, CrossesTheAxisOnlyThroughClay) {
  // A narrow foot, 20 mm across, and a wide bowl above.
  const Wall wall =
      min_wall({{{{0, 0}, {10, 0}, {10, 30}, {60, 50}, {60, 110}, {35, 110}, {35, 75}, {0, 75}}}});
  EXPECT_NEAR(wall.thickness_mm, 20.0, 1e-12);
  EXPECT_NEAR(wall.from.rho, 10.0, 1e-12);
  EXPECT_NEAR(wall.to.rho, -10.0, 1e-12);
  // A tube of the same foot has no clay on the axis.
  EXPECT_NEAR(wall_of({{2, 0}, {10, 0}, {10, 30}, {2, 30}}), 8.0, 1e-12);
}

TEST(WallThickness, EqualsWallOrFloorOfACup) {
  for (const int parts : {1, 3, 40}) {
    EXPECT_NEAR(wall_of(divided(cup(5, 8), parts)), 5.0, 1e-12);
    EXPECT_NEAR(wall_of(divided(cup(5, 3), parts)), 3.0, 1e-12);
  }
}

TEST(WallThickness, ReportsThePlace) {
  const Wall floor = min_wall({{cup(5, 3)}}), wall = min_wall({{cup(3, 5)}});
  EXPECT_NEAR(std::abs(floor.from.y - floor.to.y), 3.0, 1e-12);
  EXPECT_NEAR(floor.from.rho, floor.to.rho, 1e-12);
  EXPECT_NEAR(std::abs(wall.from.rho - wall.to.rho), 3.0, 1e-12);
}

TEST(WallThickness, IsMeasuredAcrossALeaningWall) {
  // A conical tube inclined by 25 degrees: 4 mm along the radius are 4 cos 25 across.
  const double angle = 25.0 * M_PI / 180.0, lean = 60.0 * std::tan(angle);
  for (const int parts : {1, 7, 100})
    EXPECT_NEAR(wall_of(divided({{40, 0}, {40 + lean, 60}, {36 + lean, 60}, {36, 0}}, parts)),
                4.0 * std::cos(angle), 1e-12);
  // At 45 degrees the rim and the outside meet in an edge, which is thin nowhere.
  EXPECT_NEAR(wall_of({{40, 0}, {100, 60}, {96, 60}, {36, 0}}), 4.0 * std::cos(M_PI / 4), 1e-12);
}

TEST(WallThickness, IsConstantOnASphericalShell) {
  constexpr int kChords = 720;
  Polygon outside = arc({0, 0}, 50, -M_PI / 2, M_PI / 2, kChords);
  Polygon inside = arc({0, 0}, 46, M_PI / 2, -M_PI / 2, kChords);
  for (Polygon* part : {&outside, &inside}) part->front().rho = part->back().rho = 0.0;
  outside.insert(outside.end(), inside.begin(), inside.end());
  // A chord is up to 50 (1 - cos(half a step)) inside its arc.
  const double sagitta = 50.0 * (1.0 - std::cos(M_PI / (2 * kChords)));
  EXPECT_NEAR(wall_of(outside), 4.0, sagitta);
  for (const WallSample& sample : wall_field({{outside}}, 1.0))
    EXPECT_NEAR(sample.thickness_mm, 4.0, 2.0 * sagitta) << sample.at.rho << ' ' << sample.at.y;
}

TEST(WallThickness, EqualsTheDiameterOfARoundSection) {
  Polygon ring = arc({30, 0}, 5, 0, 2 * M_PI, 720);
  ring.pop_back();
  // No disc has three diameters of boundary beside it.
  const Wall wall = min_wall({{ring}});
  EXPECT_TRUE(wall.compact);
  // Its places are the ends of a diameter.
  EXPECT_NEAR(std::hypot(wall.from.rho - 30.0, wall.from.y), 5.0, 0.02);
  EXPECT_NEAR(0.5 * (wall.from.rho + wall.to.rho), 30.0, 0.02);
  EXPECT_NEAR(0.5 * (wall.from.y + wall.to.y), 0.0, 0.02);
  EXPECT_LT(wall_of(ring), 10.0);
  EXPECT_GT(wall_of(ring), 10.0 * (1.0 - 2e-3));
}

TEST(WallThickness, OfAHoopIsNeverInfinite) {
  // An equilateral triangle of side 6: its inscribed circle has the diameter 6 / sqrt 3.
  const double inscribed = 6.0 / std::sqrt(3.0);
  const double triangle = wall_of({{40, 0}, {46, 0}, {43, 3.0 * std::sqrt(3.0)}});
  EXPECT_LE(triangle, inscribed);
  EXPECT_GE(triangle, inscribed * (1.0 - 1.001e-3));
  EXPECT_NEAR(wall_of({{40, 0}, {40.5, 0}, {40.5, 0.5}, {40, 0.5}}), 0.5, 0.5 * 1.001e-3);
}

TEST(WallThickness, OfACutOffWedgeMatchesItsClosedForm) {
  // A lip that narrows from 8 mm to 1 mm, symmetric. Two faces at an angle a that would meet at a
  // distance e from the lip's ends: discs of diameter D, at places of which one is z times as far
  // from there as the other, D = 2 tan(a / 4) (x + z x) at best, and 3 D = x + z x - 2 e + 1.
  const Polygon lip{{40, 0}, {48, 0}, {44.5, 50}, {43.5, 50}};
  const double angle = 2.0 * std::atan2(3.5, 50.0), e = 0.5 / std::sin(angle / 2.0);
  const double per = 2.0 * std::tan(angle / 4.0), both = (2.0 * e - 1.0) / (1.0 - 3.0 * per);
  for (const int parts : {1, 10, 2000})
    EXPECT_NEAR(wall_of(divided(lip, parts)), per * both, 1e-9) << parts;
}

TEST(WallThickness, ChangesGraduallyWithTheAngleOfABevel) {
  // A wall of 6 mm whose outside is bevelled by `degrees`, down to a lip of 0.23 mm.
  const auto bevelled = [](double degrees) {
    const double height = 5.77 / std::tan(degrees * M_PI / 180.0);
    return wall_of({{40, 0}, {46, 0}, {46, 60}, {40.23, 60 + height}, {40, 60 + height}});
  };
  EXPECT_LT(bevelled(29.0), 0.8);
  EXPECT_LT(bevelled(31.0), 1.0);
  EXPECT_NEAR(bevelled(45.0), 6.0, 1e-9);
  double before = bevelled(10.0);
  for (double degrees = 10.01; degrees < 45.0; degrees += 0.01) {
    const double now = bevelled(degrees);
    EXPECT_LT(std::abs(now - before), 0.05 * before) << degrees;
    before = now;
  }
}

TEST(WallThickness, OfATipIsZeroUpToALimitOfItsAngle) {
  const double limit = 4.0 * std::atan(1.0 / 6.0);
  const auto hoop = [](double angle) {
    return wall_of({{40, 0},
                    {40 + 100.0 * std::tan(angle / 2.0), 100},
                    {40 - 100.0 * std::tan(angle / 2.0), 100}});
  };
  for (const double angle : {0.01, 0.3, limit - 1e-6}) EXPECT_EQ(hoop(angle), 0.0) << angle;
  EXPECT_GT(hoop(limit + 1e-6), 10.0);
}

TEST(WallThickness, OfASharpEdgeIsZero) { EXPECT_EQ(wall_of({{40, 0}, {50, 0}, {45, 60}}), 0.0); }

TEST(WallThickness, EqualsTheHeightOfAFlangeThatIsLongerThanItIsHigh) {
  const auto with_flange = [](double out) {
    Polygon polygon = cup(5, 8);
    polygon.insert(polygon.begin() + 2, {{40, 30}, {40 + out, 30}, {40 + out, 32}, {40, 32}});
    return wall_of(polygon);
  };
  EXPECT_NEAR(with_flange(10.0), 2.0, 1e-12);
  EXPECT_NEAR(with_flange(2.01), 2.0, 1e-12);
  EXPECT_NEAR(with_flange(1.99), 5.0, 1e-12);
}

TEST(WallThickness, OfASharpFlangeIsZeroAtItsTip) {
  Polygon polygon = cup(5, 8);
  const double half = 20.0 * std::tan(12.0 * M_PI / 180.0);  // 24 degrees
  polygon.insert(polygon.begin() + 2, {{40, 30 - half}, {60, 30}, {40, 30 + half}});
  EXPECT_EQ(wall_of(polygon), 0.0);
}

TEST(WallThickness, EqualsTheDistanceOfReentrantCorners) {
  // Two blocks joined by an oblique neck from (60, 26) to (63, 30).
  EXPECT_NEAR(wall_of({{40, 0},
                       {80, 0},
                       {80, 30},
                       {63, 30},
                       {63, 60},
                       {30, 60},
                       {30, 26},
                       {60, 26},
                       {60, 20},
                       {40, 20}}),
              5.0, 1e-12);
}

TEST(WallThickness, IncludesTheLidOfACavity) {
  EXPECT_NEAR(wall_of({{0, 0}, {40, 0}, {40, 60}, {0, 60}, {0, 58}, {30, 58}, {30, 9}, {0, 9}}),
              2.0, 1e-12);
}

TEST(WallThickness, IsMeasuredOnTheAxisAboveAPointedCavity) {
  EXPECT_NEAR(wall_of({{0, 0}, {40, 0}, {40, 60}, {0, 60}, {0, 55}, {25, 40}, {25, 20}, {0, 9}}),
              5.0, 1e-12);
}

TEST(WallThickness, OfAHoopAsThinAsRoundingIsFound) {
  // 25 units in the last place of the radius, as of a ring that spans one quantum.
  const double outer = 41.230601953380798, inner = 41.230601953380621;
  const Polygon hoop{{inner, 0}, {outer, 0}, {outer, 20}, {inner, 20}};
  const Wall wall = min_wall({{hoop}});
  EXPECT_FALSE(wall.compact);
  EXPECT_NEAR(wall.thickness_mm, outer - inner, 1e-14);
}

TEST(WallThickness, OfARoofIsNotTheWidthOfItsRidge) {
  // A roof of 60 degrees whose ridge is 10 nm wide.
  const Polygon roof{{30, 0}, {40, 0}, {35 + 5e-6, 8.66}, {35 - 5e-6, 8.66}};
  EXPECT_GT(min_wall_mm({{roof}}), 1.0);
}

TEST(WallThickness, IsTheMinimumOverPieces) {
  const Polygon low{{20, 0}, {30, 0}, {30, 10}, {20, 10}},
      high{{20, 11}, {27, 11}, {27, 20}, {20, 20}};
  EXPECT_NEAR(min_wall_mm({{low, high}}), 7.0, 1e-12);
}

TEST(WallThickness, OfTheFacetsEqualsTheScaledProfile) {
  const double scale = std::cos(M_PI / 12);
  const Wall wall = min_wall({{cup(5, 8)}}, scale);
  EXPECT_NEAR(wall.thickness_mm, 5.0 * scale, 1e-12);
  EXPECT_NEAR(std::max(wall.from.rho, wall.to.rho), 40.0, 1e-12);
  EXPECT_NEAR(min_wall({{cup(5, 3)}}, scale).thickness_mm, 3.0, 1e-12);  // floors stay
}

/// The place found has the stated thickness, and no pair of sampled places is thinner.
void agrees_with_the_definition(const Profile& profile, std::mt19937_64& random,
                                bool margin = false) {
  const Wall wall = min_wall(profile);
  WallOracle oracle(profile);
  const double least = oracle.least_of_samples(random, margin);
  RC_ASSERT(least > wall.thickness_mm - 1e-9);
  if (!wall.compact)
    RC_ASSERT(std::abs(oracle.thickness(wall) - wall.thickness_mm) < 1e-7);
  else if (profile.pieces.size() == 1)
    RC_ASSERT(std::isinf(least));
}

RC_GTEST_PROP(WallThickness, MatchesTheDefinitionForSteps, (const ClayStack& stack)) {
  auto random = *samples::random_engine();
  const auto section = profile_of(stack);
  RC_PRE(section.has_value());
  agrees_with_the_definition(section->profile, random);
}

RC_GTEST_PROP(WallThickness, MatchesTheDefinitionForFairWalls, ()) {
  auto random = *samples::random_engine();
  const double h = *rc::gen::element(0.5, 3.0, 20.0);
  const ClayStack stack = samples::stack(random, *rc::gen::inRange<std::size_t>(2, 14), h);
  const auto section = shapes::fair_section(stack, 0.02);
  RC_PRE(section.has_value() && certify(section->profile).has_value());
  agrees_with_the_definition(section->profile, random);
}

/// Wavy hoops: faces of every direction, many per branch of the search.
RC_GTEST_PROP(WallThickness, MatchesTheDefinitionForWavyHoops, ()) {
  auto random = *samples::random_engine();
  const double depth = *rc::gen::element(0.1, 0.3, 0.6);
  const double turn = 6.28 * samples::uniform(random), waves = *rc::gen::inRange(2, 6);
  Polygon hoop;
  for (int i = 0; i < 60; ++i) {
    const double angle = 2 * M_PI * i / 60;
    const double radius = 8.0 * (1.0 + depth * std::sin(waves * angle + turn));
    hoop.push_back({40.0 + radius * std::cos(angle), radius * std::sin(angle)});
  }
  const Profile profile{{hoop}};
  RC_PRE(certify(profile).has_value());
  agrees_with_the_definition(profile, random, true);
}

RC_GTEST_PROP(WallThickness, TranslatesAndScalesWithThePot, ()) {
  auto random = *samples::random_engine();
  const auto section = shapes::fair_section(samples::stack(random, 12, 3.0), 0.02);
  RC_PRE(section.has_value() && certify(section->profile).has_value());
  Profile moved = section->profile, larger = section->profile;
  for (Polygon& polygon : moved.pieces)
    for (ProfilePoint& p : polygon) p.y += 64.0;
  for (Polygon& polygon : larger.pieces)
    for (ProfilePoint& p : polygon) p = {3.0 * p.rho, 3.0 * p.y};
  const double wall = min_wall_mm(section->profile);
  RC_ASSERT(std::abs(min_wall_mm(moved) - wall) < 1e-9);
  RC_ASSERT(std::abs(min_wall_mm(larger) - 3.0 * wall) < 1e-9);
}

}  // namespace
}  // namespace clay::solid
