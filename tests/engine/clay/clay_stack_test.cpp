#include "claystack/engine/clay.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace clay {
namespace {

TEST(ClayStack, CylinderHoldsPiRSquaredH) {
  const auto stack = ClayStack::cylinder(200, 0.5, 40.0, 10.0, 400).value();
  EXPECT_EQ(stack.size(), 200u);
  EXPECT_DOUBLE_EQ(stack.height_mm(), 100.0);
  const double expected = std::numbers::pi * (40.0 * 40.0 - 10.0 * 10.0) * 100.0;
  EXPECT_NEAR(stack.volume_mm3() / expected, 1.0, 1e-14);
  // 1500 mm^2 is a whole number of quanta.
  EXPECT_TRUE(stack.volume() == WideQuanta{200} * 1500 * (Quanta{1} << 36));
  EXPECT_TRUE(stack.recount() == stack.volume());
  EXPECT_TRUE(stack.hollow());
}

TEST(ClayStack, CrownIsAFractionOfTheTopRing) {
  const Ring ring{quanta_from_radius(10.0), 0};
  const auto stack = ClayStack::from_rings(2.0, {ring, ring}, ring.volume() / 4).value();
  EXPECT_DOUBLE_EQ(stack.crown_height_mm(), 0.5);
  EXPECT_DOUBLE_EQ(stack.height_mm(), 4.5);
  EXPECT_NEAR(stack.volume_mm3(), std::numbers::pi * 100.0 * 4.5, 1e-9);
}

TEST(ClayStack, RadiusRoundTripsThroughQuanta) {
  for (const double mm : {0.001, 0.37, 1.0, 50.0, 4999.0}) {
    // Half a quantum of R^2 is 1/2R times half a quantum in R.
    EXPECT_NEAR(radius_from_quanta(quanta_from_radius(mm)), mm,
                kMm2PerQuantum / (2.0 * mm) + 1e-15 * mm);
  }
}

struct BadCylinder {
  std::size_t count;
  double height, outer, inner;
  std::size_t max_rings;
  const char* names;
};

TEST(ClayStack, RefusesRadiiOutOfRange) {
  const double nan = std::nan("");
  for (const BadCylinder& bad : {
           BadCylinder{0, 1, 10, 0, 10, "rings"},
           BadCylinder{kMaxRings + 1, 1, 10, 0, kMaxRings + 1, "rings"},
           BadCylinder{10, 1, 10, 0, 9, "largest number"},
           BadCylinder{10, 0, 10, 0, 10, "ring height"},
           BadCylinder{10, nan, 10, 0, 10, "ring height"},
           BadCylinder{10, 1, 5001, 0, 10, "outer radius"},
           BadCylinder{10, 1, 1e300, 0, 10, "outer radius"},
           BadCylinder{10, 1, 1e-160, 0, 10, "outer radius"},
           BadCylinder{10, 1, nan, 0, 10, "outer radius"},
           BadCylinder{10, 1, 10, 10, 10, "inner"},
           BadCylinder{10, 1, 10, -1, 10, "inner"},
           BadCylinder{10, 1, 10, nan, 10, "inner"},
       }) {
    const auto stack =
        ClayStack::cylinder(bad.count, bad.height, bad.outer, bad.inner, bad.max_rings);
    ASSERT_FALSE(stack) << bad.names;
    EXPECT_EQ(stack.error().kind, ErrorKind::bad_input);
    EXPECT_NE(stack.error().message.find(bad.names), std::string::npos) << stack.error().message;
  }
}

TEST(ClayStack, FromRingsNamesTheRing) {
  const Ring good{quanta_from_radius(10.0), 0},
      bad{quanta_from_radius(10.0), quanta_from_radius(10.0)};
  const auto stack = ClayStack::from_rings(1.0, {good, good, bad}, 0);
  ASSERT_FALSE(stack);
  EXPECT_NE(stack.error().message.find("ring 2"), std::string::npos);
  EXPECT_FALSE(ClayStack::from_rings(1.0, {good}, -1));
  EXPECT_FALSE(ClayStack::from_rings(1.0, {Ring{quanta_from_radius(10.0), -1}}, 0));
}

TEST(Quanta, PrintsWideCounts) {
  EXPECT_EQ(to_string(WideQuanta{0}), "0");
  EXPECT_EQ(to_string(WideQuanta{-42}), "-42");
  EXPECT_EQ(to_string(WideQuanta{1} << 100), "1267650600228229401496703205376");
  EXPECT_EQ(to_string(-(WideQuanta{1} << 126) * 2), "-170141183460469231731687303715884105728");
}

}  // namespace
}  // namespace clay
