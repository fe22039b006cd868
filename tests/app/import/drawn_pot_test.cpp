#include "app/import/drawn_pot.hpp"

#include "tests/app/import/solids.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace clay::importing {
namespace {

using testing::HasSubstr;

Result<Pot> pot_of(const std::string& csv, const DrawnPotSettings& settings = {}) {
  return section_of(csv, "pot.csv").and_then([&](HalfSection&& section) {
    return drawn_pot(section, settings, "pot.csv").map([](DrawnPot&& drawn) { return drawn.pot; });
  });
}

TEST(DrawnPot, EachRingHoldsItsSliceOfACone) {
  const auto pot = pot_of("40,0\n20,90\n", {0.75, {}, 1.9});
  ASSERT_TRUE(pot) << refusal_of(pot);
  ASSERT_EQ(pot->stack.size(), 120u);
  EXPECT_EQ(pot->stack.ring_height_mm(), 0.75);
  for (std::size_t i = 0; i < 120; ++i) {
    const double a = 40.0 - 20.0 * static_cast<double>(i) / 120.0, b = a - 20.0 / 120.0;
    EXPECT_NEAR(mm2_from_quanta(pot->stack.rings()[i].outer2), (a * a + a * b + b * b) / 3.0, 1e-9);
    EXPECT_EQ(pot->stack.rings()[i].inner2, 0);
  }
  EXPECT_EQ(pot->ledger.imbalance(pot->stack.volume()), 0);
}

TEST(DrawnPot, RingBoundsMeetAFloor) {
  // A floor at 3 of 10 mm: rings of at most 2 mm meet it when they are 1 mm high.
  const std::string cup = "0,0\n30,0\n30,10\n20,10\n20,3\n0,3\n";
  const auto pot = pot_of(cup, {2.0, {}, 1.9});
  ASSERT_TRUE(pot) << refusal_of(pot);
  ASSERT_EQ(pot->stack.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_EQ(pot->stack.rings()[i].inner2, i < 3 ? 0 : quanta_from_mm2(400.0)) << i;
  EXPECT_EQ(pot->stack.crown(), 0);
}

TEST(DrawnPot, FloorsOfAnyHeightAreLevel) {
  for (const double floor : {5.0, 6.0, 4.51, 3.14159, 7.77, 0.3}) {
    for (const double height : {60.0, 61.803, 172.0}) {
      const auto section = section_of(
          fmt::format("0,0\n30,0\n32,{0}\n28,{0}\n26,{1}\n0,{1}\n", height, floor), "pot.csv");
      ASSERT_TRUE(section) << refusal_of(section);
      const auto drawn = drawn_pot(*section, {}, "pot.csv");
      ASSERT_TRUE(drawn) << refusal_of(drawn);
      EXPECT_LE(drawn->deviation.mm, kDrawnDeviationMm) << floor << " of " << height;
      const ClayStack& stack = drawn->pot.stack;
      std::size_t solid = 0;
      while (stack.rings()[solid].inner2 == 0) ++solid;
      EXPECT_NEAR(static_cast<double>(solid) * stack.ring_height_mm(), floor, kDrawnDeviationMm);
      // No ring is partly floor: that would be a pit in it.
      EXPECT_NEAR(stack.rings()[solid].inner_mm(), 26.0, 0.05) << floor << " of " << height;
    }
  }
}

TEST(DrawnPot, DeviationIsThatOfTheSteps) {
  // The rim is drawn to 60 mm; the highest step has the mean square radius of its 2 mm.
  const auto section = section_of("20,0\n60,40\n", "pot.csv");
  ASSERT_TRUE(section) << refusal_of(section);
  const auto coarse = drawn_pot(*section, {2.0, {}, 1.9}, "pot.csv");
  ASSERT_TRUE(coarse) << refusal_of(coarse);
  EXPECT_NEAR(coarse->deviation.mm, 60.0 - std::sqrt((58.0 * 58.0 + 58.0 * 60.0 + 3600.0) / 3.0),
              kDeviationStepMm);
  EXPECT_EQ(coarse->deviation.height_mm, 40.0);
  const auto fine = drawn_pot(*section, {}, "pot.csv");
  ASSERT_TRUE(fine) << refusal_of(fine);
  EXPECT_LE(fine->deviation.mm, kDrawnDeviationMm);
  EXPECT_GT(fine->deviation.mm, 0.5 * kDrawnDeviationMm) << "no more rings than it needs";
  const auto straight = section_of("20,0\n20,40\n", "pot.csv");
  EXPECT_NEAR(drawn_pot(*straight, {}, "pot.csv")->deviation.mm, 0.0, 1e-9);
}

TEST(DrawnPot, WallOptionHollowsTheOutline) {
  const auto pot = pot_of("30,0\n30,60\n", {2.0, 6.0, 1.9});
  ASSERT_TRUE(pot) << refusal_of(pot);
  for (std::size_t i = 0; i < 30; ++i)
    EXPECT_NEAR(pot->stack.rings()[i].inner_mm(), i < 3 ? 0.0 : 24.0, 1e-9) << i;
  EXPECT_THAT(refusal_of(pot_of("20,0\n30,0\n30,10\n20,10\n20,0\n", {2.0, 6.0, 1.9})),
              HasSubstr("found a bore in it"));
  EXPECT_THAT(
      refusal_of(pot_of("30,0\n25,60\n", {2.0, 40.0, 1.9})),
      HasSubstr("--wall: expected less than the radius, found 40 mm; the radius is 25 mm at "
                "60 mm above the foot"));
  EXPECT_THAT(refusal_of(pot_of("90,0\n90,40\n", {2.0, 40.0, 1.9})),
              HasSubstr("--wall: expected less than the height of 40 mm"));
}

TEST(DrawnPot, MeasuresTheThinnestWallOfAHollowedOutlineAcrossIt) {
  // A cone that opens by 3 in 4: across its wall 0.8 of the horizontal thickness.
  const auto section = section_of("40,0\n70,40\n", "pot.csv");
  const auto cone = drawn_pot(*section, {{}, 5.0, 1.9}, "pot.csv");
  ASSERT_TRUE(cone) << refusal_of(cone);
  ASSERT_TRUE(cone->thinnest);
  EXPECT_NEAR(cone->thinnest->mm, 4.0, 1e-9);
  EXPECT_FALSE(drawn_pot(*section, {}, "pot.csv")->thinnest);
  // A dish: the wall rises by 5 mm over 50, so it is 3 sin(atan(0.1)) thick.
  const auto dish = section_of("30,0\n80,5\n80,10\n", "pot.csv");
  const auto flat = drawn_pot(*dish, {{}, 3.0, 1.9}, "pot.csv");
  ASSERT_TRUE(flat) << refusal_of(flat);
  EXPECT_NEAR(flat->thinnest->mm, 3.0 * std::sin(std::atan(0.1)), 1e-9);
}

TEST(DrawnPot, RefusesShapesThatNoStackCanRepresent) {
  EXPECT_THAT(refusal_of(pot_of("30,0\n30,60000\n", {1e-3, {}, 1.9})), HasSubstr("rings"));
  EXPECT_THAT(refusal_of(pot_of("6000,0\n6000,60\n")), HasSubstr("5000 mm"));
}

RC_GTEST_PROP(DrawnPot, HoldsTheDrawnVolume, ()) {
  std::string csv;
  double height = 0.0;
  const int count = *rc::gen::inRange(2, 20);
  for (int i = 0; i < count; ++i) {
    csv +=
        std::to_string(0.01 * *rc::gen::inRange(100, 9000)) + "," + std::to_string(height) + "\n";
    height += 0.01 * *rc::gen::inRange(1, 3000);
  }
  const auto section = section_of(csv, "pot.csv");
  RC_ASSERT(section.has_value());
  const auto pot = drawn_pot(*section, {0.01 * *rc::gen::inRange(1, 500), {}, 1.9}, "pot");
  RC_ASSERT(pot.has_value());
  // Half a quantum per bound and ring, plus the rounding of the sums.
  const double slack = 1e-12 * section->volume_mm3() + static_cast<double>(pot->pot.stack.size()) *
                                                           pot->pot.stack.mm3_per_quantum();
  const ClayStack& stack = pot->pot.stack;
  RC_ASSERT(std::abs(stack.volume_mm3() - section->volume_mm3()) < slack);
  RC_ASSERT(stack.recount() == stack.volume());
}

}  // namespace
}  // namespace clay::importing
