// A wall that stretches where two tools lift it (`ClaySpec::lifted_wall_stretches`).

#include "claystack/engine/wheel.hpp"
#include "tests/engine/wheel/rule_hand.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace clay {
namespace {

constexpr double kBelliedMm = 150.0, kBelliedWallMm = 5.0, kPinchMm = 3.0, kTipMm = 10.0;

SceneSpec lifting_scene(bool stretches) {
  SceneSpec scene = cylinder_scene({.thin_wall_yields = true,
                                    .rim_sinks = true,
                                    .narrow_rim_closes = true,
                                    .lifted_wall_stretches = stretches});
  scene.removal = {200.0, 0.25, 1.0, {}};
  return scene;
}

/// Without rules that move the wall above the tools.
SceneSpec lift_alone() {
  ClaySpec clay = no_rules();
  clay.lift = clay.rim = clay.lifted_wall_stretches = true;
  SceneSpec scene = cylinder_scene(clay);
  scene.removal = {200.0, 0.25, 1.0, {}};
  return scene;
}

/// A belly below a narrow neck.
double bellied(double up) { return 40.0 + 20.0 * std::sin(2.0 * std::numbers::pi * up / 200.0); }

Wheel bellied_wheel(const SceneSpec& scene, double ring_height_mm = kH) {
  return wheel_with(
      scene, kBelliedMm, bellied, [](double up) { return bellied(up) - kBelliedWallMm; },
      ring_height_mm);
}

/// Two tools lift the belly between these heights.
void lift(Wheel& wheel, double from_mm, double to_mm) {
  Hand hand(wheel);
  const auto middle = [](double up) { return bellied(up) - 0.5 * kBelliedWallMm; };
  hand.place_at(middle(from_mm), from_mm, kPinchMm + 4.0);
  hand.move_to(middle(from_mm), from_mm + 0.1, 1.0, kPinchMm);
  for (double up = from_mm + 1.0; up <= to_mm; up += 1.0)
    hand.move_to(middle(up), up, 20.0, kPinchMm);
}

TEST(LiftedWall, AllAboveTheToolsRisesAsItIs) {
  Wheel wheel = bellied_wheel(lifting_scene(true));
  const std::vector<Ring> before(wheel.stack().rings().begin(), wheel.stack().rings().end());
  lift(wheel, 30.0, 70.0);
  expect_balanced(wheel);
  const auto after = wheel.stack().rings();
  ASSERT_GT(after.size(), before.size() + 50);
  // The rings that were above the last place of the tools by more than their radius: each equals
  // the ring at the same place below the rim.
  const auto above = static_cast<std::size_t>((70.0 + kTipMm) / kH) + 1;
  ASSERT_LT(after.size() - before.size() + above, after.size());
  for (std::size_t down = 1; down <= before.size() - above; ++down)
    ASSERT_EQ(after[after.size() - down], before[before.size() - down]) << down;
}

/// In the tick in which it appears, just above the tools.
TEST(LiftedWall, ANewRingIsTheMeanOfItsNeighbours) {
  Wheel wheel = bellied_wheel(lift_alone());
  const double middle = bellied(30.0) - 0.5 * kBelliedWallMm;
  double lean_mm = 0.0;
  int seen = 0;
  for (int tick = 1; tick <= 200; ++tick) {  // later one tool leaves the wall
    const std::vector<Ring> before(wheel.stack().rings().begin(), wheel.stack().rings().end());
    // On no border between rings; closing slowly, so that no tick makes several rings.
    const double y = 30.003 + 0.01 * tick, gap_mm = kBelliedWallMm - 0.01 * tick;
    wheel.step({1000 * tick, {middle, y, 0.0}, false, gap_mm});
    const auto after = wheel.stack().rings();
    if (after.size() != before.size() + 1) continue;
    ++seen;
    const auto place = static_cast<std::size_t>(std::ceil((y + kTipMm) / kH));
    const Ring &below = before[place - 1], &above = before[place];
    lean_mm = std::max(lean_mm, above.outer_mm() - below.outer_mm());
    ASSERT_EQ(after[place + 1], above);
    ASSERT_NEAR(mm2_from_quanta(after[place].outer2),
                0.5 * (mm2_from_quanta(below.outer2) + mm2_from_quanta(above.outer2)), 1e-9);
    ASSERT_NEAR(mm2_from_quanta(after[place].inner2),
                0.5 * (mm2_from_quanta(below.inner2) + mm2_from_quanta(above.inner2)), 1e-9);
  }
  EXPECT_GT(seen, 5);
  EXPECT_GT(lean_mm, 0.01);
}

/// Grown at the rim, the same clay is a pipe on the neck.
TEST(LiftedWall, MakesNoPipeOfANarrowRim) {
  const auto pipe_mm = [](bool stretches) {
    Wheel wheel = bellied_wheel(lifting_scene(stretches));
    lift(wheel, 30.0, 70.0);
    const auto rings = wheel.stack().rings();
    double mm = 0.0;
    for (std::size_t i = rings.size();
         i-- > 0 && std::abs(rings[i].outer_mm() - rings.back().outer_mm()) < 0.2;)
      mm += kH;
    return mm;
  };
  EXPECT_GT(pipe_mm(false), 20.0);
  EXPECT_LT(pipe_mm(true), 5.0);  // the neck by itself: 4.5
}

/// A cylinder with a narrow neck. The wall enters the rolling mill at 5 mm and leaves it at 4 mm,
/// and the neck, whose rings hold half as much clay, rises no faster for that.
TEST(LiftedWall, RisesLikeARollingMill) {
  const auto outer = [](double up) { return std::clamp(145.0 - up, 25.0, 45.0); };
  Wheel wheel =
      wheel_with(lift_alone(), 140.0, outer, [&](double up) { return outer(up) - kBelliedWallMm; });
  constexpr double kGap = 4.0;
  EXPECT_NEAR(rise_of_pinch(wheel, 20.0, kGap), 1.0 - kGap / 5.0,
              0.05 * (1.0 - kGap / 5.0));  // the crown swings by 0.2 mm
  expect_balanced(wheel);
}

/// Where the rim is thicker than the wall, it tapers to the wall as it rises.
TEST(LiftedWall, GrowsAtARimThatIsNotNarrower) {
  const auto thrown = [](bool stretches) {
    Wheel wheel = wheel_with(
        lifting_scene(stretches), 120.0, [](double) { return 45.0; },
        [](double up) { return up < 112.0 ? 40.0 : 37.0; });
    (void)rise_of_pinch(wheel, 20.0, kPinchMm);
    return std::vector<Ring>(wheel.stack().rings().begin(), wheel.stack().rings().end());
  };
  EXPECT_EQ(thrown(true), thrown(false));
}

TEST(LiftedWall, HasALimitAsRingsGetLower) {
  const auto profile = [](double ring_height_mm) {
    Wheel wheel = bellied_wheel(lifting_scene(true), ring_height_mm);
    lift(wheel, 30.0, 70.0);
    std::vector<double> radii;
    for (double up = 20.0; up < 140.0; up += 0.5) radii.push_back(ring_at(wheel, up).outer_mm());
    return radii;
  };
  EXPECT_LT(change_by_halving(0.2, profile), 0.1);
}

/// A wide wall below a rim of half its radius. Tools that reach past the rim leave no place above
/// them.
TEST(LiftedWall, GrowsAtTheRimWhereTheToolsReachIt) {
  const auto outer = [](double up) { return std::clamp(60.0 - 5.0 * (up - 143.0), 25.0, 60.0); };
  const auto rings_lifted = [&](bool stretches, double up) {
    Wheel wheel = wheel_with(lifting_scene(stretches), kBelliedMm, outer,
                             [&](double y) { return outer(y) - kBelliedWallMm; });
    Hand hand(wheel);
    const double middle = 60.0 - 0.5 * kBelliedWallMm;
    hand.place_at(middle, up, kPinchMm + 4.0);
    hand.move_to(middle, up + 1.0, 1.0, kPinchMm);
    expect_balanced(wheel);
    EXPECT_GT(wheel.stack().size(), static_cast<std::size_t>(kBelliedMm / kH));
    return std::vector<Ring>(wheel.stack().rings().begin(), wheel.stack().rings().end());
  };
  EXPECT_EQ(rings_lifted(true, 141.0), rings_lifted(false, 141.0));
  EXPECT_NE(rings_lifted(true, 130.0), rings_lifted(false, 130.0));
}

}  // namespace
}  // namespace clay
