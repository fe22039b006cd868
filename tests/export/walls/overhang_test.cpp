// Expected angles from the geometry of the sections.
#include "claystack/export/walls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clay::solid {
namespace {

double overhang_of(const Polygon& polygon) { return steepest_overhang({{polygon}}).angle_deg; }

TEST(Overhang, OfACylinderIsNone) {
  EXPECT_EQ(overhang_of({{0, 0}, {40, 0}, {40, 60}, {35, 60}, {35, 6}, {0, 6}}), 0.0);
}

TEST(Overhang, OfAConeIsItsAngle) {
  // 30 mm outward over 40 mm of height, outside; the bore is parallel to it.
  const Polygon cone{{0, 0}, {30, 0}, {60, 40}, {54, 40}, {28.5, 6}, {0, 6}};
  const Overhang steepest = steepest_overhang({{cone}});
  EXPECT_NEAR(steepest.angle_deg, std::atan2(30.0, 40.0) * 180.0 / std::numbers::pi, 1e-9);
  EXPECT_NEAR(steepest.from.y, 0.0, 1e-12);
}

TEST(Overhang, OfANarrowingShoulderIsThatOfItsBore) {
  const Polygon bottle{{0, 0}, {40, 0}, {40, 40}, {20, 60}, {14, 60}, {34, 40}, {34, 6}, {0, 6}};
  EXPECT_NEAR(overhang_of(bottle), 45.0, 1e-9);
}

TEST(Overhang, OfACeilingIsNinetyDegrees) {
  const Polygon closed{{0, 0}, {40, 0}, {40, 60}, {0, 60}, {0, 54}, {35, 54}, {35, 6}, {0, 6}};
  EXPECT_NEAR(overhang_of(closed), 90.0, 1e-9);
}

TEST(Overhang, IgnoresTheBedAndStepsShorterThanItsLength) {
  // Steps of 0.1 mm outward for each of 1 mm of height lean by 5.7 degrees as a whole.
  Polygon steps{{0, 0}};
  for (int i = 0; i < 40; ++i) {
    steps.push_back({40 + 0.1 * i, 1.0 * i});
    steps.push_back({40 + 0.1 * i, 1.0 * (i + 1)});
  }
  steps.insert(steps.end(), {{35, 40}, {35, 6}, {0, 6}});
  EXPECT_LT(overhang_of(steps), 12.0);
  EXPECT_GT(overhang_of(steps), 2.0);
}

}  // namespace
}  // namespace clay::solid
