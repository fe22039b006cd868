#include "tests/app/import/solids.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace clay::importing {
namespace {

using testing::HasSubstr;

std::string refused(const std::string& csv) { return refusal_of(section_of(csv, "pot.csv")); }

TEST(HalfSection, OpenLineIsTheOutsideOfASolidPot) {
  const auto cone = section_of("40,0\n20,90\n", "pot.csv");
  ASSERT_TRUE(cone) << refusal_of(cone);
  EXPECT_NEAR(cone->volume_mm3(), std::numbers::pi * 90.0 / 3.0 * (1600.0 + 800.0 + 400.0), 1e-6);
}

TEST(HalfSection, TubeBoreStartsAtTheFoot) {
  const auto tube = section_of("20,0\n30,0\n30,10\n20,10\n20,0\n", "pot.csv");
  ASSERT_TRUE(tube) << refusal_of(tube);
  EXPECT_NEAR(tube->volume_mm3(), std::numbers::pi * 500.0 * 10.0, 1e-6);
  EXPECT_EQ(tube->axis_mm, 0.0);
}

TEST(HalfSection, ErrorsNameThePlace) {
  // A wall that folds over: between 10 and 20 mm there are two walls.
  EXPECT_THAT(refused("0,0\n40,0\n40,20\n30,10\n20,10\n20,30\n0,30\n"), HasSubstr("in one place"));
  EXPECT_THAT(refused("0,0\n10,0\n10,5\n0,5\n0,0\n\n0,8\n10,8\n10,9\n0,9\n0,8\n"),
              HasSubstr("expected clay around the axis at every height, found none from 5.000 to "
                        "8.000 mm above the foot"));
  EXPECT_THAT(refused("10,0\n10,5\n\n20,7\n20,9\n"), HasSubstr("a single open one"));
  EXPECT_THAT(refused("10,5\n20,5\n"),
              HasSubstr("0 mm high; z is ignored: export the sketch in its own plane"));
}

TEST(HalfSection, RefusesOutlinesThatCrossThemselvesAndNamesThePlace) {
  // A crossing between corners, a corner on a corner, a corner on an edge, a level line over
  // another, and a level line across an edge.
  EXPECT_THAT(refused("5,0\n25,20\n5,20\n25,0\n5,0\n"),
              HasSubstr("15.000 mm from the axis and 10.000 mm above the foot: expected an outline "
                        "that does not cross"));
  for (const char* csv : {"10,0\n30,0\n20,10\n30,20\n10,20\n20,10\n10,0\n",
                          "0,0\n20,0\n20,20\n30,20\n30,10\n20,10\n20,10\n0,10\n",
                          "0,0\n30,0\n30,10\n10,10\n20,10\n20,20\n0,20\n",
                          "20,0\n30,0\n30,10\n10,10\n10,20\n20,20\n20,0\n"})
    EXPECT_THAT(refused(csv),
                testing::AnyOf(HasSubstr("10.000 mm above the foot: expected an outline "
                                         "that does not cross or touch itself"),
                               HasSubstr("expected clay in one place")))
        << csv;
  EXPECT_THAT(refused("10,0\n30,0\n20,10\n30,20\n10,20\n20,10\n10,0\n"),
              HasSubstr("20.000 mm from the axis and 10.000 mm above the foot"));
}

TEST(HalfSection, ReportsClayLeftOfTheAxisThatIsNotUsed) {
  const auto notes_of = [](const char* csv, double axis_mm) {
    return section_of(csv, "pot.csv", {AxisRule::at, axis_mm, {}}).value().notes;
  };
  const char* const square = "0,0\n40,0\n40,20\n0,20\n0,0\n";
  EXPECT_TRUE(notes_of(square, 0.0).empty());
  EXPECT_TRUE(notes_of(square, 20.0).empty()) << "mirrored";
  const auto notes = notes_of(square, 10.0);
  ASSERT_EQ(notes.size(), 1u);
  // 100 pi 20 mm3 and 900 pi 20 mm3.
  EXPECT_THAT(notes[0], HasSubstr("left of the axis (6.3 cm3 as clay)"));
  EXPECT_THAT(notes[0], HasSubstr("right of it (56.5 cm3)"));
}

TEST(HalfSection, ClayLeftOfTheAxisHasNoPartInFootAndHeight) {
  // A frustum, beside a triangle that begins lower or ends higher.
  const Line frustum{{{0, 0}, {40, 0}, {45, 80}, {0, 80}}, true};
  const double volume = std::numbers::pi * 80.0 / 3.0 * (1600.0 + 1800.0 + 2025.0);
  for (const double end : {-20.0, 230.0}) {
    const Line left{{{-30, 20}, {-10, 20}, {-20, end}}, true};
    for (const double scale : {1.0, 2.0}) {
      const auto section =
          half_section({{frustum, left}, false}, {AxisRule::at, 0.0, 80.0 * scale}, "pot");
      ASSERT_TRUE(section) << refusal_of(section);
      EXPECT_EQ(section->slabs.front().from_mm, 0.0);
      EXPECT_NEAR(section->height_mm, 80.0 * scale, 1e-9);
      EXPECT_NEAR(section->volume_mm3(), volume * scale * scale * scale, 1e-6 * volume);
    }
  }
}

TEST(HalfSection, AnOutlineOpenTowardsItsAxisIsNoDrawingOfBothHalves) {
  // Its corners alone are symmetric about x = 20 mm.
  const double volume = std::numbers::pi * 1600.0 * 80.0;
  for (const double axis : {0.0, -7.0}) {
    const Line outside{{{axis, 0}, {axis + 40, 0}, {axis + 40, 80}, {axis, 80}}, false};
    const auto section = half_section({{outside}, false}, {}, "pot");
    ASSERT_TRUE(section) << refusal_of(section);
    EXPECT_EQ(section->axis, AxisRule::left);
    EXPECT_EQ(section->axis_mm, axis);
    EXPECT_NEAR(section->volume_mm3(), volume, 1e-6);
  }
  // Both halves of the outside of the same pot, open at the rim.
  const Line both{{{-40, 80}, {-40, 0}, {40, 0}, {40, 80}}, false};
  const auto section = half_section({{both}, false}, {}, "pot");
  ASSERT_TRUE(section) << refusal_of(section);
  EXPECT_EQ(section->axis, AxisRule::middle);
  EXPECT_NEAR(section->volume_mm3(), volume, 1e-6);
}

TEST(HalfSection, AShapeOfNoSizeDrawsNothing) {
  const Line frustum{{{0, 0}, {40, 0}, {45, 80}, {0, 80}}, true};
  const Line point{{{-50, -30}, {-50, -30}, {-50, -30}}, true};
  const auto section = half_section({{frustum, point}, false}, {}, "pot");
  ASSERT_TRUE(section) << refusal_of(section);
  EXPECT_EQ(section->axis_mm, 0.0);
  EXPECT_EQ(section->height_mm, 80.0);
  EXPECT_TRUE(section->notes.empty());
  EXPECT_EQ(refusal_of(half_section({{point}, false}, {}, "pot")),
            "pot: expected the outline of a pot, found only points in it");
}

TEST(HalfSection, RecognisesAnAxisLineAnywhere) {
  const std::vector<glm::dvec2> cone{{40, 0}, {20, 90}};
  const double volume = std::numbers::pi * 90.0 / 3.0 * (1600.0 + 800.0 + 400.0);
  const auto lines_with = [&](std::vector<glm::dvec2> outline, double axis) {
    for (glm::dvec2& p : outline) p.x += axis;
    return Drawing{{{outline, false}, {{{axis, -15}, {axis, 40}, {axis, 120}}, false}}, false};
  };
  for (const double axis : {0.0, 13.5, -200.0}) {
    const auto half = half_section(lines_with(cone, axis), {}, "pot");
    ASSERT_TRUE(half) << refusal_of(half);
    EXPECT_EQ(half->axis, AxisRule::line);
    EXPECT_EQ(half->axis_mm, axis);
    EXPECT_NEAR(half->height_mm, 90.0, 1e-9);
    EXPECT_NEAR(half->volume_mm3(), volume, 1e-6);
    Drawing both = lines_with({{-20, 90}, {-40, 0}, {40, 0}, {20, 90}}, axis);
    both.lines[0].closed = true;
    const auto closed = half_section(both, {}, "pot");
    ASSERT_TRUE(closed) << refusal_of(closed);
    EXPECT_NEAR(closed->volume_mm3(), volume, 1e-6);
  }
  Drawing two = lines_with(cone, 0.0);
  two.lines.push_back({{{70, 0}, {70, 10}}, false});
  EXPECT_THAT(refusal_of(half_section(two, {}, "pot")), HasSubstr("expected one axis line"));
}

/// The half section of a cup: a solid floor and a wall between two radii. `at_axis_mm`: the floor's
/// height there.
Line cup(double floor_mm, double at_axis_mm) {
  return {{{0, 0}, {30, 0}, {30, 60}, {27, 60}, {27, floor_mm}, {0, at_axis_mm}}, true};
}

Drawing turned(Line line, double axis_mm) {
  for (glm::dvec2& p : line.points_mm) p.x = axis_mm - p.x;
  return {{line}, false};
}

TEST(HalfSection, LevelsAFloorThatRisesWithinTheTolerance) {
  const double volume = std::numbers::pi * (900.0 * 60.0 - 729.0 * 55.0);
  for (const double rise : {-0.01, 0.0, 0.01, 0.019}) {
    const auto section = half_section({{cup(5.0, 5.0 + rise)}, true}, {}, "pot");
    ASSERT_TRUE(section) << rise << refusal_of(section);
    // A change of the floor by the tolerance at most.
    EXPECT_NEAR(section->volume_mm3(), volume, std::numbers::pi * 729.0 * kLevelWithinMm);
    EXPECT_EQ(section->height_mm, 60.0);
  }
  // Broken into pieces, of which the highest is in the middle.
  Line pieces = cup(5.0, 5.0);
  pieces.points_mm.insert(pieces.points_mm.end() - 1, {{20, 5.008}, {10, 5.012}, {5, 5.004}});
  ASSERT_TRUE(half_section({{pieces}, true}, {}, "pot"));
  EXPECT_THAT(
      refusal_of(half_section({{cup(5.0, 6.0)}, true}, {}, "pot")),
      HasSubstr("5.500 mm above the foot: expected clay in one place, between a bore or the "
                "axis and the outside, found it from the axis to 13.500 mm and from 27.000 "
                "to 30.000 mm: the floor rises towards the axis"));
}

TEST(HalfSection, NamesWhyThereAreTwoWalls) {
  // A lip that hangs over.
  EXPECT_THAT(refused("0,0\n30,0\n30,50\n36,40\n36,60\n27,60\n27,5\n0,5\n0,0\n"),
              HasSubstr("found it from 27.000 to 30.000 mm and from 33.000 to 36.000 mm: the wall "
                        "or the rim overhangs"));
  EXPECT_THAT(refused("0,0\n10,0\n10,5\n0,5\n0,0\n\n20,0\n30,0\n30,5\n20,5\n20,0\n"),
              HasSubstr("hide a frame or background"));
  // Both halves, by a hand that is 0.2 mm off.
  Line both{{{0, 0}, {60, 0}, {62, 60}, {59, 60}, {57, 5}, {3, 5}, {1, 60}, {-2.2, 60}}, true};
  EXPECT_THAT(
      refusal_of(half_section({{both}, false}, {}, "pot")),
      HasSubstr("the drawing is nearly symmetric about x = 29.9 mm: with the axis in its middle"));
  EXPECT_TRUE(half_section({{both}, false}, {AxisRule::middle, 0.0, {}}, "pot"));
}

TEST(HalfSection, NamesTheNarrowestGap) {
  EXPECT_THAT(refused("0,0\n30,0\n30,60\n27,60\n\n27.03,59.96\n27,5\n0,5\n"),
              HasSubstr("found a gap of 0.050 mm between the ends at (27.030, 59.960) and (27.000, "
                        "60.000) mm from axis and foot"));
}

TEST(HalfSection, TurnsAnOutlineLeftOfItsAxis) {
  const double volume = std::numbers::pi * (900.0 * 60.0 - 729.0 * 55.0);
  Line leaning = cup(5.0, 5.0);
  leaning.points_mm[2].x = 32.0;  // no edge at its far end
  const double more = half_section({{leaning}, true}, {}, "pot")->volume_mm3();
  const auto edge = half_section(turned(leaning, 80.0), {}, "pot");
  ASSERT_TRUE(edge) << refusal_of(edge);
  EXPECT_EQ(edge->axis, AxisRule::right);
  EXPECT_EQ(edge->axis_mm, 80.0);
  EXPECT_TRUE(edge->notes.empty());
  EXPECT_NEAR(edge->volume_mm3(), more, 1e-6);

  Drawing with_line = turned(cup(5.0, 5.0), 80.0);
  const auto asked = half_section(with_line, {AxisRule::at, 80.0, {}}, "pot");
  ASSERT_TRUE(asked) << refusal_of(asked);
  EXPECT_NEAR(asked->volume_mm3(), volume, 1e-6);
  with_line.lines.push_back({{{80, -5}, {80, 70}}, false});
  const auto line = half_section(with_line, {}, "pot");
  ASSERT_TRUE(line) << refusal_of(line);
  EXPECT_EQ(line->axis, AxisRule::line);
  EXPECT_NEAR(line->volume_mm3(), volume, 1e-6);
}

TEST(HalfSection, WarnsOfAnAxisThroughACorner) {
  // The wall of a vase without a floor.
  const Line wall{{{130, 0}, {145, 50}, {125, 100}, {122, 100}, {142, 50}, {127, 0}}, true};
  const auto section = half_section({{wall}, false}, {}, "pot");
  ASSERT_TRUE(section) << refusal_of(section);
  ASSERT_EQ(section->notes.size(), 1u);
  EXPECT_THAT(section->notes[0], HasSubstr("found only a corner at the left end, x = 122 mm"));
  EXPECT_TRUE(half_section({{wall}, false}, {AxisRule::at, 100.0, {}}, "pot")->notes.empty());
  const Line open{{{0, 0}, {40, 0}, {20, 90}}, false};
  EXPECT_TRUE(half_section({{open}, false}, {}, "pot")->notes.empty());
  // The outside of a wall, drawn without an axis: its foot is no point of the axis.
  const Line outside{{{130, 0}, {145, 30}, {140, 80}, {142, 100}}, false};
  const auto spike = half_section({{outside}, false}, {}, "pot");
  ASSERT_TRUE(spike) << refusal_of(spike);
  ASSERT_EQ(spike->notes.size(), 1u);
  EXPECT_THAT(spike->notes[0], HasSubstr("found only a corner at the left end, x = 130 mm"));
}

TEST(HalfSection, HeightOptionScalesUniformly) {
  const auto cone = section_of("40,10\n20,100\n", "pot.csv", {AxisRule::by_itself, 0.0, 45.0});
  ASSERT_TRUE(cone) << refusal_of(cone);
  EXPECT_NEAR(cone->height_mm, 45.0, 1e-12);
  EXPECT_NEAR(cone->volume_mm3(), std::numbers::pi * 45.0 / 3.0 * (400.0 + 200.0 + 100.0), 1e-6);
}

/// A cup by its two sides: arbitrary outer radii and wall thicknesses, and a floor.
RC_GTEST_PROP(HalfSection, VolumeFollowsPappus, ()) {
  const auto count = *rc::gen::inRange<std::size_t>(2, 30);
  std::vector<glm::dvec2> outer, inner;
  double height = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = 0.01 * *rc::gen::inRange(500, 9000);
    outer.emplace_back(radius, height);
    inner.emplace_back(radius * 0.01 * *rc::gen::inRange(1, 99), height);
    height += 0.01 * *rc::gen::inRange(1, 2000);
  }
  Line line{outer, true};
  line.points_mm.insert(line.points_mm.end(), inner.rbegin(), inner.rend());
  const std::vector<glm::dvec2> polygon = line.points_mm;
  const auto section = half_section({{line}, true}, {}, "cup");
  RC_ASSERT(section.has_value());
  RC_ASSERT(std::abs(section->volume_mm3() / swept_mm3(polygon) - 1.0) < 1e-12);
}

}  // namespace
}  // namespace clay::importing
