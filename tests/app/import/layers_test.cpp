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
  EXPECT_EQ(lines_of(kDxf, "a.dxf", ""), 3u);
  EXPECT_EQ(lines_of(kDxf, "a.dxf", "pot"), 1u);
  EXPECT_EQ(lines_of(kDxf, "a.dxf", "LID"), 2u);
}

TEST(Layers, UnknownOnesAreRefusedWithTheNames) {
  EXPECT_THAT(refusal_of(read_drawing(kSvg, "a.svg", "Pan")),
              HasSubstr("a.svg: expected a layer \"Pan\", found Construction lines, Lid, Pot"));
  EXPECT_THAT(refusal_of(read_drawing(kDxf, "a.dxf", "Pan")), HasSubstr("found lid, pot"));
  EXPECT_THAT(refusal_of(read_drawing("1,2\n", "a.csv", "Pan")), HasSubstr("found a table"));
}

}  // namespace
}  // namespace clay::importing
