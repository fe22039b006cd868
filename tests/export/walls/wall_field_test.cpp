#include "claystack/export/walls.hpp"

#include "tests/engine/clay/stack_samples.hpp"
#include "tests/export/section/cup_section.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace clay::solid {
namespace {

using shapes::cup;

TEST(WallField, LabelsTheFaces) {
  const Polygon pot{{0, 0}, {40, 0}, {40, 60}, {0, 60}, {0, 58}, {30, 58}, {30, 9}, {0, 9}};
  const auto field = wall_field({{pot}}, 1e3);
  const std::vector<WallFace> faces{WallFace::foot, WallFace::outer, WallFace::rim,
                                    WallFace::lid,  WallFace::bore,  WallFace::floor};
  ASSERT_EQ(field.size(), faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) EXPECT_EQ(field[i].face, faces[i]) << i;
  EXPECT_NEAR(field[1].arc_mm, 40.0 + 30.0, 1e-12);
  EXPECT_NEAR(field[3].arc_mm, 40.0 + 60.0 + 40.0 + 15.0, 1e-12);  // not along the axis
  EXPECT_NEAR(field[1].thickness_mm, 10.0, 1e-12);
  EXPECT_NEAR(field[1].opposite.rho, 30.0, 1e-12);
  EXPECT_NEAR(field[5].thickness_mm, 9.0, 1e-12);
  EXPECT_NEAR(field[3].thickness_mm, 2.0, 1e-12);
}

TEST(WallField, RespectsSpacingAndLimit) {
  const auto field = wall_field({{cup(5, 8)}}, 0.5);
  for (std::size_t i = 1; i < field.size(); ++i)
    EXPECT_LE(field[i].arc_mm - field[i - 1].arc_mm, 0.5 + 1e-9);
  const auto many = wall_field({{cup(5, 8)}}, 1e-4);
  EXPECT_LE(many.size(), kMaxWallSamples);
  EXPECT_GT(many.size(), kMaxWallSamples / 2);
}

TEST(WallField, ContinuesAWallToItsLip) {
  // Near the lip, the boundary between two opposite points is shorter than three diameters.
  const Polygon pot{{0, 0}, {40, 0}, {40, 60}, {35, 60}, {35, 9}, {0, 9}};
  std::size_t samples = 0;
  for (const WallSample& sample : wall_field({{pot}}, 0.5)) {
    if (sample.face == WallFace::floor || sample.at.y < 15.0) continue;
    EXPECT_NEAR(sample.thickness_mm, 5.0, 1e-9) << sample.at.rho << ", " << sample.at.y;
    ++samples;
  }
  EXPECT_GT(samples, 180u);
}

RC_GTEST_PROP(WallField, ConvergesToTheMinimumWall, ()) {
  auto random = *samples::random_engine();
  // Walls that change slowly, without sharp edges.
  constexpr double h = 0.3;
  std::vector<shapes::Radii> radii;
  for (double outer = 40.0; radii.size() < 100; outer += 0.1 * (samples::uniform(random) - 0.5))
    radii.push_back(
        {outer, radii.size() < 12 ? 0.0 : outer - 3.0 - 0.1 * samples::uniform(random)});
  const auto section = shapes::fair_section(shapes::stack_of(h, radii), 1e-6).value();
  const double least = min_wall_mm(section.profile);
  double previous = std::numeric_limits<double>::infinity();
  for (const double spacing : {1.0, 0.2, 0.04}) {
    double thinnest = std::numeric_limits<double>::infinity();
    for (const WallSample& sample : wall_field(section.profile, spacing))
      thinnest = std::min(thinnest, sample.thickness_mm);
    RC_ASSERT(thinnest > least - h);
    RC_ASSERT(thinnest < least + 2.0 * spacing);
    RC_ASSERT(thinnest < previous + 1e-9);
    previous = thinnest + spacing;
  }
}

}  // namespace
}  // namespace clay::solid
