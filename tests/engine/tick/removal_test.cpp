#include "engine/tick/removal.hpp"

#include "tests/engine/clay/stack_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace clay {
namespace {

constexpr RemovalPlan kRemovalPlan{
    .rate_per_s = 20.0, .yield_depth_mm = 0.25, .min_wall_mm = 1.0, .paper_fraction = 0.02};

Contact deep_contact(const ClayStack& stack, Side side, double depth_mm) {
  Contact contact;
  contact.side = side;
  contact.top = stack.size() - 1;
  contact.rings.lay_out(0, stack.size());
  for (std::size_t i = 0; i < stack.size(); ++i) {
    const Ring& ring = stack.rings()[i];
    const double surface = side == Side::compressive ? ring.outer_mm() : ring.inner_mm();
    contact.rings.put({.ring = i, .depth_mm = depth_mm, .surface_mm = surface});
  }
  contact.rings.trim();
  return contact;
}

template <Model model>
double removed_mm2(const ClayStack& stack, Side side, double depth_mm, double dt_s,
                   const RemovalPlan& plan = kRemovalPlan) {
  std::vector<Quanta> removed;
  Contact contact = deep_contact(stack, side, depth_mm);
  compute_removal<model>(plan, stack, dt_s, contact, removed);
  return mm2_from_quanta(removed.at(0));
}

ClayStack cup(double outer, double inner) {
  return ClayStack::cylinder(1, 1.0, outer, inner, 1).value();
}

TEST(Removal, PaperRemovesAFractionOfTheWall) {
  const double eps = 0.02 * (50.0 - 40.0);  // equation (3): k (R - r)
  EXPECT_NEAR(removed_mm2<Model::paper>(cup(50, 40), Side::compressive, 3, 0.001),
              eps * (2 * 50 - eps), 1e-9);
  EXPECT_NEAR(removed_mm2<Model::paper>(cup(50, 40), Side::expansive, 3, 0.001),
              eps * (2 * 40 + eps), 1e-9);
}

TEST(Removal, ConservingFollowsTheExponential) {
  const double eps = 10.0 * -std::expm1(-20.0 * 0.004);
  EXPECT_NEAR(removed_mm2<Model::conserving>(cup(50, 40), Side::compressive, 3, 0.004),
              eps * (100 - eps), 1e-9);
  EXPECT_NEAR(removed_mm2<Model::conserving>(cup(50, 40), Side::expansive, 3, 0.004),
              eps * (80 + eps), 1e-9);
}

TEST(Removal, TwoHalfStepsEqualOneStep) {
  const ClayStack whole = cup(50, 30);
  const double first = removed_mm2<Model::conserving>(whole, Side::compressive, 30, 0.01);
  const double outer = std::sqrt(2500.0 - first);
  const double second = removed_mm2<Model::conserving>(cup(outer, 30), Side::compressive, 30, 0.01);
  EXPECT_NEAR(first + second, removed_mm2<Model::conserving>(whole, Side::compressive, 30, 0.02),
              1e-8);
}

TEST(Removal, PassesTheRemainingDepthToTheForce) {
  const ClayStack stack = cup(50, 40);
  for (const Side side : {Side::compressive, Side::expansive}) {
    Contact contact = deep_contact(stack, side, 3.0);
    std::vector<Quanta> removed;
    compute_removal<Model::conserving>(kRemovalPlan, stack, 0.004, contact, removed);
    EXPECT_NEAR(contact.rings.get(0).depth_mm, 3.0 + 10.0 * std::expm1(-20.0 * 0.004), 1e-12);
  }
}

TEST(Removal, StopsAtTheToolAndAtTheMinimumWall) {
  // Fast clay: the exponential alone would remove the whole wall.
  const RemovalPlan fast{
      .rate_per_s = 1e6, .yield_depth_mm = 0.25, .min_wall_mm = 1.0, .paper_fraction = 0.0};
  const auto r = [&](double mm2) { return std::sqrt(2500.0 - mm2); };
  EXPECT_NEAR(r(removed_mm2<Model::conserving>(cup(50, 40), Side::compressive, 3, 1, fast)), 47.0,
              1e-9);
  EXPECT_NEAR(r(removed_mm2<Model::conserving>(cup(50, 40), Side::compressive, 30, 1, fast)), 41.0,
              1e-9);
  EXPECT_EQ(removed_mm2<Model::conserving>(cup(50, 49.5), Side::compressive, 30, 1, fast), 0.0);
  EXPECT_EQ(removed_mm2<Model::conserving>(cup(50, 40), Side::compressive, 3, 0.0, fast), 0.0);
}

RC_GTEST_PROP(Removal, NeverEmptiesARing, ()) {
  auto random = *samples::random_engine();
  const ClayStack stack = samples::stack(random, 20);
  const RemovalPlan plan{.rate_per_s = 1e6,
                         .yield_depth_mm = *rc::gen::element(1e-3, 0.25, 1e3),
                         .min_wall_mm = 0.001,
                         .paper_fraction = 1.0 - 1e-9};
  for (const Side side : {Side::compressive, Side::expansive}) {
    Contact contact = deep_contact(stack, side, 1e6);
    std::vector<Quanta> removed;
    const auto check = [&] {
      for (std::size_t i = 0; i < removed.size(); ++i) {
        RC_ASSERT(removed[i] >= 0);
        RC_ASSERT(removed[i] < stack.rings()[i].volume());
      }
    };
    compute_removal<Model::paper>(plan, stack, 1.0, contact, removed);
    check();
    compute_removal<Model::conserving>(plan, stack, 1.0, contact, removed);
    check();
  }
}

}  // namespace
}  // namespace clay
