#include "engine/tick/joints.hpp"

#include "engine/clay/lanes.hpp"
#include "engine/tick/contact.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace clay {
namespace {

Ring ring_of(double outer_mm, double inner_mm) {
  return {quanta_from_radius(outer_mm), quanta_from_radius(inner_mm)};
}

double overlap_mm(const Ring& a, const Ring& b) {
  return std::min(a.outer_mm(), b.outer_mm()) - std::max(a.inner_mm(), b.inner_mm());
}
double least_overlap_mm(std::span<const Ring> rings) {
  double least = 1e300;
  for (std::size_t i = 1; i < rings.size(); ++i)
    least = std::min(least, overlap_mm(rings[i - 1], rings[i]));
  return least;
}

ClayStack stack_of(std::vector<Ring> rings, WideQuanta crown = 0) {
  return ClayStack::from_rings(0.5, std::move(rings), crown).value();
}

/// A shoulder that leans inward by `step_mm` from ring to ring, with a wall of 3 mm.
std::vector<Ring> shoulder(std::size_t count, double step_mm) {
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < count; ++i) {
    const double outer = 60.0 - step_mm * static_cast<double>(i);
    rings.push_back(ring_of(outer, outer - 3.0));
  }
  return rings;
}

/// A shoulder whose sixth ring a press has moved by nearly 2 mm at constant volume.
std::vector<Ring> pressed_shoulder(bool outward) {
  std::vector<Ring> rings = shoulder(12, 1.5);
  const Quanta by = outward ? quanta_from_mm2(230.0) : -quanta_from_mm2(230.0);
  rings[5].outer2 += by;
  rings[5].inner2 += by;
  return rings;
}

/// Every ring keeps its volume, and none has moved against the press.
void expect_followed(const ClayStack& stack, const std::vector<Ring>& before, bool outward) {
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Ring& ring = stack.rings()[i];
    EXPECT_EQ(ring.volume(), before[i].volume()) << i;
    EXPECT_GE(outward ? ring.outer2 - before[i].outer2 : before[i].outer2 - ring.outer2, 0) << i;
  }
}

void join(ClayStack& stack, std::size_t first, std::size_t last, const Following& following) {
  StackWriter writer(stack);
  join_rings(stack, first, last, following, writer);
}

RC_GTEST_PROP(Joints, WeakJointsAreFoundInAnyPlaceAndWithAnyLanes, ()) {
  const auto count = *rc::gen::inRange<std::size_t>(2, 40);
  std::vector<Ring> rings(count, ring_of(50.0, 45.0));
  const auto at = *rc::gen::inRange<std::size_t>(0, count);
  const double outer = 1e-3 * *rc::gen::inRange(40000, 57000);
  rings[at] = ring_of(outer, outer - 5.0);
  const double least = least_overlap_mm(rings);
  for (const bool two : {false, true}) {
    const TwoLanesScope lanes(two);
    if (least < 0.999) {
      RC_ASSERT(has_weak_joint(rings, 1.0));
    }
    if (least > 2.001) {
      RC_ASSERT(!has_weak_joint(rings, 1.0));
    }
    RC_ASSERT(lowest_gap(rings, 0, count - 1).has_value() == (least <= 0.0));
  }
  RC_CLASSIFY(least <= 0.0, "gap");
}

TEST(Joints, RingsThatTouchInACircleAloneDoNotOverlap) {
  const std::vector<Ring> rings{ring_of(50.0, 45.0), ring_of(45.0, 40.0), ring_of(44.0, 39.0)};
  EXPECT_EQ(lowest_gap(rings, 0, 2), 0u);
  EXPECT_FALSE(lowest_gap(rings, 1, 2));
  const std::vector<Ring> widening{rings[1], rings[0]};
  EXPECT_EQ(lowest_gap(widening, 0, 1), 0u);
  EXPECT_FALSE(has_weak_joint(std::span(rings).first(1), 1.0));
}

/// The third ring lies within the bore of the second one, 1 mm from it.
const std::vector<Ring> kParted{ring_of(52.0, 46.0), ring_of(50.0, 45.0), ring_of(44.0, 40.0),
                                ring_of(42.0, 38.0)};

