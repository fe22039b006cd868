// The limit of the motion of a pinched wall, compared with the geometry of two spheres and a tube.

#include "engine/tick/centring.hpp"
#include "tests/engine/tick/pinch_samples.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace clay {
namespace {

constexpr double kTubeOuterMm = 40.0, kTubeInnerMm = 34.0, kTubeGapMm = 4.0, kTubeRingMm = 0.5;
constexpr double kPinchY = 20.0;

struct Centred {
  Tool tool = Tool::build(SphereSpec{samples::kToolMm}).value();
  ClayStack stack = ClayStack::cylinder(100, kTubeRingMm, kTubeOuterMm, kTubeInnerMm, 300).value();
  std::array<ToolRemoval, 2> removals;
  PushOver over;

  explicit Centred(double hip_x) {
    for (ToolRemoval& removal : removals) removal.contact.rings.reserve(40);
    over.reserve(40);
    find_pinch(tool, stack, {hip_x, kPinchY, 0.0}, kTubeGapMm, removals[0].contact,
               removals[1].contact);
    over.measure(tool, stack, kPinchY, removals);
  }
};

/// Depths of the outer and of the inner tool in the ring [mm]; negative: the clearance.
std::array<double, 2> tube_depths(double hip_x, std::size_t ring) {
  const double t = (static_cast<double>(ring) + 0.5) * kTubeRingMm - kPinchY, a = samples::kToolMm;
  const double f = std::sqrt(a * a - t * t), middle = 0.5 * kTubeGapMm + a;
  return {kTubeOuterMm + f - (hip_x + middle), hip_x - middle + f - kTubeInnerMm};
}

TEST(Centring, PushesAWallInUntilBothToolsPushBackAlike) {
  const double hip_x = 36.0;  // the middle of the wall is at 37
  const Centred pinch(hip_x);
  ASSERT_EQ(pinch.over.from(), 24u);
  ASSERT_EQ(pinch.over.to(), 56u);
  const double opening = kTubeOuterMm / kTubeInnerMm;
  std::size_t pushed = 0;
  for (std::size_t i = pinch.over.from(); i < pinch.over.to(); ++i) {
    const auto [outer, inner] = tube_depths(hip_x, i);
    const double u = pinch.over.inward_mm(i);
    EXPECT_EQ(pinch.over.outward_mm(i), 0.0) << i;
    if (!(u > 0.0)) continue;
    // The inner surface moves by u R / r, and its tool is deeper then.
    EXPECT_NEAR(outer - u, opening * (inner + opening * u), 1e-9) << i;
    ++pushed;
  }
  EXPECT_EQ(pushed, 32u);
}

TEST(Centring, PushesAWallOutUntilBothToolsAreEquallyDeep) {
  const double hip_x = 38.5;
  const Centred pinch(hip_x);
  for (std::size_t i = pinch.over.from(); i < pinch.over.to(); ++i) {
    const auto [outer, inner] = tube_depths(hip_x, i);
    EXPECT_NEAR(pinch.over.outward_mm(i), 0.5 * (inner - outer), 1e-9) << i;
  }
}

}  // namespace
}  // namespace clay
