#include "claystack/export/wall_thickness.hpp"

#include "claystack/engine/stack_measures.hpp"
#include "engine/stack_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace clay::solid {
namespace {

double wall_of(Polygon polygon) { return min_wall_mm({{std::move(polygon)}}); }

TEST(WallThickness, OfASolidIsItsDiameter) {
  EXPECT_NEAR(wall_of({{0, 0}, {30, 0}, {30, 50}, {0, 50}}), 50.0, 1e-12);  // base to top
  EXPECT_NEAR(wall_of({{0, 0}, {20, 0}, {20, 50}, {0, 50}}), 40.0, 1e-12);
  EXPECT_NEAR(wall_of({{0, 0}, {20, 0}, {8, 40}, {20, 80}, {0, 80}}), 16.0, 1e-12);  // waist
}

TEST(WallThickness, OfACupIsItsWallOrItsFloor) {
  const auto cup = [](double wall, double floor) {
    return wall_of({{0, 0}, {40, 0}, {40, 60}, {40 - wall, 60}, {40 - wall, floor}, {0, floor}});
  };
  EXPECT_NEAR(cup(5, 8), 5.0, 1e-12);
  EXPECT_NEAR(cup(5, 3), 3.0, 1e-12);
}

TEST(WallThickness, OfALeaningWallIsMeasuredAcrossIt) {
  // A conical tube leaning by 30 degrees: 4 mm along the radius are 4 cos 30 across.
  const double lean = 60.0 * std::tan(M_PI / 6);
  EXPECT_NEAR(wall_of({{40, 0}, {40 + lean, 60}, {36 + lean, 60}, {36, 0}}),
              4.0 * std::cos(M_PI / 6), 1e-12);
}

TEST(WallThickness, OfACavityCountsItsLid) {
  EXPECT_NEAR(wall_of({{0, 0}, {40, 0}, {40, 60}, {0, 60}, {0, 58}, {30, 58}, {30, 9}, {0, 9}}),
              2.0, 1e-12);
}

RC_GTEST_PROP(WallThickness, OfStepsIsTheEnginesOwn, ()) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(1, 25);
  const double h = *rc::gen::element(0.3, 2.0, 15.0);
  const auto floor = *rc::gen::inRange<std::size_t>(0, count + 1);
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < count; ++i) {
    const double outer = 40.0 + 5.0 * samples::uniform(random);
    const double inner = i < floor ? 0.0 : outer - 6.0 - 20.0 * samples::uniform(random);
    rings.push_back({quanta_from_radius(outer), quanta_from_radius(inner)});
  }
  const ClayStack stack = ClayStack::from_rings(h, rings, 0).value();
  RC_ASSERT(std::abs(min_wall_mm(profile_of(stack).value().profile) -
                     min_wall(stack).thickness_mm) < 1e-9);
}

}  // namespace
}  // namespace clay::solid
