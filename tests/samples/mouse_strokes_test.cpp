// Strokes that a person drew with a mouse in the window (samples/mouse.work), thrown again.

#include "app/bench/hands/pot_measures.hpp"
#include "samples/replay/recorded_strokes.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

namespace clay::samples {
namespace {

const WorkRecord& mouse_work() {
  static const WorkRecord work = [] {
    const std::string path = CLAYSTACK_SAMPLES "/mouse.work";
    return read_file(path)
        .and_then([&](const std::string& text) { return parse_work(text, path); })
        .value()
        .work;
  }();
  return work;
}

TEST(MouseStrokes, CloseThePotWithoutTheRules) {
  const auto pots = thrown_again(mouse_work(), std::nullopt).value();
  ASSERT_GT(pots.size(), 5u);
  const bench::PotMeasures pot = bench::measure(pots[5].stack);
  EXPECT_EQ(pot.cavities, 1);
  EXPECT_GT(pot.width_mm, 400.0);
}

TEST(MouseStrokes, LeaveOpenPotsOfTheWidthAskedForWithTheRules) {
  const WorkRecord& work = mouse_work();
  const auto pots = thrown_again(work, ClaySpec{}).value();
  double asked_mm = 2.0 * work.scenes.front().lump.outer_radius_mm;
  for (const WorkNode& node : work.nodes)
    if (const auto* ball = std::get_if<SphereSpec>(&work.scenes[node.scene].tool.shape))
      for (const Pose& pose : node.poses)
        if (pose.position_mm.y < 150.0 && std::abs(pose.position_mm.x) < 60.0)
          asked_mm = std::max(asked_mm, 2.0 * (std::abs(pose.position_mm.x) + ball->radius_mm));
  for (std::size_t node = 0; node < pots.size(); ++node) {
    const bench::PotMeasures pot = bench::measure(pots[node].stack);
    EXPECT_EQ(pot.cavities, 0) << node;
    EXPECT_FALSE(pots[node].collapse) << node;
    EXPECT_EQ(pots[node].ledger.imbalance(pots[node].stack.recount()), 0) << node;
    EXPECT_LE(pot.width_mm, 1.3 * asked_mm) << node;
  }
}

/// No stroke leaves a step that a printer would have to bridge, and no cut does.
TEST(MouseStrokes, LeaveNoLedgesWithTheRules) {
  const WorkRecord& work = mouse_work();
  const auto pots = thrown_again(work, ClaySpec{}).value();
  int cut = 0;
  for (std::size_t node = 1; node < pots.size(); ++node) {
    cut += cuts(work, node) ? 1 : 0;
    EXPECT_LT(bench::measure(pots[node].stack).ledge_mm, 2.0) << node;
  }
  EXPECT_GE(cut, 2);
}

/// A press moves the wall, and the bore stays as smooth as the hand is steady.
TEST(MouseStrokes, LeaveSmoothWallsWithTheRules) {
  const auto pots = thrown_again(mouse_work(), ClaySpec{}).value();
  for (std::size_t node = 7; node < pots.size(); ++node)  // before, the pot is being opened
    EXPECT_LT(bench::measure(pots[node].stack).roughness_um, 85.0) << node;
}

TEST(MouseStrokes, DoNotDependOnTheRingHeight) {
  const WorkRecord& work = mouse_work();
  const auto pots = thrown_again(work, ClaySpec{}).value();
  const auto fine = thrown_again(work, ClaySpec{}, 2).value();
  for (std::size_t node = 1; node < pots.size(); ++node)
    EXPECT_LT(mean_difference_mm(pots[node].stack, fine[node].stack), 0.1) << node;
}

}  // namespace
}  // namespace clay::samples
