#include "engine/collapse/fallen_body.hpp"

#include "tests/engine/clay/stack_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace clay {
namespace {

TEST(FallenBody, MeasuresOfACylinder) {
  const ClayStack stack = ClayStack::cylinder(50, 2.0, 20.0, 0.0, 50).value();
  const FallenBody body(stack, 9);  // 80 mm from 20 mm up
  EXPECT_NEAR(body.volume_mm3(), std::numbers::pi * 400 * 80, 1e-6);
  EXPECT_NEAR(body.centre_height_mm(), 60.0, 1e-12);
  EXPECT_NEAR(body.gyration_mm(), std::sqrt(400.0 / 4 + 80.0 * 80 / 12), 1e-10);
  EXPECT_NEAR(body.reach_mm(), std::hypot(20, 40), 1e-12);
  for (const double angle : {0.1, 1.0, 2.0, 3.0, -0.4, -2.5})
    EXPECT_NEAR(body.lowest(angle).y,
                -20 * std::abs(std::sin(angle)) - 40 * std::abs(std::cos(angle)), 1e-12);
}

TEST(FallenBody, MeasuresOfATubeWithACrown) {
  const Ring ring{quanta_from_radius(20), quanta_from_radius(16)};
  // Three and a half rings.
  const ClayStack stack =
      ClayStack::from_rings(4.0, {ring, ring, ring, ring}, ring.volume() / 2).value();
  const FallenBody body(stack, 0);
  EXPECT_NEAR(body.volume_mm3(), std::numbers::pi * (400 - 256) * 14, 1e-6);
  EXPECT_NEAR(body.centre_height_mm(), 4 + 7, 1e-9);
  EXPECT_NEAR(body.gyration_mm(), std::sqrt((400.0 + 256) / 4 + 14.0 * 14 / 12), 1e-9);
  const FallenBody crown(stack, 3);
  EXPECT_NEAR(crown.volume_mm3(), std::numbers::pi * (400 - 256) * 2, 1e-6);
  EXPECT_NEAR(crown.centre_height_mm(), 17, 1e-9);
  EXPECT_NEAR(crown.lowest(0.0).y, -1.0, 1e-9);
}

TEST(FallenBody, IsEmptyAboveTheTopRing) {
  EXPECT_TRUE(FallenBody(ClayStack::cylinder(5, 2.0, 20.0, 0.0, 5).value(), 4).empty());
}

RC_GTEST_PROP(FallenBody, LowestPointIsTheMinimumOfAllCorners, ()) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(2, 80);
  const ClayStack stack = samples::stack(random, count, 3.0 * samples::uniform(random) + 0.1);
  const auto failed = *rc::gen::inRange<std::size_t>(0, count - 1);
  const FallenBody body(stack, failed);
  for (int k = 0; k < 50; ++k) {
    const double angle = 7.0 * samples::uniform(random) - 3.5;
    double least = 1e300;
    for (std::size_t i = failed + 1; i < count; ++i)
      for (const double side : {-1.0, 1.0})
        for (const double level : {0.0, 1.0}) {
          const double y = stack.ring_height_mm() * (static_cast<double>(i) + level);
          least = std::min(least, side * stack.rings()[i].outer_mm() * std::sin(angle) +
                                      (y - body.centre_height_mm()) * std::cos(angle));
        }
    RC_ASSERT(std::abs(body.lowest(angle).y - least) < 1e-10);
  }
}

RC_GTEST_PROP(FallenBody, SamplesFormAClosedSurface, ()) {
  // Gauss: over a closed surface the normal integrates to zero, and each of x n_x, y n_y and z n_z
  // to the volume.
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(2, 300);
  const ClayStack plain = samples::stack(random, count, 1.0);
  const auto rings = plain.rings();
  const WideQuanta crown = rings.back().volume() / *rc::gen::element<Quanta>(2, 3, INT64_MAX);
  const ClayStack stack = ClayStack::from_rings(1.0, {rings.begin(), rings.end()}, crown).value();
  const FallenBody body(stack, *rc::gen::inRange<std::size_t>(0, count - 1));
  double closed = 0.0, across = 0.0, up = 0.0, area = 0.0;
  for (const SurfaceStrip& s : body.surface()) {
    for (const double cosine : FallenBody::directions()) {
      closed += s.area_mm2 * s.upward;
      across += s.area_mm2 * s.outward * cosine * s.radius_mm * cosine;
      up += s.area_mm2 * s.upward * s.height_mm;
      area += s.area_mm2;
    }
  }
  const double rounding = 1e-12 * area * body.reach_mm() + 1e-9;
  RC_ASSERT(std::abs(closed) < rounding);
  RC_ASSERT(std::abs(across - body.volume_mm3()) < rounding);
  RC_ASSERT(std::abs(up - body.volume_mm3()) < rounding);
}

TEST(FallenBody, NumberOfSamplesIsBounded) {
  const auto samples_of = [](std::size_t rings) {
    auto random = std::mt19937_64(7);
    return FallenBody(samples::stack(random, rings, 100.0 / static_cast<double>(rings)), 0)
        .surface()
        .size();
  };
  EXPECT_LT(samples_of(50'000), 2 * samples_of(500));
}

}  // namespace
}  // namespace clay
