#include "app/import/drawn_pot.hpp"

#include "tests/app/import/solids.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace clay::importing {
namespace {

using testing::HasSubstr;

Result<Pot> pot_of(const std::string& csv, const DrawnPotSettings& settings = {}) {
  return section_of(csv, "pot.csv").and_then([&](HalfSection&& section) {
    return drawn_pot(section, settings, "pot.csv");
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

TEST(DrawnPot, FillsAPartOfARingBelowAFloor) {
  // Rings of 2 mm, a floor of 3: the second ring is solid in its lower half.
  const auto pot = pot_of("0,0\n30,0\n30,10\n20,10\n20,3\n0,3\n", {2.0, {}, 1.9});
  ASSERT_TRUE(pot) << refusal_of(pot);
  const auto rings = pot->stack.rings();
  ASSERT_EQ(rings.size(), 5u);
  EXPECT_EQ(rings[0].inner2, 0);
  EXPECT_EQ(rings[1].inner2, quanta_from_mm2(200.0));
  EXPECT_EQ(rings[2].inner2, quanta_from_mm2(400.0));
}

TEST(DrawnPot, RoundsTheHeightToWholeRings) {
  const auto pot = pot_of("10,0\n10,10\n", {3.0, {}, 1.9});
  ASSERT_TRUE(pot) << refusal_of(pot);
  EXPECT_EQ(pot->stack.size(), 3u);
  EXPECT_NEAR(pot->stack.height_mm(), 10.0, 1e-12);
  EXPECT_EQ(pot->stack.crown(), 0);
}

TEST(DrawnPot, WallOptionHollowsTheOutline) {
  const auto pot = pot_of("30,0\n30,60\n", {2.0, 6.0, 1.9});
  ASSERT_TRUE(pot) << refusal_of(pot);
  for (std::size_t i = 0; i < 30; ++i)
    EXPECT_NEAR(pot->stack.rings()[i].inner_mm(), i < 3 ? 0.0 : 24.0, 1e-9) << i;
  EXPECT_THAT(refusal_of(pot_of("20,0\n30,0\n30,10\n20,10\n20,0\n", {2.0, 6.0, 1.9})),
              HasSubstr("--wall"));
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
  const double slack = 1e-12 * section->volume_mm3() +
                       static_cast<double>(pot->stack.size()) * pot->stack.mm3_per_quantum();
  RC_ASSERT(std::abs(pot->stack.volume_mm3() - section->volume_mm3()) < slack);
  RC_ASSERT(pot->stack.recount() == pot->stack.volume());
}

}  // namespace
}  // namespace clay::importing
