#include "claystack/engine/clay.hpp"

#include "tests/engine/files/arbitrary.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace clay {
namespace {

struct RadiiMm {
  double outer, inner;
};

Pot pot_of(const std::vector<RadiiMm>& radii, double ring_height_mm = 1.0) {
  std::vector<Ring> rings;
  for (const auto& [outer, inner] : radii)
    rings.push_back({quanta_from_radius(outer), quanta_from_radius(inner)});
  Pot pot;
  pot.stack = ClayStack::from_rings(ring_height_mm, std::move(rings), 5).value();
  pot.ledger.initial = pot.stack.volume() + 7;
  pot.ledger.trimmed = 7;
  return pot;
}

void expect_refused(const Pot& pot, double precision_mm, const std::string& message) {
  const auto rounded = rounded_pot(pot, precision_mm);
  ASSERT_FALSE(rounded) << message;
  EXPECT_EQ(rounded.error().kind, ErrorKind::bad_input);
  EXPECT_EQ(rounded.error().message, message);
}

/// Any allowed precision, a whole number of nanometres.
double arbitrary_precision() { return *rc::gen::inRange(10, 1'000'001) / 1e6; }

bool touch(const Ring& a, const Ring& b) { return a.inner2 < b.outer2 && b.inner2 < a.outer2; }

RC_GTEST_PROP(RoundedPot, RadiiAreTheNearestMultiples, ()) {
  const Pot pot = test::arbitrary_pot();
  const double precision = arbitrary_precision();
  const auto rounded = rounded_pot(pot, precision);
  RC_PRE(rounded.has_value());
  const auto is_multiple = [&](Quanta square) {
    // In long double the square is off by at most a few quanta, a wrong multiple by many more.
    const long double steps = std::round(radius_from_quanta(square) / precision);
    const long double mm = steps * std::round(precision * 1e6L) / 1e6L;
    return std::abs(mm * mm * 0x1p36L - static_cast<long double>(square)) <= 2.0L;
  };
  const double half = 0.5 * precision + 1e-9;
  for (std::size_t i = 0; i < pot.stack.size(); ++i) {
    const Ring& before = pot.stack.rings()[i];
    const Ring& after = rounded->stack.rings()[i];
    RC_ASSERT(is_multiple(after.outer2) && is_multiple(after.inner2));
    RC_ASSERT(std::abs(after.outer_mm() - before.outer_mm()) <= half);
    RC_ASSERT((after.inner2 > 0) == (before.inner2 > 0));
    RC_ASSERT(std::abs(after.inner_mm() - before.inner_mm()) <= half ||
              before.inner_mm() < 0.5 * precision);
    if (i > 0 && touch(before, pot.stack.rings()[i - 1]))
      RC_ASSERT(touch(after, rounded->stack.rings()[i - 1]));
  }
}

RC_GTEST_PROP(RoundedPot, IsAValidPot, ()) {
  const Pot pot = test::arbitrary_pot();
  const double precision = arbitrary_precision();
  const auto rounded = rounded_pot(pot, precision);
  RC_PRE(rounded.has_value());
  RC_ASSERT(rounded->ledger == Ledger{.initial = rounded->stack.recount()});
  RC_ASSERT(rounded->rounding == (Rounding{precision, pot.stack.volume()}));
  Pot back = *rounded;
  back.stack = pot.stack;
  back.ledger = pot.ledger;
  RC_ASSERT(rounded->rim == Rim{});
  back.rim = pot.rim;
  back.rounding.reset();
  RC_ASSERT(back == pot);
  RC_ASSERT(rounded->stack.crown() == pot.stack.crown());
  RC_ASSERT(rounded->stack.max_rings() == pot.stack.max_rings());
  RC_ASSERT(rounded->stack.ring_height_mm() == pot.stack.ring_height_mm());
  RC_ASSERT(rounded_pot(*rounded, precision).value() == *rounded);
}

TEST(RoundedPot, SquaresAreTheNearestQuanta) {
  // (n nm)^2 = n^2 2^24 / 5^12 quanta, by rational arithmetic.
  const auto ring = [](RadiiMm exact) {
    return rounded_pot(pot_of({exact}), 0.001).value().stack.rings()[0];
  };
  EXPECT_EQ(ring({45.0012, 0.00298}), (Ring{139'163'125'212'026, 618'475}));
  EXPECT_EQ(ring({4999.9991, 45.0006}), (Ring{1'717'986'231'205'301'359, 139'163'125'212'026}));
  // Multiples of 2^-6 mm have whole squares: j^2 2^24.
  const auto binary = rounded_pot(pot_of({{10.01, 9.98}}), 0.015625).value().stack;
  EXPECT_EQ(binary.rings()[0].outer2, Quanta{641} * 641 << 24);
  EXPECT_EQ(binary.rings()[0].inner2, Quanta{639} * 639 << 24);
}

TEST(RoundedPot, ReportsTheAddedVolume) {
  const Pot pot = pot_of({{10.0004, 0.0}, {20.0003, 8.9997}}, 2.0);
  EXPECT_EQ(volume_change_mm3(pot), 0.0);
  const double expected =
      2.0 * std::numbers::pi *
      (100.0 - 10.0004 * 10.0004 + 400.0 - 20.0003 * 20.0003 - (81.0 - 8.9997 * 8.9997));
  EXPECT_NEAR(volume_change_mm3(rounded_pot(pot, 0.001).value()), expected, 1e-9);
}

TEST(RoundedPot, KeepsTheOriginalExactVolume) {
  const Pot pot = pot_of({{10.0044, 5.0}});
  const auto twice = rounded_pot(rounded_pot(pot, 0.001).value(), 0.01);
  ASSERT_TRUE(twice);
  EXPECT_EQ(twice->rounding, (Rounding{0.01, pot.stack.volume()}));
  expect_refused(*twice, 0.001,
                 "expected a precision of 0.01 mm or coarser, as the pot is rounded to that, found "
                 "0.001 mm");
}

TEST(RoundedPot, KeepsANarrowBore) {
  const auto rounded = rounded_pot(pot_of({{10.0, 0.0}, {10.0, 0.0003}}), 0.001);
  ASSERT_TRUE(rounded);
  EXPECT_EQ(rounded->stack.rings()[0].inner2, 0);
  EXPECT_NEAR(rounded->stack.rings()[1].inner_mm(), 0.001, 1e-8);
}

TEST(RoundedPot, RefusesAChangeOfTopology) {
  expect_refused(pot_of({{10.0, 9.0}, {10.25, 9.875}}), 1.0,
                 "ring 1: expected radii that can be rounded to 1 mm, found a wall that would "
                 "vanish, from 9.875 mm to 10.25 mm");
  expect_refused(pot_of({{20.0, 10.0}, {25.0, 19.9996}}), 0.001,
                 "ring 1: expected radii that can be rounded to 0.001 mm, found one that would no "
                 "longer touch the ring below");
  expect_refused(pot_of({{25.0, 19.75}, {20.0, 10.0}}), 0.5,
                 "ring 1: expected radii that can be rounded to 0.5 mm, found one that would no "
                 "longer touch the ring below");
  expect_refused(pot_of({{0.25, 0.0}}), 1.0,
                 "ring 0: expected radii that can be rounded to 1 mm, found a wall that would "
                 "vanish, from 0 mm to 0.25 mm");
  // Rings that did not touch before need not touch after.
  EXPECT_TRUE(rounded_pot(pot_of({{20.0, 10.0}, {25.0, 20.0004}}), 0.001));
}

TEST(RoundedPot, RefusesRadiiBeyondTheLimits) {
  const auto rounded = rounded_pot(pot_of({{10.0, 0.0}, {5000.0, 0.0}}), 0.7);
  ASSERT_FALSE(rounded);
  EXPECT_TRUE(
      rounded.error().message.starts_with("ring 1: expected an outer radius from 0.001 to 5000 mm"))
      << rounded.error().message;
}

TEST(RoundedPot, RefusesInvalidPrecisions) {
  const Pot pot = pot_of({{10.0, 0.0}});
  for (const double precision : {0.0, -0.001, 1e-6, 9e-6, 1.000001, 1.0 / 3.0, 0.0012345,
                                 std::nan(""), double{INFINITY}, 1e300}) {
    const auto rounded = rounded_pot(pot, precision);
    ASSERT_FALSE(rounded) << precision;
    EXPECT_TRUE(rounded.error().message.starts_with(
        "expected a precision from 0.00001 to 1 mm, in whole nanometres, found "))
        << rounded.error().message;
  }
  for (const double precision : {1e-5, 0.00123, 0.001234, 0.1, 1.0})
    EXPECT_TRUE(rounded_pot(pot, precision)) << precision;
}

}  // namespace
}  // namespace clay
