// The properties of the samples of the paper's rules (samples/paper): sessions that match their
// scripts, and usable pots.

#include "app/strokes/strokes.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"
#include "tests/samples/sample_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace clay::samples::paper {
namespace {

using strokes::parse_strokes;
using strokes::play;

const std::string kFolder = CLAYSTACK_SAMPLES "/paper/";

SceneSpec scene_of(const std::string& sample) {
  return parse_file(kFolder + sample + ".scene.json", parse_scene);
}

std::vector<Pose> poses_of(const std::string& sample) {
  const SceneSpec scene = scene_of(sample);
  return play(parse_file(kFolder + "strokes/" + sample + ".strokes.json", parse_strokes), scene,
              Wheel::build(scene).value())
      .value()
      .poses;
}

/// A session after replay.
struct Played {
  Wheel wheel;
  std::size_t poses = 0;
  std::size_t standing = 0;  ///< poses before the collapse
  std::uint32_t flags = 0;   ///< flags of all ticks
};

Played played(const std::string& sample, Model model) {
  SceneSpec scene = scene_of(sample);
  scene.model = model;
  const auto poses = poses_of(sample);
  Played result{Wheel::build(scene).value(), poses.size()};
  for (const Pose& pose : poses) {
    result.flags |= result.wheel.step(pose).flags;
    if (!result.wheel.collapsed()) ++result.standing;
  }
  return result;
}

double floor_mm(const ClayStack& stack) {
  const auto bored =
      std::ranges::find_if(stack.rings(), [](const Ring& ring) { return ring.inner2 > 0; });
  return static_cast<double>(bored - stack.rings().begin()) * stack.ring_height_mm();
}

class PaperSample : public testing::TestWithParam<const char*> {};

TEST_P(PaperSample, SessionMatchesItsScript) {
  const std::string sample = GetParam();
  const SceneSpec scene = scene_of(sample);
  const auto session = read_file(kFolder + sample + ".session");
  ASSERT_TRUE(session) << session.error().message;
  // Not EXPECT_EQ, which would print a megabyte.
  EXPECT_TRUE(*session == write_session({scene.name, hash_of(scene), poses_of(sample), false}));
}

TEST_P(PaperSample, LastsTenToFortySeconds) {
  const auto poses = poses_of(GetParam());
  EXPECT_GE(poses.back().time_us, 10'000'000);
  EXPECT_LE(poses.back().time_us, 40'000'000);
}

INSTANTIATE_TEST_SUITE_P(All, PaperSample,
                         testing::Values("bowl", "vase", "bottle", "cylinder", "collapse"),
                         [](const auto& sample) { return std::string(sample.param); });

class StandingPaperPot : public testing::TestWithParam<std::tuple<const char*, Model>> {};

TEST_P(StandingPaperPot, IsSound) {
  const auto [sample, model] = GetParam();
  const Played play = played(sample, model);
  const ClayStack& stack = play.wheel.stack();
  EXPECT_FALSE(play.wheel.collapsed());
  EXPECT_EQ(play.flags & (kRefused | kLongStep | kRingLimit), 0u);
  EXPECT_EQ(play.wheel.ledger().imbalance(stack.volume()), 0);
  EXPECT_GE(floor_mm(stack), 5.0);
  EXPECT_LE(floor_mm(stack), 8.0);
  // Open at the top, and at least half as tall again as its lump.
  EXPECT_GT(stack.rings().back().inner_mm(), 8.0);
  EXPECT_GT(stack.size(), 300u);
}

INSTANTIATE_TEST_SUITE_P(All, StandingPaperPot,
                         testing::Combine(testing::Values("bowl", "vase", "bottle", "cylinder"),
                                          testing::Values(Model::conserving, Model::paper)),
                         [](const auto& pot) {
                           return std::get<0>(pot.param) +
                                  std::string(std::get<1>(pot.param) == Model::paper ? "_paper"
                                                                                     : "");
                         });

TEST(PaperVase, FootIsTrimmed) {
  EXPECT_GT(played("vase", Model::conserving).wheel.ledger().trimmed, 0);
}

TEST(PaperBottle, HasANeckNarrowerThanHalfItsBelly) {
  const Played play = played("bottle", Model::conserving);
  const auto rings = play.wheel.stack().rings();
  const auto widest = [](std::span<const Ring> part) {
    return std::ranges::max(part, {}, &Ring::outer2).outer_mm();
  };
  const auto neck = rings.last(rings.size() / 8);
  EXPECT_LT(widest(neck), 0.55 * widest(rings.first(rings.size() / 2)));
}

class PaperCylinder : public testing::TestWithParam<Model> {};

TEST_P(PaperCylinder, WallEqualsTheGapFromFloorToRim) {
  const Played play = played("cylinder", GetParam());
  const ClayStack& stack = play.wheel.stack();
  const ToolSpec tool = scene_of("cylinder").tool;
  EXPECT_GE(stack.height_mm(), 200.0);
  // Below, the inner tool is in the corner of the floor; the rim is included.
  const double pulled_mm = floor_mm(stack) + std::get<SphereSpec>(tool.shape).radius_mm;
  const auto rings = stack.rings().subspan(
      static_cast<std::size_t>(std::ceil(pulled_mm / stack.ring_height_mm())));
  EXPECT_GT(static_cast<double>(rings.size()) * stack.ring_height_mm(), 185.0);
  for (const Ring& ring : rings) {
    const double wall_mm = ring.outer_mm() - ring.inner_mm();
    ASSERT_NEAR(wall_mm, *tool.gap_mm, 0.1 * *tool.gap_mm) << &ring - rings.data();
    ASSERT_NEAR(ring.outer_mm(), 42.0, 0.25);  // a cylinder
  }
}

INSTANTIATE_TEST_SUITE_P(Models, PaperCylinder, testing::Values(Model::conserving, Model::paper),
                         [](const auto& model) {
                           return model.param == Model::paper ? "paper" : "conserving";
                         });

/// A pot of at least 200 rings, as in the paper, thrown from fewer and higher ones.
Pot pot_of_200_rings(const std::string& sample) {
  SceneSpec scene = scene_of(sample);
  const double height_mm = scene.lump.ring_height_mm * static_cast<double>(scene.lump.rings);
  const auto poses = poses_of(sample);
  for (std::size_t rings = 30;; ++rings) {
    scene.lump.rings = rings;
    scene.lump.ring_height_mm = height_mm / static_cast<double>(rings);
    Wheel wheel = Wheel::build(scene).value();
    for (const Pose& pose : poses) wheel.step(pose);
    if (wheel.stack().size() >= 200) return wheel.pot();
  }
}

class PotSize : public testing::TestWithParam<const char*> {};

TEST_P(PotSize, TwoHundredRingsFitIntoFourKilobytesAndRoundedIntoOne) {
  Pot pot = pot_of_200_rings(GetParam());
  ASSERT_LT(pot.stack.size(), 210u);
  pot.thrown_with.reset();  // some 400 bytes for any number of rings
  const auto exact = write_pot(pot, PotEncoding::cbor).size();
  const auto rounded = write_pot(rounded_pot(pot, 0.001).value(), PotEncoding::cbor).size();
  RecordProperty("rings", static_cast<int>(pot.stack.size()));
  RecordProperty("exact_bytes", static_cast<int>(exact));
  RecordProperty("rounded_bytes", static_cast<int>(rounded));
  EXPECT_LE(exact, 4000u);
  EXPECT_LE(rounded, 1000u);
}

TEST_P(PotSize, OfTheThrownPotStaysInProportion) {
  const Pot pot = played(GetParam(), Model::conserving).wheel.pot();
  const auto exact = write_pot(pot, PotEncoding::cbor).size();
  const auto rounded = write_pot(rounded_pot(pot, 0.001).value(), PotEncoding::cbor).size();
  EXPECT_LE(200 * exact, 4000 * pot.stack.size());
  EXPECT_LE(200 * rounded, 1000 * pot.stack.size());
}

INSTANTIATE_TEST_SUITE_P(All, PotSize, testing::Values("bowl", "vase", "bottle", "cylinder"),
                         [](const auto& sample) { return std::string(sample.param); });

class FallingPaperPot : public testing::TestWithParam<Model> {};

TEST_P(FallingPaperPot, FailsAtItsWaistLateInTheSession) {
  const Played play = played("collapse", GetParam());
  const Pot pot = play.wheel.pot();
  ASSERT_TRUE(pot.collapse);
  EXPECT_GT(3 * play.standing, 2 * play.poses);
  EXPECT_GT(pot.collapse->angle_rad, 0.5);
  EXPECT_GT(pot.collapse->stress_kpa, scene_of("collapse").stability->max_stress_kpa);
  EXPECT_GT(3 * pot.collapse->failed_ring, pot.stack.size());
  EXPECT_LT(3 * pot.collapse->failed_ring, 2 * pot.stack.size());
  EXPECT_EQ(pot.ledger.imbalance(pot.stack.volume()), 0);
}

INSTANTIATE_TEST_SUITE_P(Models, FallingPaperPot, testing::Values(Model::conserving, Model::paper),
                         [](const auto& model) {
                           return model.param == Model::paper ? "paper" : "conserving";
                         });

}  // namespace
}  // namespace clay::samples::paper
