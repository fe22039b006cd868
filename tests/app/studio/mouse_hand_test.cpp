#include "app/studio/mouse_hand.hpp"

#include "app/history/pot_scene.hpp"
#include "app/studio/offscreen_host.hpp"
#include "claystack/engine/wheel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

namespace clay::studio {
namespace {

constexpr std::int64_t kTickNs = 1'000'000;
constexpr double kRpm = 120.0;

struct Hand {
  VirtualClock clock;
  MouseDevice device{clock};
  falcon::DeviceSample tick() {
    clock.sleep_until_ns(clock.now_ns() + kTickNs);
    return device.read(0);
  }
};

TEST(MouseHand, StaysAtItsStart) {
  Hand hand;
  hand.device.begin_at({50.0, 20.0, 0.0});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(hand.tick().position_mm, glm::dvec3(50.0, 20.0, 0.0));
}

TEST(MouseHand, RespectsItsSpeedLimit) {
  Hand hand;
  hand.device.begin_at({50.0, 20.0, 0.0});
  hand.tick();
  hand.device.aim({{0.0, 20.0, 0.0}, kPressingMmPerS});
  glm::dvec3 before = hand.tick().position_mm;
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 now = hand.tick().position_mm;
    EXPECT_LE(glm::distance(now, before), 1e-3 * kPressingMmPerS + 1e-12);
    before = now;
  }
}

TEST(MouseHand, ArrivesWithoutOvershoot) {
  Hand hand;
  hand.device.begin_at({50.0, 0.0, 0.0});
  hand.tick();
  hand.device.aim({{40.0, 0.0, 0.0}, kReachingMmPerS});
  double x = 50.0;
  for (int i = 0; i < 400; ++i) {
    const double now = hand.tick().position_mm.x;
    EXPECT_LE(now, x);
    EXPECT_GE(now, 40.0);
    x = now;
  }
  EXPECT_NEAR(x, 40.0, 1e-3);
}

TEST(MouseHand, APausedServoCausesNoJump) {
  Hand hand;
  hand.device.begin_at({50.0, 0.0, 0.0});
  hand.tick();
  hand.device.aim({{0.0, 0.0, 0.0}, kReachingMmPerS});
  hand.clock.sleep_until_ns(hand.clock.now_ns() + 2'000'000'000);
  EXPECT_GE(hand.device.read(0).position_mm.x, 50.0 - 0.01 * kReachingMmPerS - 1e-12);
}

/// A lump of radius 40 and height 60 mm that does not yield, and a ball of 10 mm.
struct Lump {
  Lump() {
    SceneSpec scene;
    scene.lump = {.rings = 120, .ring_height_mm = 0.5, .outer_radius_mm = 40.0};
    scene.tool = {SphereSpec{10.0}, ToolMode::press, {}};
    wheel.emplace(Wheel::build(scene).value());
  }
  std::optional<Wheel> wheel;
};

/// A hand that meets the lump, from this place.
struct HandAtLump : Hand {
  explicit HandAtLump(const glm::dvec3& place_mm) {
    device.begin_at(place_mm);
    device.meet({&lump.wheel->stack(), &lump.wheel->plan().tool, kRpm});
    tick();
  }
  /// Place of the hand after it was pulled to a target for this number of ticks [mm].
  glm::dvec3 pull(const glm::dvec3& to_mm, double bite_mm, int ticks) {
    device.aim({to_mm, kPressingMmPerS, bite_mm});
    for (int i = 1; i < ticks; ++i) tick();
    return tick().position_mm;
  }
  Lump lump;
};

/// The area of a ball of 10 mm beyond a straight edge at a depth, from the integral of its chord.
double segment_mm2(double depth_mm) {
  double area = 0.0;
  constexpr int kParts = 20'000;
  for (int i = 0; i < kParts; ++i) {
    const double t = -10.0 + 20.0 * (i + 0.5) / kParts;
    area += 20.0 / kParts * std::max(0.0, std::sqrt(100.0 - t * t) - (10.0 - depth_mm));
  }
  return area;
}

constexpr double kDeepestMm2 = 6.0;  // 0.3 mm over the height of the ball
constexpr double kUnevenMm2 = 0.3;   // by which rings make an area uneven

TEST(MouseHand, DigsNoFasterThanItsBite) {
  HandAtLump hand({50.5, 30.0, 0.0});
  constexpr double kBiteMmPerS = 0.25;
  hand.device.aim({{0.0, 30.0, 0.0}, kPressingMmPerS, kBiteMmPerS * 60.0 / kRpm});
  double x = 50.5;
  int ticks = 0;
  for (; ticks < 1000; ++ticks) {
    x = hand.tick().position_mm.x;
    // In contact the ball gains at most bite * its height of area per second.
    ASSERT_LE(segment_mm2(50.0 - x), 1e-3 * (ticks + 1) * kBiteMmPerS * 20.0 + kUnevenMm2) << ticks;
  }
  EXPECT_LT(x, 49.5) << "it does dig";
  EXPECT_NEAR(hand.device.stretch_mm(), x, 1e-9) << "the spring, from the tool to the axis";
}

/// A pot with a wide foot: 60 mm high, of radius 40 mm up to 20 mm and 30 mm above.
TEST(MouseHand, MeetsAPotUpsideDownWhereItIs) {
  SceneSpec scene;
  scene.lump = {.rings = 120, .ring_height_mm = 0.5, .outer_radius_mm = 30.0};
  scene.tool = {SphereSpec{5.0}, ToolMode::trim_foot, {}};
  const Wheel wheel = Wheel::build(scene).value();
  std::vector<Ring> rings(120, Ring{quanta_from_radius(30.0), 0});
  std::fill_n(rings.begin(), 40, Ring{quanta_from_radius(40.0), 0});
  const ClayStack clay = ClayStack::from_rings(0.5, std::move(rings), 0).value();
  constexpr double kHeightMm = 60.0;
  const auto pulled = [&](double y_mm, std::optional<double> turned_mm, const glm::dvec3& way) {
    Hand hand;
    const glm::dvec3 begin{60.0, y_mm, 0.0};
    hand.device.begin_at(begin);
    hand.device.meet({&clay, &wheel.plan().tool, kRpm, turned_mm});
    hand.tick();
    hand.device.aim({begin + way, kPressingMmPerS, 0.0});
    for (int i = 0; i < 2000; ++i) hand.tick();
    return hand.tick().position_mm;
  };
  // Beside the clay, at each height as at the same place of the upright pot.
  for (const double y_mm : {8.0, 15.0, 30.0, 52.0}) {
    const double upright = pulled(y_mm, std::nullopt, {-40.0, 0.0, 0.0}).x;
    EXPECT_NEAR(pulled(kHeightMm - y_mm, kHeightMm, {-40.0, 0.0, 0.0}).x, upright, 1e-6) << y_mm;
    EXPECT_NEAR(upright, y_mm < 20.0 ? 45.0 : 35.0, 0.5) << y_mm;
  }
}

/// It stands on the foot, which is at the top.
TEST(MouseHand, DoesNotSinkIntoTheFootOfAPotUpsideDown) {
  HandAtLump hand({20.0, 75.0, 0.0});
  hand.device.meet({&hand.lump.wheel->stack(), &hand.lump.wheel->plan().tool, kRpm, 60.0});
  const glm::dvec3 place = hand.pull({20.0, 0.0, 0.0}, 1000.0, 4000);
  EXPECT_NEAR(place.y, 60.0 + 10.0 - 1.0, 0.5) << "1 mm below the surface, as on an upright pot";
}

/// Clay that yields at once does not let the hand dig faster: the ball gains the area of its bite,
/// which bulging clay makes a little larger.
TEST(MouseHand, ItsBiteLimitsItInSoftClay) {
  HandAtLump hand({50.5, 30.0, 0.0});
  constexpr double kBiteMm = 1.0, kHeightMm = 20.0;
  hand.device.aim({{0.0, 30.0, 0.0}, kPressingMmPerS, kBiteMm});
  double from_s = 0.0, to_s = 0.0;
  for (int i = 1; i <= 5000; ++i) {
    const glm::dvec3 place = hand.tick().position_mm;
    hand.lump.wheel->step({1000 * i, place});
    if (from_s == 0.0 && place.x < 47.0) from_s = 1e-3 * i;
    if (to_s == 0.0 && place.x < 45.0) to_s = 1e-3 * i;
  }
  ASSERT_GT(to_s, 0.0);
  const double expected_s =
      (segment_mm2(5.0) - segment_mm2(3.0)) / (kBiteMm * kRpm / 60.0 * kHeightMm);
  EXPECT_NEAR(to_s - from_s, expected_s, 0.08 * expected_s);
}

/// A wall at its minimum and a lump that is too stiff stop the hand for as long as it pushes.
TEST(MouseHand, StopsWhereClayDoesNotGiveWay) {
  HandAtLump hand({50.5, 30.0, 0.0});
  const double x = hand.pull({0.0, 30.0, 0.0}, 8.0, 5000).x;
  EXPECT_LE(segment_mm2(50.0 - x), kDeepestMm2 + 0.1);
  EXPECT_GT(segment_mm2(50.0 - x), 0.5 * kDeepestMm2);
}

/// A floor at its minimum: the tool stands on it, 1 mm deep by whole rings, and still goes along
/// it.
TEST(MouseHand, StandsOnAFloorThatDoesNotGiveWay) {
  HandAtLump hand({0.0, 75.0, 0.0});
  EXPECT_NEAR(hand.pull({0.0, 30.0, 0.0}, 8.0, 3000).y, 69.0, 0.6);
  const glm::dvec3 place = hand.pull({20.0, 30.0, 0.0}, 8.0, 3000);
  EXPECT_NEAR(place.x, 20.0, 0.1);
  EXPECT_NEAR(place.y, 69.0, 0.6);
}

/// Beside the clay the tool goes down to the wheel, and its lower half below it.
TEST(MouseHand, IsFreeDownBesideTheClay) {
  HandAtLump hand({50.5, 30.0, 0.0});
  EXPECT_NEAR(hand.pull({50.5, 2.0, 0.0}, 8.0, 1000).y, 2.0, 0.1);
}

TEST(MouseHand, ItsBiteMayChangeDuringAStroke) {
  HandAtLump hand({50.0, 30.0, 0.0});
  const auto dig = [&](double bite_mm) {
    return segment_mm2(50.0 - hand.pull({0.0, 30.0, 0.0}, bite_mm, 101).x);
  };
  const double soft_mm2 = dig(0.2);
  // 0.1 s of 2 turns a second, over a height of 20 mm. The hand uses at least half of the permitted
  // area.
  EXPECT_LE(soft_mm2, 0.2 * 0.2 * 20.0 + kUnevenMm2);
  const double firm_mm2 = dig(1.0) - soft_mm2;
  EXPECT_GT(firm_mm2, 0.5 * 0.2 * 1.0 * 20.0);
  EXPECT_LE(firm_mm2, 0.2 * 1.0 * 20.0 + kUnevenMm2);
}

TEST(MouseHand, IsFreeAlongTheClayAndAwayFromIt) {
  HandAtLump hand({48.0, 30.0, 0.0});  // 2 mm deep
  EXPECT_NEAR(hand.pull({48.0, 45.0, 0.0}, 0.25, 401).y, 45.0, 0.1);
  EXPECT_NEAR(hand.pull({60.0, 45.0, 0.0}, 0.25, 401).x, 60.0, 0.1);
}

/// The height of a lump of radius 50 and height 60 mm after a stroke of the mouse from above it
/// into it, with the clay of a new work; none if the lump has fallen.
std::optional<double> height_after_stroke(const glm::dvec3& from_mm, const glm::dvec3& to_mm,
                                          bool rim_sinks) {
  SceneSpec scene = history::usual_scene(60.0);
  scene.lump = {.rings = 120, .ring_height_mm = 0.5, .outer_radius_mm = 50.0};
  scene.tool = {SphereSpec{10.0}, ToolMode::press, {}};
  scene.stability = StabilitySpec{15.0};
  scene.clay->rim_sinks = rim_sinks;
  Wheel wheel = Wheel::build(scene).value();
  Hand hand;
  hand.device.begin_at(from_mm);
  hand.device.meet({&wheel.stack(), &wheel.plan().tool, kRpm});
  hand.device.aim({to_mm, kPressingMmPerS, 8.0});
  for (int i = 1; i <= 1500 && !wheel.collapsed(); ++i)
    wheel.step({1000 * i, hand.tick().position_mm, false, 0.0});
  return wheel.collapsed() ? std::nullopt : std::optional(wheel.stack().height_mm());
}

/// A newcomer's first strokes. Where the rim does not sink, many push the clay outside of the tool
/// up, to a pillar of twice the height, or make the lump fall.
TEST(MouseHand, NoStrokeFromAboveMakesAPillar) {
  constexpr double kHighMm = 75.0;  // the lump is 60 mm high
  int pillars_without = 0;
  for (const double from : {5.0, 20.0, 35.0, 50.0})
    for (const double to : {10.0, 25.0, 40.0, 55.0})
      for (const double down : {25.0, 45.0}) {
        const glm::dvec3 above_mm{from, 75.0, 0.0}, in_mm{to, down, 0.0};
        const auto height = height_after_stroke(above_mm, in_mm, true);
        ASSERT_TRUE(height.has_value()) << from << ' ' << to << ' ' << down;
        EXPECT_LT(*height, kHighMm) << from << ' ' << to << ' ' << down;
        if (height_after_stroke(above_mm, in_mm, false).value_or(1e3) > kHighMm) ++pillars_without;
      }
  EXPECT_GT(pillars_without, 5);
}

TEST(MouseHand, SamplesAreReadyAndFreshOnce) {
  Hand hand;
  hand.device.begin_at({50.0, 0.0, 0.0});
  const falcon::DeviceSample first = hand.tick();
  EXPECT_EQ(first.state, falcon::DeviceState::ready);
  EXPECT_TRUE(first.fresh);
  EXPECT_FALSE(hand.device.read(0).fresh);  // at the same time
  EXPECT_FALSE(hand.device.info().can_push);
}

}  // namespace
}  // namespace clay::studio
