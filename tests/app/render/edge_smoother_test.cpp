// Smoothed edges, compared with half planes of known place.

#include "app/render/edge_smoother.hpp"
#include "app/render/offscreen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace clay::render {
namespace {

constexpr int kSide = 64;
using Rows = std::vector<std::uint8_t>;  // RGBA, lowest row first

Rows grey(auto value_at) {
  Rows rows;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const std::uint8_t value = value_at(x, y);
      rows.insert(rows.end(), {value, value, value, 255});
    }
  return rows;
}

Rows smoothed(const Rows& rows) {
  static auto screen = Offscreen::create();  // makes its context current
  EXPECT_TRUE(screen);
  const auto smoother = EdgeSmoother::create().value();
  const Canvas from = Canvas::create(kSide, kSide, 0).value();
  const Canvas into = Canvas::create(kSide, kSide, 0).value();
  glBindTexture(GL_TEXTURE_2D, from.colour());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kSide, kSide, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
  smoother.draw(from, into);
  Rows done(rows.size());
  glReadPixels(0, 0, kSide, kSide, GL_RGBA, GL_UNSIGNED_BYTE, done.data());
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
  return done;
}

/// The largest distance [px] between the line and the height of the dark part of a column.
double steps(const Rows& rows, double slope, double from_px) {
  double worst = 0.0;
  for (int x = 8; x < kSide - 8; ++x) {
    double dark = 0.0;
    for (int y = 0; y < kSide; ++y)
      dark += 1.0 - rows[static_cast<std::size_t>(4 * (y * kSide + x))] / 255.0;
    worst = std::max(worst, std::abs(dark - (from_px + slope * (x + 0.5))));
  }
  return worst;
}

TEST(EdgeSmoother, ReplacesStepsByASlope) {
  for (const double slope : {0.2, 0.5, 0.77, -0.34}) {
    const double from_px = slope > 0.0 ? 4.0 : 50.0;
    const Rows stepped = grey([&](int x, int y) {
      return std::uint8_t{y + 0.5 < from_px + slope * (x + 0.5) ? std::uint8_t{0}
                                                                : std::uint8_t{255}};
    });
    const double before = steps(stepped, slope, from_px);
    EXPECT_LT(steps(smoothed(stepped), slope, from_px), 0.6 * before) << slope;
    EXPECT_GT(before, 0.2) << slope;
  }
}

TEST(EdgeSmoother, KeepsAnEvenColourAndAGentleSlope) {
  const Rows even = grey([](int, int) { return std::uint8_t{137}; });
  EXPECT_EQ(smoothed(even), even);
  const Rows gentle = grey([](int x, int) { return static_cast<std::uint8_t>(40 + 2 * x); });
  const Rows done = smoothed(gentle);
  for (std::size_t i = 0; i < done.size(); ++i) ASSERT_NEAR(done[i], gentle[i], 2) << i;
}

TEST(EdgeSmoother, KeepsAnUprightEdgeSharp) {
  const Rows edge = grey([](int x, int) { return static_cast<std::uint8_t>(x < 32 ? 20 : 220); });
  const Rows done = smoothed(edge);
  for (int x = 0; x < kSide; ++x) {
    const auto at = static_cast<std::size_t>(4 * (32 * kSide + x));
    EXPECT_NEAR(done[at], edge[at], 2) << x;
  }
}

}  // namespace
}  // namespace clay::render
