#include "claystack/engine/tool.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clay {
namespace {

TEST(Tool, EllipseFollowsItsFormula) {
  const Tool tool = Tool::build(EllipseSpec{15.0, 8.0}).value();
  for (double t = -14.8; t <= 14.8; t += 0.37) {
    EXPECT_NEAR(tool.radius(t), 8.0 * std::sqrt(1.0 - t * t / 225.0), 1e-13);
    EXPECT_NEAR(std::pow(tool.radius(t) / 8.0, 2) + std::pow(t / 15.0, 2), 1.0, 1e-13);
  }
  EXPECT_EQ(tool.low(), -15.0);
  EXPECT_EQ(tool.high(), 15.0);
}

TEST(Tool, SlopeIsTheDerivative) {
  const SampledSpec sampled{{-10, -4, 0, 1, 9}, {0, 6, 7, 7, 2}};
  for (const ToolShapeSpec& spec :
       {ToolShapeSpec{SphereSpec{10}}, ToolShapeSpec{EllipseSpec{12, 5}},
        ToolShapeSpec{RibSpec{20, 6}}, ToolShapeSpec{sampled}}) {
    const Tool tool = Tool::build(spec).value();
    for (double t = -8.97; t < 8.9; t += 0.31) {
      const double h = 1e-6;
      const double difference = (tool.radius(t + h) - tool.radius(t - h)) / (2 * h);
      EXPECT_NEAR(tool.slope(t), difference, 1e-7 * (1 + std::abs(difference)))
          << spec.index() << " " << t;
    }
  }
}

TEST(Tool, WidestIsTheMaximumRadius) {
  for (const auto& [spec, at] :
       {std::pair{ToolShapeSpec{EllipseSpec{12, 5}}, 0.0},
        {ToolShapeSpec{RibSpec{20, 6}}, 3.0},
        {ToolShapeSpec{SampledSpec{{-10, -4, 1, 9}, {0, 6, 7, 2}}}, 1.0}}) {
    const Tool tool = Tool::build(spec).value();
    EXPECT_EQ(tool.widest(), tool.radius(at));
    for (double t = -12.0; t <= 12.0; t += 0.125) EXPECT_LE(tool.radius(t), tool.widest());
  }
}

TEST(Tool, IsZeroBeyondItsEndsAndFiniteAtThem) {
  const Tool tool = Tool::build(SphereSpec{10}).value();
  EXPECT_EQ(tool.radius(10.0), 0.0);
  EXPECT_EQ(tool.radius(10.0000001), 0.0);
  EXPECT_EQ(tool.radius(-1e300), 0.0);
  EXPECT_EQ(tool.slope(11.0), 0.0);
  EXPECT_EQ(tool.radius(std::nan("")), 0.0);
  // The largest slope is u / sqrt(1 - u^2) with u = 127/128.
  EXPECT_NEAR(tool.slope(-10.0), (127.0 / 128) / std::sqrt(1 - std::pow(127.0 / 128, 2)), 1e-12);
  EXPECT_EQ(Tool::build(RibSpec{20, 6}).value().radius(10.0), 6.0);
}

RC_GTEST_PROP(Tool, SampledProfileInterpolatesWithoutOvershoot, ()) {
  const auto steps = *rc::gen::container<std::vector<int>>(6, rc::gen::inRange(1, 1000));
  const auto heights = *rc::gen::container<std::vector<int>>(6, rc::gen::inRange(0, 500));
  SampledSpec spec;
  double t = -20.0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    spec.t_mm.push_back(t += steps[k] * 0.01);
    spec.f_mm.push_back(heights[k] * 0.1);
  }
  const Tool tool = Tool::build(spec).value();
  for (std::size_t k = 0; k + 1 < spec.t_mm.size(); ++k) {
    RC_ASSERT(std::abs(tool.radius(spec.t_mm[k]) - spec.f_mm[k]) < 1e-9);
    const auto [low, high] = std::minmax(spec.f_mm[k], spec.f_mm[k + 1]);
    for (double s = 0.0; s <= 1.0; s += 0.05) {
      const double f = tool.radius(spec.t_mm[k] + s * (spec.t_mm[k + 1] - spec.t_mm[k]));
      RC_ASSERT(f >= low - 1e-9 && f <= high + 1e-9);
    }
  }
}

TEST(Tool, RefusesInvalidShapes) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const ToolShapeSpec& spec :
       {ToolShapeSpec{SphereSpec{0}}, ToolShapeSpec{SphereSpec{-1}}, ToolShapeSpec{SphereSpec{nan}},
        ToolShapeSpec{SphereSpec{inf}}, ToolShapeSpec{EllipseSpec{0, 1}},
        ToolShapeSpec{EllipseSpec{1, nan}}, ToolShapeSpec{RibSpec{1, 0}},
        ToolShapeSpec{RibSpec{-2, 1}}, ToolShapeSpec{SampledSpec{}},
        ToolShapeSpec{SampledSpec{{0}, {1}}}, ToolShapeSpec{SampledSpec{{0, 1}, {1}}},
        ToolShapeSpec{SampledSpec{{0, 0}, {1, 1}}}, ToolShapeSpec{SampledSpec{{0, 1}, {1, -1}}},
        ToolShapeSpec{SampledSpec{{0, nan}, {1, 1}}}}) {
    const auto tool = Tool::build(spec);
    ASSERT_FALSE(tool);
    EXPECT_EQ(tool.error().kind, ErrorKind::bad_input);
    EXPECT_EQ(tool.error().message.rfind("tool:", 0), 0u);
  }
}

}  // namespace
}  // namespace clay
