#include "tests/app/import/solids.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace clay::importing {
namespace {

using testing::HasSubstr;
constexpr double kPi = std::numbers::pi;

/// Group codes and values, two lines each.
std::string groups(const std::vector<std::pair<int, std::string>>& pairs) {
  std::string text;
  for (const auto& [code, value] : pairs) text += fmt::format("{:3}\n{}\n", code, value);
  return text;
}

std::string line(glm::dvec2 a, glm::dvec2 b) {
  return groups({{0, "LINE"},
                 {8, "0"},
                 {10, fmt::format("{}", a.x)},
                 {20, fmt::format("{}", a.y)},
                 {11, fmt::format("{}", b.x)},
                 {21, fmt::format("{}", b.y)}});
}

std::string file(const std::string& entities, int unit = 4) {
  return groups({{0, "SECTION"},
                 {2, "HEADER"},
                 {9, "$INSUNITS"},
                 {70, std::to_string(unit)},
                 {0, "ENDSEC"},
                 {0, "SECTION"},
                 {2, "ENTITIES"}}) +
         entities + groups({{0, "ENDSEC"}, {0, "EOF"}});
}

/// Semi-axes of 60 mm upward and 30 mm, between two parameters [rad].
std::string upright_ellipse(const std::string& from, const std::string& to) {
  return groups({{0, "ELLIPSE"},
                 {8, "0"},
                 {10, "0"},
                 {20, "0"},
                 {11, "0"},
                 {21, "60"},
                 {40, "0.5"},
                 {41, from},
                 {42, to}});
}

const HalfSectionSettings kLeft{AxisRule::left, 0.0, {}};

double volume_of(const std::string& bytes) {
  const auto section = section_of(bytes, "pot.dxf", kLeft);
  EXPECT_TRUE(section) << refusal_of(section);
  return section ? section->volume_mm3() : 0.0;
}

TEST(DxfDrawing, JoinsLinesInAnyOrderAndDirection) {
  const std::string cone = line({40, 0}, {0, 0}) + line({0, 90}, {20, 90}) +
                           line({0, 90.004}, {0, 0}) + line({40, 0}, {20, 90});
  EXPECT_NEAR(volume_of(file(cone)), kPi * 90.0 / 3.0 * (1600.0 + 800.0 + 400.0), 0.01 * 90 * 50);
}

/// LF, CR LF, and the CR of old Macintosh programs.
TEST(DxfDrawing, ReadsEveryEndOfLine) {
  const std::string box = file(line({0, 0}, {1, 0}) + line({1, 0}, {1, 2}) + line({1, 2}, {0, 2}) +
                               line({0, 2}, {0, 0}));
  for (const std::string end : {"\n", "\r\n", "\r", "\r\r\n"}) {
    std::string text;
    for (const char c : box) text += c == '\n' ? end : std::string(1, c);
    EXPECT_NEAR(volume_of(text), 2.0 * kPi, 1e-9) << testing::PrintToString(end);
    text.replace(text.find("10"), 2, "x0");
    EXPECT_THAT(refusal_of(read_drawing(text, "pot.dxf")), HasSubstr("pot.dxf:19: expected"))
        << testing::PrintToString(end);
  }
}

TEST(DxfDrawing, ACircleIsABall) {
  // For any number of chords.
  for (const double radius : {10.0, 20.0, 33.3, 50.0}) {
    const auto section = section_of(
        file(groups({{0, "CIRCLE"}, {10, "20"}, {20, "5"}, {40, fmt::format("{}", radius)}})),
        "pot.dxf");
    ASSERT_TRUE(section) << refusal_of(section);
    EXPECT_EQ(section->axis, AxisRule::middle) << radius;
    EXPECT_NEAR(section->axis_mm, 20.0, 1e-9);
    EXPECT_NEAR(section->height_mm, 2.0 * radius, 1e-9);
    EXPECT_NEAR(section->volume_mm3(), 4.0 / 3.0 * kPi * radius * radius * radius,
                kFlatMm * 4.0 * kPi * radius * radius);
  }
}

TEST(DxfDrawing, AppliesItsUnits) {
  const std::string box =
      line({0, 0}, {1, 0}) + line({1, 0}, {1, 2}) + line({1, 2}, {0, 2}) + line({0, 2}, {0, 0});
  for (const auto& [unit, mm] : {std::pair{0, 1.0}, {1, 25.4}, {4, 1.0}, {5, 10.0}, {6, 1000.0}})
    EXPECT_NEAR(volume_of(file(box, unit)) / (mm * mm * mm), 2.0 * kPi, 1e-9) << unit;
  EXPECT_THAT(refusal_of(read_drawing(file(box, 13), "pot.dxf")), HasSubstr("$INSUNITS"));
}

/// Half of a cup, 80 mm wide and 100 mm high, with a wall and a floor of 5 mm, beside its axis; in
/// a file without a unit.
std::string cup_in(double mm_per_unit) {
  const std::vector<glm::dvec2> corners{{0, 0},    {40, 0}, {40, 100}, {35, 100},
                                        {35, 5.0}, {0, 5},  {0, 0}};
  std::string lines;
  for (std::size_t i = 1; i < corners.size(); ++i)
    lines += line(corners[i - 1] / mm_per_unit, corners[i] / mm_per_unit);
  return file(lines, 0);
}

TEST(DxfDrawing, HeightGivesThePotOfADrawingInAnyUnit) {
  const double volume = kPi * (40.0 * 40.0 * 100.0 - 35.0 * 35.0 * 95.0);
  for (const double mm_per_unit : {1000.0, 25.4, 1.0, 1e-3}) {
    const auto section =
        read_half_section(cup_in(mm_per_unit), "cup.dxf", "", {AxisRule::by_itself, 0.0, 100.0});
    ASSERT_TRUE(section) << refusal_of(section);
    EXPECT_NEAR(section->volume_mm3(), volume, 1e-6 * volume) << mm_per_unit;
    EXPECT_NEAR(section->height_mm, 100.0, 1e-9) << mm_per_unit;
    EXPECT_EQ(section->axis, AxisRule::left) << mm_per_unit;
    EXPECT_NEAR(section->axis_mm, 0.0, 1e-9) << mm_per_unit;
    EXPECT_TRUE(section->notes.empty()) << mm_per_unit;
  }
}

TEST(DxfDrawing, AxisOfADrawingInMetresIsInTheCoordinatesOfTheFile) {
  const auto section =
      read_half_section(cup_in(1000.0), "cup.dxf", "", {AxisRule::at, 0.02, 100.0});
  ASSERT_TRUE(section) << refusal_of(section);
  const double volume = kPi * (20.0 * 20.0 * 100.0 - 15.0 * 15.0 * 95.0);
  EXPECT_NEAR(section->volume_mm3(), volume, 1e-6 * volume);
  EXPECT_NEAR(section->axis_mm, 0.02, 1e-12);
}

TEST(DxfDrawing, HeightMakesChordsFitThePot) {
  const std::string arc = file(
      groups({{0, "ARC"}, {8, "0"}, {10, "0"}, {20, "0"}, {40, "0.03"}, {50, "270"}, {51, "90"}}),
      0);
  const auto ball = read_half_section(arc, "ball.dxf", "", {AxisRule::left, 0.0, 60.0});
  ASSERT_TRUE(ball) << refusal_of(ball);
  EXPECT_NEAR(ball->volume_mm3(), 4.0 / 3.0 * kPi * 27000.0, kFlatMm * 4.0 * kPi * 900.0);
}

TEST(DxfDrawing, BulgeOfOneIsAHalfCircle) {
  const std::string polyline = groups({{0, "LWPOLYLINE"},
                                       {100, "AcDbEntity"},
                                       {8, "0"},
                                       {100, "AcDbPolyline"},
                                       {90, "2"},
                                       {70, "1"},
                                       {10, "0"},
                                       {20, "0"},
                                       {42, "1"},
                                       {10, "0"},
                                       {20, "60"},
                                       {42, "0"}});
  EXPECT_NEAR(volume_of(file(polyline)), 4.0 / 3.0 * kPi * 27000.0, kFlatMm * 4.0 * kPi * 900.0);
}

TEST(DxfDrawing, ArcsCirclesAndEllipsesAreRound) {
  const auto arc =
      groups({{0, "ARC"}, {8, "0"}, {10, "0"}, {20, "30"}, {40, "30"}, {50, "270"}, {51, "90"}});
  EXPECT_NEAR(volume_of(file(arc)), 4.0 / 3.0 * kPi * 27000.0, kFlatMm * 4.0 * kPi * 900.0);
  const auto circle = groups({{0, "CIRCLE"}, {8, "0"}, {10, "50"}, {20, "30"}, {40, "10"}});
  // A torus by Pappus's theorem; it does not touch the axis, so the axis must be given.
  const auto torus = section_of(file(circle), "pot.dxf", {AxisRule::at, 0.0, {}});
  ASSERT_TRUE(torus) << refusal_of(torus);
  EXPECT_NEAR(torus->volume_mm3(), 2.0 * kPi * 50.0 * kPi * 100.0, kFlatMm * 4 * kPi * kPi * 500);
  const auto ellipse = upright_ellipse(fmt::format("{}", kPi), fmt::format("{}", 2.0 * kPi));
  EXPECT_NEAR(volume_of(file(ellipse)), 4.0 / 3.0 * kPi * 900.0 * 60.0, kFlatMm * 1e5);
}

TEST(DxfDrawing, AFullTurnMayBeWrittenWithFewDigits) {
  // As "%f", "%g" and shorter formats write two pi, and 360 degrees with an error of float32.
  for (const char* end : {"6.283185", "6.28319", "6.2832"}) {
    const auto ellipse = upright_ellipse("0", end);
    const auto section = section_of(file(ellipse), "pot.dxf", {AxisRule::middle, 0.0, {}});
    ASSERT_TRUE(section) << end << refusal_of(section);
    EXPECT_NEAR(section->volume_mm3(), 4.0 / 3.0 * kPi * 900.0 * 60.0, kFlatMm * 1e5) << end;
  }
  const auto circle = groups(
      {{0, "ARC"}, {8, "0"}, {10, "0"}, {20, "30"}, {40, "30"}, {50, "0"}, {51, "360.00003"}});
  const auto ball = section_of(file(circle), "pot.dxf", {AxisRule::middle, 0.0, {}});
  ASSERT_TRUE(ball) << refusal_of(ball);
  EXPECT_NEAR(ball->volume_mm3(), 4.0 / 3.0 * kPi * 27000.0, kFlatMm * 4.0 * kPi * 900.0);
}

TEST(DxfDrawing, ABulgeOfAlmostNothingIsStraight) {
  // A cylinder of radius 40 and height 80. The square of the radius of the last bulge exceeds the
  // range of a double.
  for (const char* bulge : {"1e-9", "1e-100", "1e-300"}) {
    const auto polyline = groups({{0, "LWPOLYLINE"},
                                  {8, "0"},
                                  {90, "4"},
                                  {70, "1"},
                                  {10, "0"},
                                  {20, "0"},
                                  {10, "40"},
                                  {20, "0"},
                                  {42, bulge},
                                  {10, "40"},
                                  {20, "80"},
                                  {10, "0"},
                                  {20, "80"}});
    EXPECT_NEAR(volume_of(file(polyline)), kPi * 1600.0 * 80.0, 1e-3) << bulge;
  }
}

using Groups = std::vector<std::pair<int, std::string>>;

/// A quarter circle of radius 30 from (30, 0) to (0, 30), exactly: its groups up to the knots.
const Groups kQuarter = {{0, "SPLINE"}, {8, "0"},  {70, "4"}, {71, "2"}, {72, "6"},
                         {73, "3"},     {74, "0"}, {40, "0"}, {40, "0"}, {40, "0"},
                         {40, "1"},     {40, "1"}, {40, "1"}};
const std::vector<Groups> kQuarterPoints = {{{10, "30"}, {20, "0"}, {30, "0"}},
                                            {{10, "30"}, {20, "30"}, {30, "0"}},
                                            {{10, "0"}, {20, "30"}, {30, "0"}}};
const std::vector<Groups> kQuarterWeights = {
    {{41, "1"}}, {{41, "0.7071067811865476"}}, {{41, "1"}}};

std::string spline_of_parts(const std::vector<Groups>& parts) {
  std::string text = groups(kQuarter);
  for (const Groups& part : parts) text += groups(part);
  return text;
}

/// FreeCAD and ezdxf write all weights before the control points; others each after its point.
TEST(DxfDrawing, RationalSplineReproducesItsCircleWhereverItsWeightsStand) {
  const auto& p = kQuarterPoints;
  const auto& w = kQuarterWeights;
  const std::vector<std::vector<Groups>> orders = {{p[0], w[0], p[1], w[1], p[2], w[2]},
                                                   {w[0], w[1], w[2], p[0], p[1], p[2]},
                                                   {p[0], p[1], p[2], w[0], w[1], w[2]}};
  for (std::size_t order = 0; order < orders.size(); ++order) {
    const std::string spline = spline_of_parts(orders[order]);
    const auto drawing = read_drawing(file(spline), "pot.dxf");
    ASSERT_TRUE(drawing) << refusal_of(drawing);
    ASSERT_EQ(drawing->lines.size(), 1u);
    for (const glm::dvec2& point : drawing->lines[0].points_mm)
      EXPECT_NEAR(std::hypot(point.x, point.y), 30.0, 1e-9) << order;
    EXPECT_NEAR(volume_of(file(spline)), 2.0 / 3.0 * kPi * 27000.0, kFlatMm * 2.0 * kPi * 900.0)
        << order;
  }
}

TEST(DxfDrawing, RefusesWeightsOfSomeControlPointsOnly) {
  const auto& p = kQuarterPoints;
  const auto& w = kQuarterWeights;
  for (const std::vector<Groups>& parts :
       {std::vector{w[0], w[1], p[0], p[1], p[2]}, {p[0], p[1], p[2], w[0], w[1], w[2], w[0]}})
    EXPECT_THAT(refusal_of(read_drawing(file(spline_of_parts(parts)), "pot.dxf")),
                HasSubstr("SPLINE: expected a weight for each of 3 control points or none, found " +
                          std::to_string(parts.size() - 3) + " weights"));
}

TEST(DxfDrawing, RefusesBrokenSplinesAndOtherFiles) {
  const auto spline = groups({{0, "SPLINE"},
                              {8, "0"},
                              {71, "3"},
                              {72, "1"},
                              {73, "2"},
                              {40, "0"},
                              {10, "1"},
                              {20, "2"},
                              {10, "3"},
                              {20, "4"}});
  EXPECT_THAT(refusal_of(read_drawing(file(spline), "pot.dxf")), HasSubstr("expected splines"));
  // All knots are equal: the spline has no length, and would be left out without a message.
  const auto none = groups({{0, "SPLINE"},
                            {8, "0"},
                            {71, "1"},
                            {40, "0"},
                            {40, "0"},
                            {40, "0"},
                            {40, "0"},
                            {10, "1"},
                            {20, "2"},
                            {10, "3"},
                            {20, "4"}});
  EXPECT_THAT(refusal_of(read_drawing(file(none + line({0, 0}, {9, 9})), "pot.dxf")),
              HasSubstr("expected splines"));
  EXPECT_THAT(refusal_of(read_drawing("no drawing\n", "pot.dxf")),
              HasSubstr("pot.dxf:1: expected a DXF group code, found \"no drawing\""));
  EXPECT_THAT(refusal_of(read_drawing("", "pot.dxf")), HasSubstr("found an empty file"));
}

}  // namespace
}  // namespace clay::importing
