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

TEST(CsvDrawing, ReadsTablesWithEmptyCells) {
  const std::vector<glm::dvec2> expected{{30, 0}, {40, 50}};
  for (const char* table :
       {"radius\theight\tnote\n30\t0\t\n40\t50\tthe rim\n",
        "name\tradius\theight\n\t30\t0\nrim\t40\t50\n", "\tradius\theight\n0\t30\t0\n1\t40\t50\n",
        "radius;height;\n30;0;\n40;50\n", "30,0,\n40,50,\n"}) {
    const auto drawing = read_drawing(table, "cup.csv");
    ASSERT_TRUE(drawing) << table << refusal_of(drawing);
    EXPECT_EQ(drawing->lines.at(0).points_mm, expected) << table;
  }
}

TEST(CsvDrawing, ARowOfEmptyCellsIsEmpty) {
  // An empty row as spreadsheets write it: with all separators of its columns.
  for (const char* empty : {";", ";;", "\t", " , ", "\"\";\"\"", ";;\r"}) {
    const std::string row = std::string(empty) + "\n";
    const auto drawing =
        read_drawing(row + "radius;height\n10;0\n20;50\n" + row + "3;4\n5;6\n" + row, "cup.csv");
    ASSERT_TRUE(drawing) << empty << refusal_of(drawing);
    ASSERT_EQ(drawing->lines.size(), 2u) << empty;
    EXPECT_EQ(drawing->lines[0].points_mm, (std::vector<glm::dvec2>{{10, 0}, {20, 50}})) << empty;
    EXPECT_EQ(drawing->lines[1].points_mm, (std::vector<glm::dvec2>{{3, 4}, {5, 6}})) << empty;
  }
}

TEST(CsvDrawing, ErrorsNameTheLine) {
  EXPECT_THAT(refusal_of(read_drawing("10,0\n10,x\n", "cup.csv")), HasSubstr("cup.csv:2: "));
  EXPECT_THAT(refusal_of(read_drawing("10,0\n10\n", "cup.csv")), HasSubstr("cup.csv:2: "));
  EXPECT_THAT(refusal_of(read_drawing("radius\nheight\n10,0\n", "cup.csv")),
              HasSubstr("cup.csv:1: expected columns named radius and height"));
  EXPECT_THAT(refusal_of(read_drawing("10,0,1\n", "cup.csv")), HasSubstr("cup.csv:1: "));
  EXPECT_THAT(refusal_of(read_drawing("10,0\n-1,5\n", "cup.csv")), HasSubstr("found -1"));
  EXPECT_THAT(refusal_of(read_drawing("10,0\nnan,5\n", "cup.csv")), HasSubstr("cup.csv"));
  EXPECT_THAT(refusal_of(read_drawing("10,0\n1e300,5\n", "cup.csv")),
              HasSubstr("cup.csv:2: expected points within 1e+06 mm, found (1e+300, 5)"));
}

TEST(CsvDrawing, RefusesAxisLinesAlone) {
  EXPECT_THAT(refusal_of(section_of("0,0\n0,10\n\n0,20\n0,30\n", "cup.csv")),
              HasSubstr("found only lines on the axis at x = 0 mm"));
}

TEST(CsvDrawing, SkipsAByteOrderMark) {
  for (const char* title : {"", "radius,height\n"}) {
    const auto drawing =
        read_drawing(std::string("\xEF\xBB\xBF") + title + "10,0\n5,20\n", "cup.csv");
    ASSERT_TRUE(drawing) << refusal_of(drawing);
    EXPECT_EQ(drawing->lines.at(0).points_mm, (std::vector<glm::dvec2>{{10, 0}, {5, 20}}));
  }
}

std::vector<glm::dvec2> points_of(const std::string& csv) {
  const auto drawing = read_drawing(csv, "cup.csv");
  EXPECT_TRUE(drawing) << refusal_of(drawing);
  return drawing ? drawing->lines.at(0).points_mm : std::vector<glm::dvec2>();
}

TEST(CsvDrawing, ReadsColumnsByTheirNames) {
  const std::vector<glm::dvec2> points{{25.4, 0}, {12.7, 50.8}};
  for (const char* csv :
       {"radius_mm,height_mm\n25.4,0\n12.7,50.8\n", "height_mm,radius_mm\n0,25.4\n50.8,12.7\n",
        "Height [in], Radius [in]\n0,1\n2,0.5\n",
        "note;y (cm);r (mm)\nfoot;0;25,4\nrim;5,08;12,7\n",
        "\xEF\xBB\xBF\"diameter_in\"\t\"height_in\"\r\n2\t0\r\n1\t2\r\n",
        "Radius [mm];Höhe [mm]\n25.4;0\n12.7;50.8\n",
        "Durchmesser (cm)\tHOEHE\n5,08\t0\n2,54\t50,8\n",
        "Au\u00DFendurchmesser in cm;H\u00F6he in mm\n5,08;0\n2,54;50,8\n",
        "Halbmesser;H\u00F6he\n25,4;0\n12,7;50,8\n", "Radius in in;Height in in\n1;0\n0.5;2\n",
        "outer_radius, height\n25.4,0\n12.7,50.8\n", "x;y\n25,4;0\n12,7;50,8\n",
        "25,4;0\n+12,7;50,8\n", "25,4\t0\n12,7\t50,8\n",
        // As spreadsheets write tables: quotes, a first row, old line ends, Windows-1252.
        "\"radius\",\"height\"\n\"25,4\",\"0\"\n\"12,7\",\"50,8\"\n",
        "sep=;\r\nRadius;Height\r\n25,4;0\r\n12,7;50,8\r\n", "SEP=,\n25.4,0\n12.7,50.8\n",
        "radius;height\r25,4;0\r12,7;50,8\r", "Radius;H\xF6he\r\n25,4;0\r\n12,7;50,8\r\n",
        "au\xDF"
        "en Radius;H\xD6HE\n25,4;0\n12,7;50,8\n"}) {
    const auto found = points_of(csv);
    ASSERT_EQ(found.size(), 2u) << csv;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(found[i].x, points[i].x, 1e-12) << csv;
      EXPECT_NEAR(found[i].y, points[i].y, 1e-12) << csv;
    }
  }
}