/// Two spheres of 5 mm radius between the second and the third ring, `gap_mm` apart.
struct TwoSpheres {
  Tool tool = Tool::build(SphereSpec{5.0}).value();
  std::array<ToolRemoval, 2> removals;
  TwoSpheres(double middle_mm, double gap_mm) {
    removals[0].contact.side = Side::compressive;
    removals[0].contact.axis_distance_mm = middle_mm + 0.5 * gap_mm + 5.0;
    removals[1].contact.side = Side::expansive;
    removals[1].contact.axis_distance_mm = middle_mm - 0.5 * gap_mm - 5.0;
  }
  [[nodiscard]] Hands hands() const { return {tool, 1.0, removals}; }
};

void thicken(ClayStack& stack, std::size_t first, std::size_t last, const TwoSpheres& spheres) {
  StackWriter writer(stack);
  thicken_joints(stack, first, last, 0.75, spheres.hands(), writer);
}

TEST(Joints, BetweenTwoToolsTheUpperRingBecomesThicker) {
  ClayStack stack = stack_of(kParted, quanta_from_mm2(500.0));
  const WideQuanta volume = stack.volume();
  thicken(stack, 0, 3, TwoSpheres(45.0, 20.0));
  EXPECT_NEAR(stack.rings()[2].outer_mm(), 45.75, 1e-6);
  EXPECT_EQ(stack.rings()[2].inner2, kParted[2].inner2);
  for (const std::size_t i : {0u, 1u, 3u}) EXPECT_EQ(stack.rings()[i], kParted[i]) << i;
  EXPECT_EQ(stack.volume(), volume);
  EXPECT_EQ(stack.recount(), volume);
}

TEST(Joints, TheLowerRingBecomesThickerWhereTheUpperOneWouldEnterATool) {
  ClayStack stack = stack_of(kParted, quanta_from_mm2(500.0));
  thicken(stack, 0, 3, TwoSpheres(39.0, 10.0));
  EXPECT_EQ(stack.rings()[2], kParted[2]);
  EXPECT_NEAR(stack.rings()[1].inner_mm(), 43.25, 1e-6);
  EXPECT_EQ(stack.rings()[1].outer2, kParted[1].outer2);
}

/// The outer tool is in the way of the upper ring, the inner one in that of the lower ring.
TEST(Joints, NoRingBecomesThickerIntoATool) {
  ClayStack stack = stack_of(kParted, quanta_from_mm2(500.0));
  thicken(stack, 0, 3, TwoSpheres(44.5, 0.5));
  EXPECT_EQ(stack, stack_of(kParted, quanta_from_mm2(500.0)));
}

/// Ribs that cover 0.15 mm of each of the two rings, whose middles are beyond the ends of the ribs.
TEST(Joints, NoRingBecomesThickerIntoTheEndOfATool) {
  ClayStack stack = stack_of(kParted, quanta_from_mm2(500.0));
  TwoSpheres ribs(44.5, 0.5);
  ribs.tool = Tool::build(RibSpec{0.3, 5.0}).value();
  thicken(stack, 0, 3, ribs);
  EXPECT_EQ(stack, stack_of(kParted, quanta_from_mm2(500.0)));
}

TEST(Joints, NoRingBeyondTheFlowBecomesThicker) {
  ClayStack stack = stack_of(kParted, quanta_from_mm2(500.0));
  thicken(stack, 3, 3, TwoSpheres(45.0, 20.0));
  EXPECT_EQ(stack, stack_of(kParted, quanta_from_mm2(500.0)));
  thicken(stack, 0, 1, TwoSpheres(45.0, 20.0));
  EXPECT_NEAR(stack.rings()[1].inner_mm(), 43.25, 1e-6);
  EXPECT_EQ(stack.rings()[2], kParted[2]);
}

TEST(Joints, RingsFollowOutwardAtConstantVolume) {
  const std::vector<Ring> rings = pressed_shoulder(true);
  ASSERT_LT(overlap_mm(rings[5], rings[6]), 0.0);
  ClayStack stack = stack_of(rings);
  join(stack, 1, 10, {.outward = true, .least_mm = 0.75, .min_wall_mm = 0.5});
  expect_followed(stack, rings, true);
  EXPECT_NEAR(overlap_mm(stack.rings()[5], stack.rings()[6]), 0.75, 1e-6);
  EXPECT_GT(least_overlap_mm(stack.rings()), 0.75 - 1e-6);
  EXPECT_EQ(stack.rings()[0], rings[0]);
  EXPECT_EQ(stack.rings()[11], rings[11]);
}

