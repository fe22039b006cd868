#include "app/studio/free_place.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace clay::studio {
namespace {

render::PotView tube(float outer_mm, float inner_mm, double height_mm, std::size_t rows) {
  render::PotView pot;
  pot.height_mm = height_mm;
  pot.rows.assign(rows, {outer_mm, inner_mm});
  return pot;
}

Tool sphere(double radius_mm) { return Tool::build(SphereSpec{radius_mm}).value(); }

/// Depth of a sphere in a tube on the wheel [mm], from the distance itself instead of rows.
double depth_mm(const render::PotView& pot, double radius_mm, glm::dvec2 at) {
  const double outer = pot.rows[0].outer_mm, inner = pot.rows[0].inner_mm;
  const double rho = std::abs(at.x);
  const double dx = rho > outer ? rho - outer : rho < inner ? inner - rho : 0.0;
  const double dy = at.y > pot.height_mm ? at.y - pot.height_mm : 0.0;
  return radius_mm - std::hypot(dx, dy);
}

TEST(FreePlace, KeepsAPlaceBesideTheClay) {
  const auto pot = tube(40.0f, 30.0f, 60.0, 120);
  EXPECT_EQ(free_place(pot, sphere(5.0), {60.0, 30.0}), glm::dvec2(60.0, 30.0));
  EXPECT_EQ(free_place(pot, sphere(5.0), {-60.0, 30.0}), glm::dvec2(-60.0, 30.0));
  EXPECT_EQ(free_place(pot, sphere(5.0), {0.0, 30.0}), glm::dvec2(0.0, 30.0));
  EXPECT_EQ(free_place(pot, sphere(5.0), {35.0, 70.0}), glm::dvec2(35.0, 70.0));
}

TEST(FreePlace, ChoosesTheNearerSideOfTheWall) {
  const auto pot = tube(40.0f, 30.0f, 60.0, 120);
  const glm::dvec2 outside = free_place(pot, sphere(5.0), {37.0, 30.0});
  EXPECT_NEAR(outside.x, 45.0 + kClearanceMm, 1e-6);
  EXPECT_EQ(outside.y, 30.0);
  const glm::dvec2 inside = free_place(pot, sphere(5.0), {33.0, 30.0});
  EXPECT_NEAR(inside.x, 25.0 - kClearanceMm, 1e-6);
  const glm::dvec2 left = free_place(pot, sphere(5.0), {-37.0, 30.0});
  EXPECT_NEAR(left.x, -45.0 - kClearanceMm, 1e-6);
}

TEST(FreePlace, IsAboveALumpNearItsTop) {
  const auto lump = tube(40.0f, 0.0f, 60.0, 120);
  const glm::dvec2 above = free_place(lump, sphere(5.0), {5.0, 55.0});
  EXPECT_EQ(above.x, 5.0);
  EXPECT_GE(above.y, 65.0);
  EXPECT_LE(above.y, 65.0 + 0.5 + kClearanceMm);  // one row
}

RC_GTEST_PROP(FreePlace, IsNeverInTheClayAndNeverBelowTheWheel, ()) {
  const float outer = static_cast<float>(*rc::gen::inRange(10, 80));
  const float inner = static_cast<float>(*rc::gen::inRange(0, static_cast<int>(outer) - 2));
  const auto pot = tube(outer, inner, *rc::gen::inRange(5, 120), 200);
  const double radius = *rc::gen::inRange(1, 20);
  const glm::dvec2 at(*rc::gen::inRange(-100, 100), *rc::gen::inRange(-20, 150));
  const glm::dvec2 place = free_place(pot, sphere(radius), at);
  RC_ASSERT(place.y >= 0.0);
  RC_ASSERT(place.x * at.x >= 0.0);
  RC_ASSERT(depth_mm(pot, radius, place) <= 1e-4);  // radii of rows are floats
}

TEST(WallAt, IsTheGapOfTwoToolsOnTheWall) {
  const auto pot = tube(40.0f, 30.0f, 60.0, 120);
  const auto wall = wall_at(pot, sphere(5.0), 30.0);
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->middle_mm, 35.0, 1e-6);
  EXPECT_NEAR(wall->thickness_mm, 10.0 + 2.0 * kClearanceMm, 1e-6);
  EXPECT_FALSE(wall_at(pot, sphere(5.0), 61.0));
  EXPECT_FALSE(wall_at(tube(40.0f, 0.0f, 60.0, 120), sphere(5.0), 30.0));
  EXPECT_FALSE(wall_at(tube(40.0f, 4.0f, 60.0, 120), sphere(5.0), 30.0));  // no room in the bore
}

