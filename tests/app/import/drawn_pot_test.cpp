#include "app/import/drawn_pot.hpp"

#include "app/import/deviation.hpp"
#include "tests/app/import/solids.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace clay::importing {
namespace {

using testing::HasSubstr;

Result<Pot> pot_of(const std::string& csv, const DrawnPotSettings& settings = {}) {
  return section_of(csv, "pot.csv").and_then([&](HalfSection&& section) {
    return drawn_pot(section, settings, "pot.csv").map([](DrawnPot&& drawn) { return drawn.pot; });
  });
}

TEST(DrawnPot, EachRingHoldsItsSliceOfACone) {
  const auto pot = pot_of("40,0\n20,90\n", {0.75, {}, 1.9});
  ASSERT_TRUE(pot) << refusal_of(pot);
  ASSERT_EQ(pot->stack.size(), 120u);
  EXPECT_EQ(pot->stack.ring_height_mm(), 0.75);
  for (std::size_t i = 0; i < 120; ++i) {
    const double a = 40.0 - 20.0 * static_cast<double>(i) / 120.0, b = a - 20.0 / 120.0;
    EXPECT_NEAR(mm2_from_quanta(pot->stack.rings()[i].outer2), (a * a + a * b + b * b) / 3.0, 1e-9);
    EXPECT_EQ(pot->stack.rings()[i].inner2, 0);
  }
  EXPECT_EQ(pot->ledger.imbalance(pot->stack.volume()), 0);
}

TEST(DrawnPot, RingBoundsMeetAFloor) {
  // A floor at 3 of 10 mm: rings of at most 2 mm meet it when they are 1 mm high.
  const std::string cup = "0,0\n30,0\n30,10\n20,10\n20,3\n0,3\n";
  const auto pot = pot_of(cup, {2.0, {}, 1.9});
  ASSERT_TRUE(pot) << refusal_of(pot);
  ASSERT_EQ(pot->stack.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_EQ(pot->stack.rings()[i].inner2, i < 3 ? 0 : quanta_from_mm2(400.0)) << i;
  EXPECT_EQ(pot->stack.crown(), 0);
}

TEST(DrawnPot, RingsThatFitAFloorAreNotLowerThanAStackAllows) {
  // Rings of 1 um do not meet the floor. Lower ones would, and a stack cannot have them.
  const auto pot =
      pot_of("0,0\n30,0\n30,0.02\n20,0.02\n20,0.00333\n0,0.00333\n", {kMinRingHeightMm, {}, 1.9});
  ASSERT_TRUE(pot) << refusal_of(pot);
  EXPECT_EQ(pot->stack.size(), 20u);
  // No whole number of the lowest rings: they are a little higher.
  const auto cone = pot_of("40,0\n20,0.0205\n", {kMinRingHeightMm, {}, 1.9});
  ASSERT_TRUE(cone) << refusal_of(cone);
  EXPECT_EQ(cone->stack.size(), 20u);
}

TEST(DrawnPot, FloorsOfAnyHeightAreLevel) {
  for (const double floor : {5.0, 6.0, 4.51, 3.14159, 7.77, 0.3}) {
    for (const double height : {60.0, 61.803, 172.0}) {
      const auto section = section_of(
          fmt::format("0,0\n30,0\n32,{0}\n28,{0}\n26,{1}\n0,{1}\n", height, floor), "pot.csv");
      ASSERT_TRUE(section) << refusal_of(section);
      const auto drawn = drawn_pot(*section, {}, "pot.csv");
      ASSERT_TRUE(drawn) << refusal_of(drawn);
      EXPECT_LE(drawn->deviation.mm, kDrawnDeviationMm) << floor << " of " << height;
      const ClayStack& stack = drawn->pot.stack;
      std::size_t solid = 0;
      while (stack.rings()[solid].inner2 == 0) ++solid;
      EXPECT_NEAR(static_cast<double>(solid) * stack.ring_height_mm(), floor, kDrawnDeviationMm);
      // No ring is partly floor: that would be a pit in it.
      EXPECT_NEAR(stack.rings()[solid].inner_mm(), 26.0, 0.05) << floor << " of " << height;
    }
  }
}

TEST(DrawnPot, DeviationIsThatOfTheSteps) {
  // The rim is drawn to 60 mm; the highest step has the mean square radius of its 2 mm.
  const auto section = section_of("20,0\n60,40\n", "pot.csv");
  ASSERT_TRUE(section) << refusal_of(section);
  const auto coarse = drawn_pot(*section, {2.0, {}, 1.9}, "pot.csv");
  ASSERT_TRUE(coarse) << refusal_of(coarse);
  EXPECT_NEAR(coarse->deviation.mm, 60.0 - std::sqrt((58.0 * 58.0 + 58.0 * 60.0 + 3600.0) / 3.0),
              kDeviationStepMm);
  EXPECT_EQ(coarse->deviation.height_mm, 40.0);
  const auto fine = drawn_pot(*section, {}, "pot.csv");
  ASSERT_TRUE(fine) << refusal_of(fine);
  EXPECT_LE(fine->deviation.mm, kDrawnDeviationMm);
  EXPECT_GT(fine->deviation.mm, 0.5 * kDrawnDeviationMm) << "no more rings than it needs";
  const auto straight = section_of("20,0\n20,40\n", "pot.csv");
  EXPECT_NEAR(drawn_pot(*straight, {}, "pot.csv")->deviation.mm, 0.0, 1e-9);
}

/// Without more wall for facets.
DrawnPotSettings exact(std::optional<double> ring_height_mm, double wall_mm) {
  DrawnPotSettings settings{ring_height_mm, wall_mm};
  settings.facets_mm = 0.0;
  return settings;
}

TEST(DrawnPot, WallOptionHollowsTheOutline) {
  const auto pot = pot_of("30,0\n30,60\n", exact(2.0, 6.0));
  ASSERT_TRUE(pot) << refusal_of(pot);
  for (std::size_t i = 0; i < 30; ++i)
    EXPECT_NEAR(pot->stack.rings()[i].inner_mm(), i < 3 ? 0.0 : 24.0, 1e-9) << i;
  EXPECT_THAT(refusal_of(pot_of("20,0\n30,0\n30,10\n20,10\n20,0\n", exact(2.0, 6.0))),
              HasSubstr("found a bore in it"));
  EXPECT_THAT(
      refusal_of(pot_of("30,0\n25,60\n", exact(2.0, 40.0))),
      HasSubstr(": wall: expected a wall that leaves a bore up to the rim, found 40 mm; there "
                "would be no bore"));
  // The neck is 3 mm wide from 40 to 60 mm. The disc of 4 mm touches its edge at 37.35 mm.
  EXPECT_THAT(refusal_of(pot_of("30,0\n30,40\n3,40\n3,60\n30,60\n30,90\n", exact(2.0, 4.0))),
              HasSubstr("the bore would close 37.4 mm above the foot"));
  EXPECT_THAT(refusal_of(pot_of("90,0\n90,40\n", exact(2.0, 40.0))),
              HasSubstr(": wall: expected less than the height of 40 mm"));
}

TEST(DrawnPot, AHollowedWallIsEvenHoweverItLeans) {
  // A cone that opens by 3 in 4: 5 mm across its wall are 6.25 mm horizontally.
  const auto section = section_of("40,0\n70,40\n", "pot.csv");
  const auto cone = drawn_pot(*section, exact(0.1, 5.0), "pot.csv");
  ASSERT_TRUE(cone) << refusal_of(cone);
  const auto& rings = cone->pot.stack.rings();
  EXPECT_EQ(rings[49].inner_mm(), 0.0);
  for (std::size_t i = 50; i < rings.size(); ++i)
    EXPECT_NEAR(rings[i].inner_mm(), 40.0 + 0.75 * (0.1 * static_cast<double>(i) + 0.05) - 6.25,
                2e-3)
        << i;
  ASSERT_TRUE(cone->thinnest);
  EXPECT_NEAR(cone->thinnest->mm, 5.0, kFlatMm);
  EXPECT_FALSE(drawn_pot(*section, {}, "pot.csv")->thinnest);
  // A dish whose wall rises by 5 mm over 50.
  const auto dish = section_of("30,0\n80,5\n80,10\n", "pot.csv");
  const auto flat = drawn_pot(*dish, exact({}, 3.0), "pot.csv");
  ASSERT_TRUE(flat) << refusal_of(flat);
  EXPECT_NEAR(flat->thinnest->mm, 3.0, kFlatMm);
}

TEST(DrawnPot, TheBoreOfAHemisphereIsAHemisphere) {
  // Of 40 mm about (0, 40), cut level at 39 mm, with a foot where it is 1 mm above the wheel.
  std::string csv;
  for (double z = 1.0; z <= 39.0; z += 0.05)
    csv += fmt::format("{:.9f},{:.9f}\n", std::sqrt(1600.0 - (40.0 - z) * (40.0 - z)), z - 1.0);
  const auto pot = pot_of(csv, exact(0.25, 4.0));
  ASSERT_TRUE(pot) << refusal_of(pot);
  const auto& rings = pot->stack.rings();
  for (std::size_t i = 16; i < rings.size(); ++i) {
    // The mean square over the ring; the foot is nearer than the sphere up to 4 mm above it.
    const double low = 0.25 * static_cast<double>(i) - 39.0, high = low + 0.25;
    const double square = 36.0 * 36.0 - (low * low + low * high + high * high) / 3.0;
    EXPECT_NEAR(rings[i].inner_mm(), std::sqrt(square), 5e-3) << i;
  }
}

/// The wall of a cone gets more for the facets of an export, and its floor does not.
TEST(DrawnPot, AWallGetsMoreForFacets) {
  const auto section = section_of("40,0\n70,40\n", "pot.csv");
  const auto cone = drawn_pot(*section, {0.1, 5.0}, "pot.csv");
  ASSERT_TRUE(cone) << refusal_of(cone);
  const auto& rings = cone->pot.stack.rings();
  EXPECT_EQ(rings[49].inner_mm(), 0.0);
  EXPECT_NEAR(rings[50].inner_mm(), 40.0 + 0.75 * 5.05 - 1.25 * (5.0 + kFacetsMm), 2e-3);
}

TEST(DrawnPot, TheBoreKeepsItsDistanceFromLedges) {
  // A stem of radius 20 below a head of radius 50. Above the stem, which ends at 30 mm, the bore
  // follows a circle of 6 mm about the edge between them: from 14 mm to 20.
  constexpr double kPi = std::numbers::pi;
  const auto section = section_of("20,0\n20,30\n50,30\n50,60\n", "pot.csv");
  const auto hollow = hollowed(*section, 6.0, "pot.csv");
  ASSERT_TRUE(hollow) << refusal_of(hollow);
  const double circle = 20.0 * 20.0 * 6.0 - 2.0 * 20.0 * 9.0 * kPi + (36.0 * 6.0 - 72.0);
  EXPECT_NEAR(section->volume_mm3() - hollow->volume_mm3(),
              kPi * (14.0 * 14.0 * 24.0 + circle + 44.0 * 44.0 * 24.0), 1.0);
}

TEST(DrawnPot, ABoreOfAlmostNoRadiusHasNumbers) {
  // The bore is 4e-16 mm wide from 13 to about 20 mm: the part of its slope below that is beside
  // the axis rounds to a single height.
  const auto section =
      section_of("2,0\n2,10\n3.0000000000000004,10\n3.0000000000000004,20\n30,40\n", "pot.csv");
  ASSERT_TRUE(section) << refusal_of(section);
  const auto hollow = hollowed(*section, 3.0, "pot.csv");
  ASSERT_TRUE(hollow) << refusal_of(hollow);
  double height_mm = 0.0;
  for (const Slab& slab : hollow->slabs) {
    EXPECT_EQ(slab.from_mm, height_mm);
    EXPECT_LT(slab.from_mm, slab.to_mm);
    EXPECT_GE(slab.inner_from_mm, 0.0) << slab.from_mm;
    EXPECT_GE(slab.inner_to_mm, 0.0) << slab.from_mm;
    height_mm = slab.to_mm;
  }
  EXPECT_EQ(height_mm, 40.0);
}

/// The radius of the bore at a height, from every straight piece of the outside: the nearest point
/// of the outside is a wall away. By halving, without the derivative.
double bore_mm(const HalfSection& section, double wall_mm, double height_mm) {
  double radius = 1e300;
  for (const Slab& slab : section.slabs) {
    const auto limit = [&](double z) {
      const double d = z - height_mm;
      const double part = (z - slab.from_mm) / (slab.to_mm - slab.from_mm);
      return std::lerp(slab.outer_from_mm, slab.outer_to_mm, part) -
             std::sqrt(std::max(0.0, wall_mm * wall_mm - d * d));
    };
    double low = std::max(slab.from_mm, height_mm - wall_mm);
    double high = std::min(slab.to_mm, height_mm + wall_mm);
    if (!(low < high)) continue;
    for (int i = 0; i < 200; ++i) {  // convex
      const double a = (2.0 * low + high) / 3.0, b = (low + 2.0 * high) / 3.0;
      if (limit(a) < limit(b))
        high = b;
      else
        low = a;
    }
    radius = std::min({radius, limit(low), limit(high)});
  }
  return radius;
}

TEST(DrawnPot, TheBoreKeepsItsDistanceFromManySteps) {
  // A wave with steps on it; its least radius within reach is often far from the height.
  std::string csv;
  constexpr int kSteps = 2000;
  for (int i = 0; i <= kSteps; ++i)
    csv += fmt::format("{},{}\n", 60.0 + 15.0 * std::sin(0.011 * i) + 0.05 * (i % 7), 0.1 * i);
  const auto section = section_of(csv, "pot.csv");
  ASSERT_TRUE(section) << refusal_of(section);
  const double wall = 20.0;
  const auto hollow = hollowed(*section, wall, "pot.csv");
  ASSERT_TRUE(hollow) << refusal_of(hollow);
  for (std::size_t i = 0; i < hollow->slabs.size(); i += 97) {
    const Slab& slab = hollow->slabs[i];
    const double height = 0.5 * (slab.from_mm + slab.to_mm);
    if (height < wall) continue;
    EXPECT_NEAR(0.5 * (slab.inner_from_mm + slab.inner_to_mm), bore_mm(*section, wall, height),
                kFlatMm)
        << height;
  }
}

RC_GTEST_PROP(DrawnPot, AHollowedWallIsNowhereThinner, ()) {
  std::string csv;
  double height = 0.0;
  for (int i = *rc::gen::inRange(2, 20); i > 0; --i) {
    csv += fmt::format("{},{}\n", 0.01 * *rc::gen::inRange(1000, 9000), height);
    height += 0.01 * *rc::gen::inRange(0, 3000);
  }
  const double wall = 0.1 * *rc::gen::inRange(5, 80);
  const auto section = section_of(csv, "pot.csv");
  RC_PRE(section.has_value());
  const auto pot = hollowed(*section, wall, "pot.csv");
  RC_PRE(pot.has_value());
  const double thinnest = thinnest_wall(*pot).mm;
  RC_ASSERT(thinnest > wall - 2.0 * kFlatMm);
  RC_ASSERT(thinnest < wall + 2.0 * kFlatMm);
}

/// From a segment, by halving.
double distance_mm(const Segment& segment, glm::dvec2 p) {
  double low = 0.0, high = 1.0;
  const auto at = [&](double part) {
    return glm::length(glm::mix(segment.from, segment.to, part) - p);
  };
  for (int i = 0; i < 100; ++i) {  // convex
    const double a = (2.0 * low + high) / 3.0, b = (low + 2.0 * high) / 3.0;
    if (at(a) < at(b))
      high = b;
    else
      low = a;
  }
  return at(low);
}

RC_GTEST_PROP(DrawnPot, TheNearestSegmentIsFoundFromNearAndFar, ()) {
  std::vector<Segment> outline;
  glm::dvec2 end{30.0, 0.0};
  for (int i = *rc::gen::inRange(1, 300); i > 0; --i) {
    const glm::dvec2 start = end;
    end += 0.01 * glm::dvec2(*rc::gen::inRange(-300, 300), *rc::gen::inRange(-20, 200));
    outline.push_back({start, end});
  }
  std::vector<glm::dvec2> points;
  for (int i = 0; i < 20; ++i)
    points.emplace_back(*rc::gen::inRange(-100, 200), *rc::gen::inRange(-100, 400));
  const std::vector<double> found = distances_from(outline, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double wanted = 1e300;
    for (const Segment& segment : outline)
      wanted = std::min(wanted, distance_mm(segment, points[i]));
    RC_ASSERT(std::abs(found[i] - wanted) < 1e-6);
  }
}

TEST(DrawnPot, RefusesShapesThatNoStackCanRepresent) {
  EXPECT_THAT(refusal_of(pot_of("30,0\n30,60000\n", {1e-3, {}, 1.9})), HasSubstr("rings"));
  EXPECT_THAT(refusal_of(pot_of("6000,0\n6000,60\n")), HasSubstr("5000 mm"));
}

RC_GTEST_PROP(DrawnPot, HoldsTheDrawnVolume, ()) {
  std::string csv;
  double height = 0.0;
  const int count = *rc::gen::inRange(2, 20);
  for (int i = 0; i < count; ++i) {
    csv +=
        std::to_string(0.01 * *rc::gen::inRange(100, 9000)) + "," + std::to_string(height) + "\n";
    height += 0.01 * *rc::gen::inRange(1, 3000);
  }
  const auto section = section_of(csv, "pot.csv");
  RC_ASSERT(section.has_value());
  const auto pot = drawn_pot(*section, {0.01 * *rc::gen::inRange(1, 500), {}, 1.9}, "pot");
  RC_ASSERT(pot.has_value());
  // Half a quantum per bound and ring, plus the rounding of the sums.
  const double slack = 1e-12 * section->volume_mm3() + static_cast<double>(pot->pot.stack.size()) *
                                                           pot->pot.stack.mm3_per_quantum();
  const ClayStack& stack = pot->pot.stack;
  RC_ASSERT(std::abs(stack.volume_mm3() - section->volume_mm3()) < slack);
  RC_ASSERT(stack.recount() == stack.volume());
}

}  // namespace
}  // namespace clay::importing
