// The samples, thrown by a hand with the clay rules: sessions that match their scripts, at the
// speed of a hand, and pots that a potter would keep.

#include "app/bench/hands/pot_measures.hpp"
#include "app/strokes/strokes.hpp"
#include "tests/samples/sample_files.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace clay::samples {
namespace {

using strokes::parse_strokes;
using strokes::play;
using strokes::StrokeScript;

const std::string kFolder = CLAYSTACK_SAMPLES "/";

SceneSpec scene_of(const std::string& sample) {
  return parse_file(kFolder + sample + ".scene.json", parse_scene);
}

StrokeScript script_of(const std::string& sample) {
  return parse_file(kFolder + "strokes/" + sample + ".strokes.json", parse_strokes);
}

std::string session_text(const std::string& sample) {
  return read_file(kFolder + sample + ".session").value();
}

/// A session after replay.
struct Played {
  Wheel wheel;
  std::vector<Pose> poses;
  std::size_t standing = 0;         ///< poses before the collapse
  std::uint32_t flags = 0;          ///< flags of all ticks
  double fastest_press_mm_s = 0.0;  ///< of the tool in the clay
};

const Played& played(const char* sample) {
  static std::map<std::string, Played> all;
  if (const auto found = all.find(sample); found != all.end()) return found->second;
  Played play{Wheel::build(scene_of(sample)).value(),
              parse_session(session_text(sample), sample).value().poses};
  const Pose* last = nullptr;
  for (const Pose& pose : play.poses) {
    const std::uint32_t flags = play.wheel.step(pose).flags;
    play.flags |= flags;
    if (!play.wheel.collapsed()) ++play.standing;
    if (last != nullptr && (flags & kContact) != 0)
      play.fastest_press_mm_s = std::max(play.fastest_press_mm_s,
                                         1e6 * glm::distance(pose.position_mm, last->position_mm) /
                                             static_cast<double>(pose.time_us - last->time_us));
    last = &pose;
  }
  return all.emplace(sample, std::move(play)).first->second;
}

/// The first ring with a bore.
std::size_t floor_rings(const ClayStack& stack) {
  const auto bored =
      std::ranges::find_if(stack.rings(), [](const Ring& ring) { return ring.inner2 > 0; });
  return static_cast<std::size_t>(bored - stack.rings().begin());
}

/// Rings between two heights.
std::span<const Ring> between(const ClayStack& stack, double low_mm, double high_mm) {
  const auto at = [&](double mm) {
    return std::min(stack.size(), static_cast<std::size_t>(mm / stack.ring_height_mm()));
  };
  return stack.rings().subspan(at(low_mm), at(high_mm) - at(low_mm));
}

double widest_mm(std::span<const Ring> rings) {
  return 2.0 * std::ranges::max(rings, {}, &Ring::outer2).outer_mm();
}

double narrowest_mm(std::span<const Ring> rings) {
  return 2.0 * std::ranges::min(rings, {}, &Ring::outer2).outer_mm();
}

class Sample : public testing::TestWithParam<const char*> {};

TEST_P(Sample, SessionMatchesItsScript) {
  const std::string sample = GetParam();
  const SceneSpec scene = scene_of(sample);
  const auto poses = play(script_of(sample), scene, Wheel::build(scene).value()).value().poses;
  // Not EXPECT_EQ, which would print a megabyte.
  EXPECT_TRUE(session_text(sample) == write_session({scene.name, hash_of(scene), poses, false}));
}

TEST_P(Sample, UsesTheClayRules) { EXPECT_TRUE(scene_of(GetParam()).clay); }

/// 150 mm/s is the speed of a hand without support; a potter presses at 20 to 60 mm/s, and the
/// tremor of 0.05 mm at 9 Hz adds up to three times 2.8 mm/s on each axis.
TEST_P(Sample, HasTheSpeedOfAHand) {
  const Played& play = played(GetParam());
  EXPECT_LE(play.fastest_press_mm_s, 60.0 + 15.0);
  EXPECT_GE(play.poses.back().time_us, 30'000'000);
  EXPECT_LE(play.poses.back().time_us, 150'000'000);
  EXPECT_LE(session_text(GetParam()).size(), 600'000u);
}

INSTANTIATE_TEST_SUITE_P(All, Sample,
                         testing::Values("bowl", "vase", "bottle", "cylinder", "collapse"),
                         [](const auto& sample) { return std::string(sample.param); });

class StandingPot : public testing::TestWithParam<const char*> {};

TEST_P(StandingPot, IsSound) {
  const Played& play = played(GetParam());
  const ClayStack& stack = play.wheel.stack();
  EXPECT_FALSE(play.wheel.collapsed());
  EXPECT_EQ(play.flags & (kRefused | kLongStep | kRingLimit), 0u);
  EXPECT_EQ(play.wheel.ledger().imbalance(stack.recount()), 0);
  const bench::PotMeasures pot = bench::measure(stack);
  EXPECT_EQ(pot.cavities, 0);
  EXPECT_LT(pot.ledge_mm, 2.0) << "at " << pot.ledge_up_mm;
  EXPECT_LT(pot.roughness_um, 150.0);
  EXPECT_GT(stack.rings().back().inner_mm(), 8.0);  // open
}

TEST_P(StandingPot, HasEvenWallsAFloorAndARoundedLip) {
  const ClayStack& stack = played(GetParam()).wheel.stack();
  const double floor_mm = static_cast<double>(floor_rings(stack)) * stack.ring_height_mm();
  EXPECT_GE(floor_mm, 5.0);
  EXPECT_LE(floor_mm, 8.0);
  // Above the fillet of the floor, which has the radius of the tool, and below the lip.
  const double corner_mm = floor_mm + 12.0, lip_mm = stack.height_mm() - 5.0;
  double sum = 0.0, squares = 0.0;
  const auto rings = between(stack, corner_mm, lip_mm);
  for (const Ring& ring : rings) {
    const double wall_mm = ring.outer_mm() - ring.inner_mm();
    ASSERT_GE(wall_mm, 4.0);
    ASSERT_LE(wall_mm, 8.0);
    sum += wall_mm;
    squares += wall_mm * wall_mm;
  }
  const double mean_mm = sum / static_cast<double>(rings.size());
  EXPECT_LE(std::sqrt(squares / static_cast<double>(rings.size()) - mean_mm * mean_mm),
            0.15 * mean_mm);
  // A lip that was rounded from both sides is at the top no thicker than two thirds of the wall.
  const Ring& top = stack.rings().back();
  const Ring below = between(stack, lip_mm - 1.0, lip_mm).back();
  EXPECT_LE(top.outer_mm() - top.inner_mm(), 0.67 * (below.outer_mm() - below.inner_mm()));
}

TEST_P(StandingPot, HasATrimmedFoot) {
  const Played& play = played(GetParam());
  EXPECT_GT(play.wheel.ledger().trimmed, 0);
  // The foot is bevelled: in its lowest 12 mm no ring is more than 0.2 mm narrower than the ring
  // below.
  const auto foot = between(play.wheel.stack(), 0.0, 12.0);
  for (std::size_t i = 1; i < foot.size(); ++i)
    EXPECT_GE(foot[i].outer_mm(), foot[i - 1].outer_mm() - 0.2) << i;
  EXPECT_GE(foot.back().outer_mm(), foot.front().outer_mm() + 1.0);
}

INSTANTIATE_TEST_SUITE_P(All, StandingPot, testing::Values("bowl", "vase", "bottle", "cylinder"),
                         [](const auto& sample) { return std::string(sample.param); });

TEST(Bowl, IsWideAndOpensAllTheWayUp) {
  const ClayStack& stack = played("bowl").wheel.stack();
  EXPECT_GT(widest_mm(stack.rings()), 1.6 * stack.height_mm());
  const double lip_mm = stack.height_mm() - 6.0;
  for (double up = 12.0; up + 5.0 < lip_mm; up += 5.0)
    EXPECT_GT(widest_mm(between(stack, up + 4.0, up + 5.0)),
              widest_mm(between(stack, up, up + 1.0)));
}

TEST(Vase, HasABellyANeckAndAFlaredRim) {
  const ClayStack& stack = played("vase").wheel.stack();
  const double height = stack.height_mm();
  const double belly = widest_mm(between(stack, 0.3 * height, 0.7 * height));
  const double neck = narrowest_mm(between(stack, 0.8 * height, height - 5.0));
  EXPECT_GT(belly, 1.8 * neck);
  EXPECT_GT(belly, 1.3 * widest_mm(between(stack, 0.0, 5.0)));
  EXPECT_GT(widest_mm(between(stack, height - 8.0, height)), 1.08 * neck);
}

TEST(Bottle, HasANeckNarrowerThanHalfItsBelly) {
  const ClayStack& stack = played("bottle").wheel.stack();
  const double height = stack.height_mm();
  EXPECT_LT(widest_mm(between(stack, 0.9 * height, height)), 33.0);
  EXPECT_LT(widest_mm(between(stack, 0.9 * height, height)),
            0.5 * widest_mm(between(stack, 0.0, 0.5 * height)));
}

TEST(Cylinder, IsStraightAndAsThickAsTheGap) {
  const ClayStack& stack = played("cylinder").wheel.stack();
  EXPECT_GT(stack.height_mm(), 1.6 * widest_mm(stack.rings()));
  // The last pull: 5.5 mm at the wheel, 4.5 mm at the rim.
  const double height = stack.height_mm(), low = 25.0, high = height - 5.0;
  EXPECT_LT(widest_mm(between(stack, low, high)) - narrowest_mm(between(stack, low, high)), 4.0);
  for (double up = low; up < high; up += 1.0) {
    const Ring& ring = between(stack, up, up + 1.0).front();
    const double gap_mm = 5.5 - up / height;
    EXPECT_NEAR(ring.outer_mm() - ring.inner_mm(), gap_mm, 0.1 * gap_mm) << up;
  }
}

TEST(FallingPot, FailsAtItsWaistLateInTheSession) {
  const Played& play = played("collapse");
  const Pot pot = play.wheel.pot();
  ASSERT_TRUE(pot.collapse);
  EXPECT_GT(3 * play.standing, 2 * play.poses.size());
  EXPECT_GT(pot.collapse->angle_rad, 0.5);
  EXPECT_GT(pot.collapse->stress_kpa, scene_of("collapse").stability->max_stress_kpa);
  EXPECT_GT(3 * pot.collapse->failed_ring, pot.stack.size());
  EXPECT_LT(3 * pot.collapse->failed_ring, 2 * pot.stack.size());
  EXPECT_EQ(pot.ledger.imbalance(pot.stack.volume()), 0);
}

}  // namespace
}  // namespace clay::samples
