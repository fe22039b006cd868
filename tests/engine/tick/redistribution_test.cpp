#include "engine/tick/redistribution.hpp"

#include "engine/clay/stack_writer.hpp"
#include "tests/engine/clay/stack_samples.hpp"
#include "tests/engine/wheel/flow_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay {
namespace {

using samples::contact_on;
using samples::plan_of;

double outer2(const ClayStack& stack, std::size_t i) {
  return mm2_from_quanta(stack.rings()[i].outer2);
}
double inner2(const ClayStack& stack, std::size_t i) {
  return mm2_from_quanta(stack.rings()[i].inner2);
}

/// P_d(j) of the paper, in floating point.
std::vector<double> weights(double sigma, double h, std::size_t length) {
  std::vector<double> w;
  double sum = 0.0;
  for (std::size_t k = 1; k <= length; ++k) {
    const double x = h * static_cast<double>(k);
    w.push_back(x * std::exp(-x * x / (2 * sigma * sigma)));
    sum += w.back();
  }
  for (double& v : w) v /= sum;
  return w;
}

/// press_clay() with one tool.
template <Model model>
Flow press_one(const StepPlan& plan, const Contact& contact, std::vector<Quanta> removed,
               bool upward, ClayStack& stack, Ledger& ledger) {
  const ToolRemoval removal{contact, std::move(removed)};
  return press_clay<model>(plan, {&removal, 1}, upward, stack, ledger);
}

constexpr Quanta kMm2 = Quanta{1} << 36;

class Upward : public testing::TestWithParam<bool> {};

TEST_P(Upward, FollowsEquationsFiveToEight) {
  const bool up = GetParam();
  ClayStack stack = ClayStack::cylinder(60, 1.0, 50.0, 40.0, 60).value();
  const StepPlan plan = plan_of(4.0, 12.0, 0.25);
  Ledger ledger;
  const auto flow = press_one<Model::conserving>(
      plan, contact_on(28, 30), {30 * kMm2, 40 * kMm2, 50 * kMm2}, up, stack, ledger);
  const auto w = weights(4.0, 1.0, 12);
  for (std::size_t j = 1; j <= 12; ++j) {
    const std::size_t ring = up ? 30 + j : 28 - j;
    EXPECT_NEAR(outer2(stack, ring), 2500 + w[j - 1] * 0.75 * 120, 1e-7);  // (5), (7)
    EXPECT_NEAR(inner2(stack, ring), 1600 - w[j - 1] * 0.25 * 120, 1e-7);  // (6), (8)
  }
  EXPECT_NEAR(outer2(stack, 29), 2500 - 40, 1e-9);
  EXPECT_EQ(outer2(stack, up ? 27 : 31), 2500);
  EXPECT_EQ(outer2(stack, up ? 43 : 15), 2500);
  // One ring more than the kernel, because the end of the tool may lie between rings.
  EXPECT_EQ(flow.lowest, up ? 28u : 15u);
  EXPECT_EQ(flow.highest, 43u);
}
INSTANTIATE_TEST_SUITE_P(Redistribution, Upward, testing::Bool());

TEST(Redistribution, KernelStartsAtTheEndsOfTheTool) {
  const auto w = weights(4.0, 1.0, 12);
  for (const double offset : {-0.5, -0.25, 0.25, 0.5}) {
    ClayStack stack = ClayStack::cylinder(60, 1.0, 50.0, 0.0, 60).value();
    Contact contact = contact_on(28, 30);
    contact.up_offset = offset;
    const ToolRemoval removal{contact, {0, 120 * kMm2, 0}};
    Ledger ledger;
    press_clay<Model::conserving>(plan_of(4.0, 12.0, 0.0), {&removal, 1}, true, stack, ledger);
    // The cumulated weights at x ring heights, linear between rings.
    const auto cumulated = [&](double x) {
      double sum = 0.0;
      for (std::size_t k = 0; k < w.size(); ++k)
        sum += w[k] * std::clamp(x - static_cast<double>(k), 0.0, 1.0);
      return sum;
    };
    for (std::size_t j = 1; j <= 13; ++j) {
      const double end = static_cast<double>(j) + offset;
      const double share = cumulated(end) - (j == 1 ? 0.0 : cumulated(end - 1.0));
      EXPECT_NEAR(outer2(stack, 30 + j), 2500 + 120 * share, 1e-3) << offset << " " << j;
    }
    EXPECT_TRUE(stack.crown() == 0);
  }
}

TEST(Redistribution, NewRingContinuesTheRim) {
  // Two rings above the tool and a kernel of three: the third share goes to the crown.
  std::vector<Ring> rings(10, {400 * kMm2, 225 * kMm2});
  rings[7].outer2 = 4000 * kMm2;  // enough clay for all removals
  ClayStack stack = ClayStack::from_rings(1.0, std::move(rings), 150 * kMm2, 40).value();
  Ledger ledger;
  Rim rim;
  const StepPlan plan = plan_of(4.0, 3.0, 0.25);
  const auto w = weights(4.0, 1.0, 3);
  const ToolRemoval removal{contact_on(7, 7), {20 * kMm2}};
  press_clay<Model::conserving>(plan, {&removal, 1}, true, stack, ledger, &rim);
  EXPECT_NEAR(mm2_from_quanta(rim.outside), 15 * (w[2] - w[1]), 1e-7);
  EXPECT_NEAR(mm2_from_quanta(rim.inside), 5 * (w[2] - w[1]), 1e-7);
  Flow flow;
  while (flow.grown == 0)
    flow = press_clay<Model::conserving>(plan, {&removal, 1}, true, stack, ledger, &rim);
  ASSERT_EQ(stack.size(), 11u);
  EXPECT_TRUE(rim.outside == 0 && rim.inside == 0);
  EXPECT_GT(outer2(stack, 10), outer2(stack, 9));  // it received three shares, the ring below two
  EXPECT_LT(inner2(stack, 10), inner2(stack, 9));
}

TEST(Redistribution, TouchingTheRimLevelsIt) {
  ClayStack stack = ClayStack::cylinder(10, 1.0, 10.0, 6.0, 40).value();
  Ledger ledger;
  Rim rim{kMm2, kMm2};
  const ToolRemoval removal{contact_on(9, 9), {kMm2}};
  press_clay<Model::conserving>(plan_of(4.0, 3.0, 0.25), {&removal, 1}, true, stack, ledger, &rim);
  EXPECT_TRUE(rim.outside == 0);
  EXPECT_TRUE(rim.inside == kMm2);
}

TEST(Redistribution, ExpansionWidensTheBore) {
  ClayStack stack = ClayStack::cylinder(10, 1.0, 50.0, 0.0, 10).value();
  Ledger ledger;
  press_one<Model::conserving>(plan_of(2.0, 3.0, 0.25), contact_on(5, 5, Side::expansive),
                               {9 * kMm2}, false, stack, ledger);
  EXPECT_EQ(stack.rings()[5].inner_mm(), 3.0);
  // The neighbours have no bore, so all clay goes outside.
  EXPECT_NEAR(outer2(stack, 4) + outer2(stack, 3) + outer2(stack, 2), 3 * 2500 + 9, 1e-9);
}

TEST(Redistribution, SendsTheExcessOfASmallBoreOutside) {
  const Ring wide{2500 * kMm2, 1600 * kMm2}, narrow{2500 * kMm2, 1 * kMm2};
  ClayStack stack = ClayStack::from_rings(1.0, {wide, narrow, wide}, 0, 3).value();
  Ledger ledger;
  // The reach is one ring: ring 1 receives 30 mm^2 inside but has room for 1 mm^2.
  press_one<Model::conserving>(plan_of(4.0, 1.0, 0.3), contact_on(0, 0), {100 * kMm2}, true, stack,
                               ledger);
  EXPECT_EQ(stack.rings()[1].inner2, 0);
  EXPECT_NEAR(outer2(stack, 1), 2500 + 99, 1e-9);
}

TEST(Redistribution, ExcessBelowFlowsUp) {
  ClayStack stack = ClayStack::cylinder(40, 1.0, 50.0, 0.0, 40).value();
  Ledger ledger;
  press_one<Model::conserving>(plan_of(4.0, 10.0, 0.25), contact_on(4, 6), {0, 100 * kMm2, 0},
                               false, stack, ledger);
  const auto w = weights(4.0, 1.0, 10);
  double below = 0.0;
  for (std::size_t j = 1; j <= 4; ++j) {
    EXPECT_NEAR(outer2(stack, 4 - j), 2500 + 100 * w[j - 1], 1e-7);
    below += w[j - 1];
  }
  for (std::size_t j = 1; j <= 10; ++j)
    EXPECT_NEAR(outer2(stack, 6 + j), 2500 + 100 * (1 - below) * w[j - 1], 1e-7);
}

TEST(Redistribution, ExcessAboveBecomesHeight) {
  ClayStack stack = ClayStack::cylinder(10, 1.0, 10.0, 0.0, 40).value();
  Ledger ledger;
  // There is no ring above the top: 40 of the 60 mm^2 of a ring go to the crown, twice.
  const auto press = [&] {
    return press_one<Model::conserving>(plan_of(4.0, 5.0, 0.25), contact_on(9, 9), {40 * kMm2},
                                        true, stack, ledger);
  };
  EXPECT_EQ(press().grown, 0u);
  EXPECT_NEAR(stack.crown_height_mm(), 40.0 / 60.0, 1e-12);
  EXPECT_EQ(press().grown, 4u);  // 80 mm^2 are four whole rings of 20
  EXPECT_EQ(stack.size(), 14u);
  EXPECT_TRUE(stack.crown() == 0);
  EXPECT_EQ(stack.rings()[13], stack.rings()[9]);
}

TEST(Redistribution, PaperKeepsTheRestOutsideTheBody) {
  ClayStack stack = ClayStack::cylinder(10, 1.0, 10.0, 0.0, 40).value();
  Ledger ledger;
  ledger.initial = stack.volume();
  press_one<Model::paper>(plan_of(4.0, 5.0, 0.25), contact_on(9, 9), {40 * kMm2}, true, stack,
                          ledger);
  EXPECT_TRUE(ledger.outside == 40 * kMm2);
  EXPECT_TRUE(stack.crown() == 0);
  EXPECT_TRUE(ledger.volume_error(stack.recount()) == -40 * kMm2);
  EXPECT_TRUE(ledger.imbalance(stack.recount()) == 0);
}

TEST(Redistribution, AtTheRingLimitClayStaysInTheCrown) {
  ClayStack stack = ClayStack::cylinder(10, 1.0, 10.0, 0.0, 10).value();
  Ledger ledger;
  const Flow flow = press_one<Model::conserving>(plan_of(4.0, 5.0, 0.25), contact_on(9, 9),
                                                 {80 * kMm2}, true, stack, ledger);
  EXPECT_TRUE(flow.ring_limit);
  EXPECT_EQ(stack.size(), 10u);
  EXPECT_TRUE(stack.crown() == 80 * kMm2);
}

TEST(Redistribution, CountsTrimmedClay) {
  ClayStack stack = ClayStack::cylinder(10, 1.0, 10.0, 0.0, 10).value();
  Ledger ledger;
  ledger.initial = stack.volume();
  const ToolRemoval removal{contact_on(4, 5), {10 * kMm2, 20 * kMm2}};
  trim_clay<Model::conserving>({&removal, 1}, stack, ledger);
  EXPECT_TRUE(ledger.trimmed == 30 * kMm2);
  EXPECT_TRUE(ledger.imbalance(stack.recount()) == 0);
  EXPECT_EQ(outer2(stack, 5), 80);
  EXPECT_EQ(outer2(stack, 6), 100);
}

RC_GTEST_PROP(Redistribution, ConservesVolume, ()) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(1, 40);
  ClayStack stack = samples::stack(random, count);
  const StepPlan plan =
      plan_of(*rc::gen::element(0.0, 1.0, 6.0, 1e9), *rc::gen::element(0.0, 1.0, 9.0, 100.0),
              *rc::gen::element(0.0, 0.27, 1.0));
  const auto bottom = *rc::gen::inRange<std::size_t>(0, count);
  const auto top = *rc::gen::inRange<std::size_t>(bottom, count);
  const Contact contact =
      contact_on(bottom, top, *rc::gen::element(Side::compressive, Side::expansive));
  std::vector<Quanta> removed;
  for (const RingContact& touch : samples::touched(contact))
    removed.push_back(static_cast<Quanta>(
        samples::uniform(random) * static_cast<double>(stack.rings()[touch.ring].volume() - 1)));
  Ledger ledger;
  ledger.initial = stack.volume();
  press_one<Model::conserving>(plan, contact, removed, *rc::gen::arbitrary<bool>(), stack, ledger);
  RC_ASSERT(ledger.imbalance(stack.recount()) == 0);
  RC_ASSERT(stack.recount() == stack.volume());
  for (const Ring& ring : stack.rings()) RC_ASSERT(ring.inner2 >= 0 && ring.outer2 > ring.inner2);
}

}  // namespace
}  // namespace clay
