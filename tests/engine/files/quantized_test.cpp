#include "claystack/engine/files.hpp"
#include "tests/engine/files/arbitrary.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace clay {
namespace {

constexpr double kQuantumMm = 1.0 / 65536.0;

TEST(Quantized, RoundsToTheNearestCount) {
  EXPECT_EQ(quantized({5, {1.0, -2.5, 0.0}, true}), (Pose{5, {1.0, -2.5, 0.0}, true}));
  const Pose near = quantized({0, {1.4 * kQuantumMm, -1.4 * kQuantumMm, 0.6 * kQuantumMm}, false});
  EXPECT_EQ(near.position_mm, glm::dvec3(1, -1, 1) * kQuantumMm);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Pose wild = quantized({0, {kInfinity, -1e300, std::nan("")}, false});
  EXPECT_EQ(wild.position_mm, glm::dvec3(1e6, -1e6, 0));
  const auto gap = [](double mm) { return quantized({0, {0, 0, 0}, false, mm}).gap_mm; };
  EXPECT_EQ(gap(1.4 * kQuantumMm), kQuantumMm);
  EXPECT_EQ(gap(-3.0), 0.0);
  EXPECT_EQ(gap(std::nan("")), 0.0);
  EXPECT_EQ(gap(kInfinity), 1e6);
}

RC_GTEST_PROP(Quantized, MovesByAtMostHalfAQuantumAndIsIdempotent, ()) {
  const Pose pose{0, {*test::number_in(-1e6, 1e6), *test::number_in(-1, 1), 0.0}, false};
  const Pose once = quantized(pose);
  RC_ASSERT(std::abs(once.position_mm.x - pose.position_mm.x) <= kQuantumMm / 2);
  RC_ASSERT(std::abs(once.position_mm.y - pose.position_mm.y) <= kQuantumMm / 2);
  RC_ASSERT(quantized(once) == once);
}

}  // namespace
}  // namespace clay
