// Expected angles from the geometry of the sections.
#include "claystack/export/walls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clay::solid {
namespace {

constexpr double kDeg = 180.0 / std::numbers::pi;

double overhang_of(const Polygon& polygon) { return steepest_overhang({{polygon}}).angle_deg; }

/// A solid cone on its tip, 40 mm high, as steps that lean outward.
Polygon stairs(double step_mm, double lean_deg) {
  const double aside = step_mm * std::tan(lean_deg / kDeg);
  Polygon polygon{{0, 0}};
  const int steps = static_cast<int>(40.0 / step_mm);
  for (int i = 0; i < steps; ++i) {
    polygon.push_back({30 + aside * i, step_mm * i});
    polygon.push_back({30 + aside * i, step_mm * (i + 1)});
  }
  polygon.push_back({0, step_mm * steps});
  return polygon;
}

/// A cup with a level ledge at half its height.
Polygon ledge(double width_mm) {
  return {{0, 0},   {40, 0}, {40, 20}, {40 + width_mm, 20}, {40 + width_mm, 40},
          {34, 40}, {34, 5}, {0, 5}};
}

/// A cup of radius 40 mm with an arc of this radius at its lower edge.
Polygon rounded_foot(double radius_mm) {
  Polygon polygon{{0, 0}};
  for (int i = 0; i <= 90; ++i)
    polygon.push_back({40 - radius_mm + radius_mm * std::sin(i / kDeg),
                       radius_mm - radius_mm * std::cos(i / kDeg)});
  polygon.insert(polygon.end(), {{40, 60}, {35, 60}, {35, 6}, {0, 6}});
  return polygon;
}

TEST(Overhang, OfACylinderIsNone) {
  EXPECT_EQ(overhang_of({{0, 0}, {40, 0}, {40, 60}, {35, 60}, {35, 6}, {0, 6}}), 0.0);
}

TEST(Overhang, OfAConeIsItsAngle) {
  // 30 mm outward over 40 mm of height, outside; the bore is parallel to it.
  const Polygon cone{{0, 0}, {30, 0}, {60, 40}, {54, 40}, {28.5, 6}, {0, 6}};
  const Overhang steepest = steepest_overhang({{cone}});
  EXPECT_NEAR(steepest.angle_deg, std::atan2(30.0, 40.0) * kDeg, 1e-6);
  EXPECT_NEAR(steepest.at.rho - 30.0, 0.75 * steepest.at.y, 1e-9) << "on the outside";
}

TEST(Overhang, OfANarrowingShoulderIsThatOfItsBore) {
  const Polygon bottle{{0, 0}, {40, 0}, {40, 40}, {20, 60}, {14, 60}, {34, 40}, {34, 6}, {0, 6}};
  EXPECT_NEAR(overhang_of(bottle), 45.0, 1e-6);
}

TEST(Overhang, OfACeilingIsNinetyDegrees) {
  const Polygon closed{{0, 0}, {40, 0}, {40, 60}, {0, 60}, {0, 54}, {35, 54}, {35, 6}, {0, 6}};
  EXPECT_NEAR(overhang_of(closed), 90.0, 1e-9);
}

TEST(Overhang, OfStepsIsTheirLean) {
  for (const double step_mm : {0.04, 0.235, 0.25, 0.4})
    for (const double lean_deg : {5.0, 20.0, 60.0, 70.0, 80.0})
      EXPECT_NEAR(overhang_of(stairs(step_mm, lean_deg)), lean_deg, 0.01) << step_mm;
}

TEST(Overhang, OfStepsInABoreIsTheirLean) {
  // A bottle whose bore narrows by steps.
  const double lean_deg = 38.8, aside = 0.04 * std::tan(lean_deg / kDeg);
  Polygon bottle{{0, 0}, {60, 0}, {60, 40}};
  for (int i = 500; i > 0; --i) {
    bottle.push_back({50 - aside * i, 20 + 0.04 * i});
    bottle.push_back({50 - aside * i, 20 + 0.04 * (i - 1)});
  }
  bottle.insert(bottle.end(), {{50, 20}, {50, 6}, {0, 6}});
  EXPECT_NEAR(overhang_of(bottle), lean_deg, 0.01);
}

TEST(Overhang, OfALedgeGrowsWithItsWidth) {
  // The outermost 4 mm2 are 0.016 mm wide.
  for (const double width_mm : {0.2, 0.5, 1.0, 1.7, 1.79, 2.5})
    EXPECT_NEAR(std::tan(overhang_of(ledge(width_mm)) / kDeg), width_mm / 0.5, 0.04) << width_mm;
  EXPECT_EQ(overhang_of(ledge(6.0)), 90.0) << "no clay within 5 mm";
}

TEST(Overhang, IsNoneNearTheBed) {
  // The face is at 45 degrees at a height of (1 - cos 45) r.
  EXPECT_LT(overhang_of(rounded_foot(1.6)), 45.0);
  EXPECT_GT(overhang_of(rounded_foot(3.0)), 45.0);
  // A recess below the foot.
  EXPECT_EQ(overhang_of({{0, 0.4}, {30, 0.4}, {30, 0}, {40, 0}, {40, 9}, {0, 9}}), 0.0);
  EXPECT_EQ(overhang_of({{0, 0.6}, {30, 0.6}, {30, 0}, {40, 0}, {40, 9}, {0, 9}}), 90.0);
}

TEST(Overhang, IgnoresFewerThanFourSquareMillimetres) {
  // A level ledge of 2 pi 0.3 x 1 mm2 = 1.9 mm2, and one of 2 pi 0.8 x 1 mm2 = 5.0 mm2.
  const auto pin = [](double r) {
    return Polygon{{0, 0}, {r, 0}, {r, 5}, {r + 1, 5}, {r + 1, 9}, {0, 9}};
  };
  EXPECT_EQ(overhang_of({{0, 0}, {0.3, 0}, {0.3, 5}, {0.8, 5}, {0.8, 9}, {0, 9}}), 0.0);
  EXPECT_GT(overhang_of(pin(0.8)), 1.0);
}

TEST(OverhangLimit, IsMetByAnUndersideDrawnAtIt) {
  const OverhangLimit limit{45.0, "s"};
  EXPECT_TRUE(limit.met_by(45.05));
  EXPECT_FALSE(limit.met_by(45.2));
}

}  // namespace
}  // namespace clay::solid