TEST(CsvDrawing, ReadsInnerAndOuterRadii) {
  // A cup: solid up to a floor of 5 mm, then a wall of 3 mm.
  const char* const cup = "outer_radius, inner_radius, height\n30,0,0\n30,0,5\n30,27,5\n30,27,60\n";
  const auto section = section_of(cup, "cup.csv");
  ASSERT_TRUE(section) << refusal_of(section);
  EXPECT_NEAR(section->volume_mm3(), std::numbers::pi * (900.0 * 60.0 - 729.0 * 55.0), 1e-6);
  const auto inches = section_of(
      "Inside diameter (in);Height (in);Outside diameter (in)\n"
      "1;0;2\n1;3;2\n",
      "tube.csv");
  ASSERT_TRUE(inches) << refusal_of(inches);
  EXPECT_NEAR(inches->volume_mm3(), std::numbers::pi * 0.75 * 3.0 * 25.4 * 25.4 * 25.4, 1e-6);
  EXPECT_EQ(points_of("Au\xDF"
                      "enradius;Innenradius;H\xF6he\n9;8;0\n"),
            (std::vector<glm::dvec2>{{9, 0}, {8, 0}}));
  EXPECT_THAT(refusal_of(read_drawing("outer radius,inner radius,height\n9,10,0\n", "cup.csv")),
              HasSubstr("cup.csv:2: expected an inner radius up to the outer one of 9 mm"));
}

TEST(CsvDrawing, NamesTheTableOfWallsThatExportWrites) {
  EXPECT_THAT(refusal_of(read_drawing("piece,face,arc_mm,rho_mm,y_mm,thickness_mm,opposite_rho_mm,"
                                      "opposite_y_mm\n0,outer,0.02,34.1,0.02,20.4,32.4,5.6\n",
                                      "w.csv")),
              HasSubstr("the walls of a pot, as export writes them, which are not an outline"));
}

TEST(CsvDrawing, RefusesAmbiguousColumns) {
  for (const char* csv : {"radius,diameter,height\n1,2,3\n", "height,height_mm\n1,2\n",
                          "radius_mm\n1\n", "radius_px,height\n1,2\n", "inner radius,height\n1,2\n",
                          "outer radius,radius,height\n1,2,3\n", "outer,height\n1,2\n",
                          "radius mm cm,height\n1,2\n", "a,b\n1,2\n", "radius,depth\n1,2\n"})
    EXPECT_THAT(refusal_of(read_drawing(csv, "cup.csv")),
                HasSubstr("cup.csv:1: expected columns named radius and height"))
        << csv;
  // Decimal commas between commas are not numbers of two columns.
  EXPECT_THAT(refusal_of(read_drawing("10,5,20,3\n", "cup.csv")), HasSubstr("cup.csv:1: expected"));
  EXPECT_THAT(refusal_of(read_drawing("r,h\n1.000,5;3\n", "cup.csv")), HasSubstr("cup.csv:2: "));
  EXPECT_THAT(refusal_of(read_drawing("r,h\n10,5,2\n", "cup.csv")), HasSubstr("cup.csv:2: "));
}

TEST(CsvDrawing, RefusesTooManyLines) {
  std::string rows;
  for (std::size_t i = 0; i <= kMostLines; ++i) rows += "10,0\n10,1\n\n";
  EXPECT_THAT(refusal_of(read_drawing(rows, "cup.csv")),
              HasSubstr("expected at most 200000 lines"));
}

TEST(CsvDrawing, RefusesAnEmptyDrawing) {
  EXPECT_THAT(refusal_of(read_drawing("", "cup.csv")), HasSubstr("found an empty file"));
  EXPECT_THAT(refusal_of(read_drawing("\xFF\xFE" + std::string("1\0,\0", 4), "cup.csv")),
              HasSubstr("expected a table in UTF-8, found UTF-16"));
  EXPECT_THAT(refusal_of(read_drawing("radius,height\n", "cup.csv")), HasSubstr("no line in it"));
  EXPECT_THAT(refusal_of(read_drawing("1,2\n", "cup.png")),
              HasSubstr("expected a drawing (.svg, .dxf, .csv)"));
}

}  // namespace
}  // namespace clay::importing