TEST(Joints, RingsFollowInwardFromAboveAndFromBelow) {
  const std::vector<Ring> rings = pressed_shoulder(false);
  ASSERT_LT(overlap_mm(rings[4], rings[5]), 0.75);
  ClayStack stack = stack_of(rings);
  join(stack, 1, 10, {.outward = false, .least_mm = 0.75, .min_wall_mm = 0.5});
  expect_followed(stack, rings, false);
  EXPECT_LT(stack.rings()[4].outer2, rings[4].outer2);
  EXPECT_NEAR(overlap_mm(stack.rings()[4], stack.rings()[5]), 0.75, 1e-6);
}

/// A wider ring of the same volume is thinner.
TEST(Joints, ARingAtTheMinimumKeepsItsThicknessWithClayFromTheCrown) {
  const std::vector<Ring> rings = pressed_shoulder(true);
  ClayStack stack = stack_of(rings, quanta_from_mm2(100.0));
  const WideQuanta volume = stack.volume();
  join(stack, 1, 10, {.outward = true, .least_mm = 0.75, .min_wall_mm = 3.0});
  EXPECT_GT(stack.rings()[6].outer2, rings[6].outer2);
  EXPECT_NEAR(wall_mm(stack.rings()[6]), 3.0, 1e-9);
  EXPECT_LT(stack.crown(), quanta_from_mm2(100.0));
  EXPECT_EQ(stack.volume(), volume);
  EXPECT_EQ(stack.recount(), volume);
}

/// It needs 9 mm^2 more, and no ring above it has any.
TEST(Joints, ARingWithoutClayToStretchStays) {
  std::vector<Ring> rings = shoulder(2, 1.5);
  rings[0].outer2 += quanta_from_mm2(230.0);
  rings[0].inner2 += quanta_from_mm2(230.0);
  const Following following{.outward = true, .least_mm = 0.75, .min_wall_mm = 3.0};
  ClayStack stack = stack_of(rings, quanta_from_mm2(5.0));
  join(stack, 0, 1, following);
  EXPECT_EQ(stack, stack_of(rings, quanta_from_mm2(5.0)));
  stack = stack_of(rings, quanta_from_mm2(20.0));
  join(stack, 0, 1, following);
  EXPECT_GT(stack.rings()[1].outer2, rings[1].outer2);
  EXPECT_GT(stack.crown(), 0);
}

/// Half of the thinner wall is all that thin rings can share.
TEST(Joints, ThinWallsKeepHalfOfTheirThickness) {
  ClayStack stack = stack_of({ring_of(50.0, 49.0), ring_of(49.2, 48.2)});
  join(stack, 0, 1, {.outward = true, .least_mm = 0.75, .min_wall_mm = 0.1});
  EXPECT_NEAR(overlap_mm(stack.rings()[0], stack.rings()[1]), 0.5, 1e-6);
}

/// A bottom has no bore that could move: it becomes wider, and nothing draws it inward.
TEST(Joints, ASolidBottomBecomesWider) {
  const std::vector<Ring> rings{ring_of(40.0, 0.0), ring_of(43.0, 39.8)};
  ClayStack stack = stack_of(rings);
  join(stack, 0, 1, {.outward = true, .least_mm = 0.75, .min_wall_mm = 0.1});
  EXPECT_NEAR(stack.rings()[0].outer_mm(), 40.55, 1e-6);
  EXPECT_EQ(stack.rings()[0].inner2, 0);
  EXPECT_EQ(stack.rings()[1], rings[1]);
  EXPECT_EQ(stack.volume(), stack_of(rings).volume());
  stack = stack_of(rings);
  join(stack, 0, 1, {.outward = false, .least_mm = 0.75, .min_wall_mm = 0.1});
  EXPECT_EQ(stack.rings()[0], rings[0]);
}

}  // namespace
}  // namespace clay
