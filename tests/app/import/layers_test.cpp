#include "app/import/readers.hpp"
#include "tests/app/import/solids.hpp"
#include "tests/fuzz/drawing_promise.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clay::importing {
namespace {

using testing::HasSubstr;

const std::string kSvg =
    "<svg xmlns='http://www.w3.org/2000/svg' xmlns:inkscape='http://www.inkscape.org/namespaces/"
    "inkscape'><g inkscape:groupmode='layer' inkscape:label='Pot' id='layer1'>"
    "<path d='M 0 0 H 30 V 60 H 0 Z'/></g><g inkscape:groupmode='layer' inkscape:label='Lid' "
    "id='layer2'><path d='M 0 0 H 30 V 20 H 0 Z'/><path d='M 50 0 H 80 V 20 H 0 Z'/></g>"
    "<g inkscape:groupmode='layer' inkscape:label='Construction lines'><path d='M 3 4 V "
    "9'/></g></svg>";

const std::string kDxf = samples::dxf_of(
    "0 SECTION 2 BLOCKS 0 BLOCK 2 b 0 LINE 8 0 10 0 20 0 11 9 21 9 0 LINE 8 Lid 10 0 20 0 11 5 21 "
    "5 0 "
    "ENDBLK 0 ENDSEC 0 SECTION 2 ENTITIES 0 INSERT 8 Pot 2 b 0 LINE 8 Lid 10 0 20 0 11 8 21 8 0 "
    "ENDSEC 0 EOF");

std::size_t lines_of(const std::string& bytes, const std::string& name, const std::string& layer) {
  const auto drawing = read_drawing(bytes, name, layer);
  EXPECT_TRUE(drawing) << refusal_of(drawing);
  return drawing ? drawing->lines.size() : 0;
}

TEST(Layers, OneOrAll) {
  EXPECT_EQ(lines_of(kSvg, "a.svg", ""), 3u);
  EXPECT_EQ(lines_of(kSvg, "a.svg", "Pot"), 1u);
  EXPECT_EQ(lines_of(kSvg, "a.svg", "layer2"), 2u);
  EXPECT_EQ(lines_of(kSvg, "a.svg", "Construction lines"), 1u);
  EXPECT_EQ(lines_of(kSvg, "a.svg", "pot"), 1u);
  EXPECT_EQ(lines_of(kDxf, "a.dxf", ""), 3u);
  EXPECT_EQ(lines_of(kDxf, "a.dxf", "pot"), 1u);
  EXPECT_EQ(lines_of(kDxf, "a.dxf", "LID"), 2u);
}

TEST(Layers, IgnoresConstructionLayersByDefault) {
  for (const char* layer : {"Construction", "construction_2", "CONSTRUCTION LINES"}) {
    const std::string name = layer;
    const std::string svg = "<svg xmlns='http://www.w3.org/2000/svg'><path d='M 0 0 H 9'/><g id='" +
                            name + "'><path d='M 3 4 V 9'/></g></svg>";
    EXPECT_EQ(lines_of(svg, "a.svg", ""), 1u) << name;
    EXPECT_EQ(lines_of(svg, "a.svg", name), 1u) << name;
    const std::string dxf =
        "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nPot\n10\n0\n20\n0\n11\n8\n21\n8\n0\nLINE\n8\n" +
        name + "\n10\n0\n20\n0\n11\n5\n21\n8\n0\nENDSEC\n0\nEOF\n";
    EXPECT_EQ(lines_of(dxf, "a.dxf", ""), 1u) << name;
    EXPECT_EQ(lines_of(dxf, "a.dxf", name), 1u) << name;
    EXPECT_EQ(lines_of(dxf, "a.dxf", "pot"), 1u) << name;
  }
  EXPECT_TRUE(for_construction("Construction"));
  EXPECT_FALSE(for_construction("Constructio"));
  EXPECT_FALSE(for_construction("under construction"));
}

/// In UTF-8, and in Windows-1252, as programs of Western Europe wrote before AutoCAD 2007.
TEST(Layers, NamesWithUmlautsAreFoundInBothEncodings) {
  for (const char* umlaut : {"\u00DF", "\xDF"}) {
    const std::string dxf =
        samples::dxf_of("0 SECTION 2 ENTITIES 0 LINE 8 Umri" + std::string(umlaut) +
                        " 10 0 20 0 11 8 21 8 0 LINE 8 Rim 10 0 20 0 11 9 21 9 0 ENDSEC 0 EOF");
    EXPECT_EQ(lines_of(dxf, "a.dxf", "umri\u00DF"), 1u) << umlaut;
    EXPECT_THAT(refusal_of(read_drawing(dxf, "a.dxf", "Pan")),
                HasSubstr("found \"Rim\", \"Umri\u00DF\""));
  }
}

TEST(Layers, UnknownOnesAreRefusedWithTheNames) {
  EXPECT_THAT(
      refusal_of(read_drawing(kSvg, "a.svg", "Pan")),
      HasSubstr("a.svg: expected a layer \"Pan\", found \"Construction lines\", \"Lid\", \"Pot\""));
  EXPECT_THAT(refusal_of(read_drawing(kDxf, "a.dxf", "Pan")),
              HasSubstr("\"Pan\", found \"Lid\", \"Pot\""));
  // An SVG of other programs has groups with ids, which --layer accepts.
  const std::string open = "<svg xmlns='http://www.w3.org/2000/svg'>",
                    line = "<path d='M 0 0 H 9'/></g>";
  const std::string groups =
      open + "<g id='section'>" + line + "<g id='axis'>" + line + "<g>" + line + "</svg>";
  EXPECT_EQ(lines_of(groups, "a.svg", "section"), 1u);
  EXPECT_THAT(refusal_of(read_drawing(groups, "a.svg", "nope")),
              testing::EndsWith("found \"axis\", \"section\""));
  EXPECT_THAT(refusal_of(read_drawing(open + "<g>" + line + "</svg>", "a.svg", "nope")),
              HasSubstr("found no layers and no groups with a name"));
  std::string many = open;
  for (int i = 10; i < 30; ++i) many += "<g id='g" + std::to_string(i) + "'>" + line;
  EXPECT_THAT(refusal_of(read_drawing(many + "</svg>", "a.svg", "nope")),
              HasSubstr("\"g20\", \"g21\" and 8 more"));
  const std::string empty = samples::dxf_of("0 SECTION 2 ENTITIES 0 ENDSEC 0 EOF");
  EXPECT_THAT(refusal_of(read_drawing(empty, "a.dxf", "nope")), HasSubstr("no lines on any layer"));
  EXPECT_THAT(refusal_of(read_drawing("1,2\n", "a.csv", "Pan")), HasSubstr("found a table"));
}

}  // namespace
}  // namespace clay::importing
