#include "tests/app/import/solids.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clay::importing {
namespace {

using testing::HasSubstr;

TEST(CsvDrawing, ReadsRadiusAndHeightWithAnySeparator) {
  const auto drawing = read_drawing(
      "# a cup\n\nradius,height\n10, 0\n12.5;5\n1e1\t20\n# the rim\n\n3 4\n5 6\n", "cup.csv");
  ASSERT_TRUE(drawing) << refusal_of(drawing);
  ASSERT_EQ(drawing->lines.size(), 2u);
  const std::vector<glm::dvec2> first{{10, 0}, {12.5, 5}, {10, 20}}, second{{3, 4}, {5, 6}};
  EXPECT_EQ(drawing->lines[0].points_mm, first);
  EXPECT_EQ(drawing->lines[1].points_mm, second);
  EXPECT_TRUE(drawing->axis_at_zero);
}

TEST(CsvDrawing, ErrorsNameTheLine) {
  EXPECT_THAT(refusal_of(read_drawing("10,0\n10,x\n", "cup.csv")), HasSubstr("cup.csv:2: "));
  EXPECT_THAT(refusal_of(read_drawing("10,0\n10\n", "cup.csv")), HasSubstr("cup.csv:2: "));
  EXPECT_THAT(refusal_of(read_drawing("radius\nheight\n10,0\n", "cup.csv")),
              HasSubstr("cup.csv:2: "));
  EXPECT_THAT(refusal_of(read_drawing("10,0,1\n", "cup.csv")), HasSubstr("cup.csv:1: "));
  EXPECT_THAT(refusal_of(read_drawing("10,0\n-1,5\n", "cup.csv")), HasSubstr("found -1"));
  EXPECT_THAT(refusal_of(read_drawing("10,0\nnan,5\n", "cup.csv")), HasSubstr("cup.csv"));
  EXPECT_THAT(refusal_of(read_drawing("10,0\n1e300,5\n", "cup.csv")),
              HasSubstr("cup.csv:2: expected points within 1e+06 mm, found (1e+300, 5)"));
}

TEST(CsvDrawing, SkipsAByteOrderMark) {
  for (const char* title : {"", "radius,height\n"}) {
    const auto drawing =
        read_drawing(std::string("\xEF\xBB\xBF") + title + "10,0\n5,20\n", "cup.csv");
    ASSERT_TRUE(drawing) << refusal_of(drawing);
    EXPECT_EQ(drawing->lines.at(0).points_mm, (std::vector<glm::dvec2>{{10, 0}, {5, 20}}));
  }
}

TEST(CsvDrawing, RefusesTooManyLines) {
  std::string rows;
  for (std::size_t i = 0; i <= kMostLines; ++i) rows += "10,0\n10,1\n\n";
  EXPECT_THAT(refusal_of(read_drawing(rows, "cup.csv")),
              HasSubstr("expected at most 200000 lines"));
}

TEST(CsvDrawing, RefusesAnEmptyDrawing) {
  EXPECT_THAT(refusal_of(read_drawing("", "cup.csv")), HasSubstr("no line in it"));
  EXPECT_THAT(refusal_of(read_drawing("radius,height\n", "cup.csv")), HasSubstr("no line in it"));
  EXPECT_THAT(refusal_of(read_drawing("1,2\n", "cup.png")), HasSubstr("NAME.svg"));
}

}  // namespace
}  // namespace clay::importing