/// A wall of 8 mm that leans by this radius over height; a bulge of 4 mm on both sides of it.
render::PotView leaning(double lean, bool bulges = false) {
  render::PotView pot = tube(0.0f, 0.0f, 60.0, 120);
  for (std::size_t row = 0; row < pot.rows.size(); ++row) {
    const double up = 0.5 * (static_cast<double>(row) + 0.5) - 30.0, middle = 60.0 + lean * up;
    const double half = bulges && std::abs(up) < 2.0 ? 8.0 : 4.0;
    pot.rows[row] = {static_cast<float>(middle + half), static_cast<float>(middle - half)};
  }
  return pot;
}

/// Two balls of radius f beside a line that leans by s touch it if their middles are 2 f sqrt(1 +
/// s^2) apart; two ribs touch it with their edges.
TEST(StandOff, IsSoFarThatTwoToolsTouchALeaningWallAlongItsWay) {
  const Tool ball = sphere(10.0), rib = Tool::build(RibSpec{20.0, 6.0}).value();
  for (const double lean : {-1.5, -0.5, 0.1, 0.5, 1.0, 1.5}) {
    const double apart = 20.0 * (std::sqrt(1.0 + lean * lean) - 1.0);
    EXPECT_NEAR(stand_off_mm(leaning(lean), ball, 30.0), apart, 0.02) << lean;
    EXPECT_NEAR(stand_off_mm(leaning(lean), rib, 30.0), 20.0 * std::abs(lean), 1e-3) << lean;
  }
  EXPECT_EQ(stand_off_mm(tube(40.0f, 30.0f, 60.0, 120), ball, 30.0), 0.0);
}

/// A pinch is to thin a bulge.
TEST(StandOff, DoesNotSeeBulgesNorSolidClay) {
  EXPECT_NEAR(stand_off_mm(leaning(0.0, true), sphere(10.0), 30.0), 0.0, 1e-6);
  EXPECT_EQ(stand_off_mm(tube(40.0f, 0.0f, 60.0, 120), sphere(10.0), 30.0), 0.0);
  EXPECT_EQ(stand_off_mm(leaning(1.0), sphere(10.0), 200.0), 0.0) << "above the rim";
}

/// Upside down, the bore of a tube is below its foot: no tool gets there.
TEST(FreePlace, IsNeverInACoveredBore) {
  const render::PotView pot = tube(40.0f, 30.0f, 60.0, 120);
  for (const double rho : {-33.0, -5.0, 0.0, 10.0, 31.0, 38.0}) {
    const glm::dvec2 place = free_place(pot, sphere(5.0), {rho, 30.0}, Bore::covered);
    const bool outside = std::abs(place.x) >= 45.0, above = place.y >= 65.0;
    EXPECT_TRUE(outside || above) << rho << ": " << place.x << ", " << place.y;
  }
  EXPECT_EQ(free_place(pot, sphere(5.0), {60.0, 30.0}, Bore::covered), glm::dvec2(60.0, 30.0));
  EXPECT_EQ(free_place(pot, sphere(5.0), {0.0, 70.0}, Bore::covered), glm::dvec2(0.0, 70.0));
}

}  // namespace
}  // namespace clay::studio
