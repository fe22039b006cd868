#include "claystack/export/walls.hpp"

#include "tests/engine/clay/stack_samples.hpp"
#include "tests/export/section/cup_section.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
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
  // Finer than any face can be divided.
  const auto most = wall_field({{cup(5, 8)}}, 1e-12);
  EXPECT_LE(most.size(), kMaxWallSamples);
  EXPECT_GT(most.size(), kMaxWallSamples / 2);
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

/// Rings of 0.2 mm height and 4 mm width, each 0.12 mm farther out than the one below, on a tube. A
/// disc that touches the middle of a riser or of a tread passes through a corner some rings farther
/// on.
TEST(WallField, MeasuresEachStepOfALeaningWall) {
  constexpr int kRings = 300;
  constexpr double kHigh = 0.2, kOut = 0.12, kWidth = 4.0;
  Polygon wall{{30.0, -20.0}};
  for (int i = 0; i < kRings; ++i)
    for (const int y : {i, i + 1}) wall.push_back({30.0 + kOut * i, kHigh * y});
  for (int i = kRings - 1; i >= 0; --i)
    for (const int y : {i + 1, i}) wall.push_back({30.0 + kOut * i - kWidth, kHigh * y});
  wall.push_back({30.0 - kWidth, -20.0});
  double of_riser = kWidth, of_tread = 100.0;
  for (int k = 1; k < 30; ++k) {
    const double across = kWidth - kOut * k, up = kHigh * (k - 0.5);
    of_riser = std::min(of_riser, across + up * up / across);
    const double aside = across - 0.5 * kOut, high = kHigh * k;
    of_tread = std::min(of_tread, high + aside * aside / high);
  }
  std::size_t risers = 0, treads = 0;
  for (const WallSample& sample : wall_field({{wall}}, 1e3)) {
    if (sample.at.y < 15.0 || sample.at.y > 45.0) continue;
    const double rings = sample.at.y / kHigh;
    const bool riser = std::abs(rings - std::round(rings)) > 0.25;
    EXPECT_NEAR(sample.thickness_mm, riser ? of_riser : of_tread, 1e-9)
        << sample.at.rho << ", " << sample.at.y;
    ++(riser ? risers : treads);
  }
  EXPECT_EQ(risers, 2u * 150);
  EXPECT_NEAR(static_cast<double>(treads), 2.0 * 150, 2.0);
}

TEST(WallParts, ACylindricalCupHasAWallAndALipOfOneThickness) {
  const Profile cup{{{{0, 0}, {40, 0}, {40, 60}, {36, 60}, {36, 6}, {0, 6}}}};
  const auto parts = walls_by_part(cup, wall_field(cup, 0.5), min_wall(cup), 4.0);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].part, WallPart::wall);
  EXPECT_NEAR(parts[0].thickness_mm, 4.0, 1e-9);
  EXPECT_EQ(parts[1].part, WallPart::lip);
  EXPECT_NEAR(parts[1].thickness_mm, 4.0, 1e-9);
  // Nine diameters of boundary: 36 mm, of which 4 are the flat rim and 16 the wall on each side.
  for (const WallSample& s : wall_field(cup, 0.5))
    EXPECT_EQ(s.part == WallPart::lip, s.at.y > 44.0) << s.at.rho << ", " << s.at.y;
}

TEST(WallParts, AFlangeOutsideAndAThinLipHaveTheirOwnFigures) {
  // A wall of 6 mm, a flange of 2 mm that is 12 mm wide, and a lip of 3 mm that is 20 mm high.
  const Polygon pot{{0, 0},   {40, 0},  {40, 28}, {52, 28}, {52, 30}, {40, 30},
                    {40, 60}, {37, 60}, {37, 80}, {34, 80}, {34, 6},  {0, 6}};
  const Profile profile{{pot}};
  const Wall thinnest = min_wall(profile);
  EXPECT_NEAR(thinnest.thickness_mm, 2.0, 1e-9);
  const auto parts = walls_by_part(profile, wall_field(profile, 0.5), thinnest, 1.99);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_NEAR(parts[0].thickness_mm, 3.0, 0.1);  // the lip below its last 12 mm is wall
  EXPECT_EQ(parts[1].part, WallPart::lip);
  EXPECT_NEAR(parts[1].thickness_mm, 3.0, 1e-9);
  EXPECT_GT(parts[1].at.y, 68.0);
  EXPECT_EQ(parts[2].part, WallPart::flange);
  EXPECT_EQ(parts[2].thickness_mm, 1.99);
  EXPECT_NEAR(parts[2].at.y, 29.0, 1.0 + 1e-9);
  EXPECT_NE(thin_wall_text(profile, 1.99, {1e9, 2.5, "test", {}}).find("thinner: flange"),
            std::string::npos);
}

TEST(WallParts, TheUpwardFaceOfALipIsNoFloor) {
  // A lip of 30 degrees that leans outwards ends in an edge; its inside looks up.
  const Profile profile{
      {{{0, 0}, {40, 0}, {40, 50}, {70, 60}, {70, 60.5}, {36, 54}, {36, 6}, {0, 6}}}};
  const std::string text = thin_wall_text(profile, 0.5, {1e9, 1.5, "test", {}});
  EXPECT_NE(text.find("lip from"), std::string::npos) << text;
  EXPECT_EQ(text.find("floor"), std::string::npos) << text;
}

/// A ring of 0.02 mm on a floor as thick: all of it is lower than 0.05 mm.
TEST(WallText, StatesTheHeightsOfALowPot) {
  const Profile profile{{{{0, 0}, {3, 0}, {3, 0.06}, {2.98, 0.06}, {2.98, 0.02}, {0, 0.02}}}};
  const std::string text = thin_wall_text(profile, 0.02, {1e9, 0.5, "test", {}});
  EXPECT_NE(text.find("floor at a height of 0.02 mm"), std::string::npos) << text;
  EXPECT_EQ(text.find("floor at a height of 0.0 mm"), std::string::npos) << text;
}

TEST(WallText, IsALowerBoundThatDiffersFromAHigherLimit) {
  const auto text = [](double thinnest_mm, double limit_mm) {
    const std::string full = wall_text(thinnest_mm, {1e9, limit_mm, "test", {}});
    return full.substr(0, full.find(" ("));
  };
  EXPECT_EQ(text(4.5379, 3.0), "4.537 mm, expected at least 3.000 mm");
  EXPECT_EQ(text(2.99998, 3.0), "2.99998 mm, expected at least 3.00000 mm");
  EXPECT_EQ(text(0.00034, 0.001), "0.00034 mm, expected at least 0.001 mm");
}

TEST(WallParts, AThinPartKeepsItsDigits) {
  EXPECT_EQ(text_of({{WallPart::lip, 0.00034, {10.0, 25.0}}}),
            "lip 0.00034 mm at a height of 25.0 mm");
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
