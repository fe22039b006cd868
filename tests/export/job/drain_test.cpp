#include "export/job/prepare.hpp"

#include "claystack/export/job.hpp"
#include "claystack/export/section.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace clay::solid {
namespace {

using shapes::stack_of;

TEST(Drain, OpensEveryCavityDownward) {
  // Solid foot, cavity, floor, cavity, lid: 2 mm rings.
  const ClayStack stack = stack_of(2.0, {{30, 0}, {30, 0}, {30, 20}, {30, 0}, {30, 20}, {30, 0}});
  const auto drained = drain(stack, 8.0);
  ASSERT_TRUE(drained) << drained.error().message;
  const StackProfile section = profile_of(drained->stack).value();
  EXPECT_TRUE(section.shapes[0].cavities.empty());
  EXPECT_EQ(section.shapes[0].topology, Topology::cup);
  // Three rings were solid below the upper cavity: three discs of 8 mm.
  EXPECT_NEAR(drained->drilled_mm3, 3 * 2.0 * std::numbers::pi * 16.0, 1e-6);
  EXPECT_EQ(drained->stack.rings()[5].inner2, 0);  // the lid stays
  EXPECT_EQ(drained->stack.rings()[2], stack.rings()[2]);
}

TEST(Drain, KeepsABoreFromBelow) {
  const ClayStack stack = stack_of(2.0, {{30, 25}, {30, 0}, {30, 20}, {30, 0}});
  const auto drained = drain(stack, 6.0);
  ASSERT_TRUE(drained);
  EXPECT_EQ(drained->stack.rings()[0], stack.rings()[0]);
  EXPECT_NEAR(drained->stack.rings()[1].inner_mm(), 3.0, 1e-9);
}

TEST(Drain, RefusesUnsupportedRequests) {
  const auto nothing = drain(stack_of(2.0, {{30, 0}, {30, 20}}), 5.0);
  ASSERT_FALSE(nothing);
  EXPECT_NE(nothing.error().message.find("closed cavity, found none"), std::string::npos);
  const auto wide = drain(stack_of(2.0, {{30, 0}, {9, 0}, {30, 8}, {30, 0}}), 18.0);
  ASSERT_FALSE(wide);
  EXPECT_NE(wide.error().message.find("ring 1"), std::string::npos);
}

TEST(Cavity, PrintsTheDigitsOfASmallVolume) {
  // A cavity of 0.5 mm radius between 0.25 and 0.5 mm: pi / 16 mm3.
  const StackProfile section = profile_of(stack_of(0.25, {{2, 0}, {2, 0.5}, {2, 0}})).value();
  EXPECT_EQ(text_of(section.shapes[0].cavities.at(0)),
            "closed cavity from 0.25 to 0.5 mm (0.0002 cm3): it needs a drain hole");
}

TEST(Parts, AreAbsentOrLargeEnoughForTheirFile) {
  const Pot pot = shapes::pot_of(stack_of(2.0, {{30, 0}, {30, 0}, {30, 24}, {30, 24}, {30, 24}}));
  const auto refusal = [&](const ExportOptions& options) {
    const auto report = run_export(pot, {}, options);
    return report ? std::string() : report.error().message;
  };
  ExportOptions options;
  options.finish.floor_fillet_mm = 1e-4;
  EXPECT_EQ(refusal(options), "floor fillet: expected 0, or 0.001 to 1000 mm, found 0.0001 mm");
  options = {};
  options.lip_fillet_mm = 1e-4;
  EXPECT_EQ(refusal(options), "lip fillet: expected 0, or 0.001 to 1000 mm, found 0.0001 mm");
  options = {};
  options.finish.glaze_mm = 0.0019;
  EXPECT_EQ(refusal(options), "glaze allowance: expected 0, or 0.002 to 10 mm, found 0.0019 mm");
  options.finish.glaze_mm = 0.002;
  EXPECT_EQ(refusal(options), "");
}

}  // namespace
}  // namespace clay::solid
