// The shapes that `import` reads from SVG, compared with the pictures of librsvg.
#include "tests/app/import/raster.hpp"
#include "tests/support/run_program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace clay::importing {
namespace {

constexpr int kPixels = 200;  // of a page of 100 mm
constexpr double kScale = 2.0;

/// Compares a page of 100 x 100 mm with its picture.
void compare(const std::string& shapes, const std::string& view_box = "0 0 100 100") {
  const test::ScratchFolder folder;
  const std::string page =
      "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' "
      "width='100mm' height='100mm' viewBox='" +
      view_box + "'>" + shapes + "</svg>";
  test::write_text(folder.file("page.svg"), page);
  const auto drawing = read_drawing(page, "page.svg");
  ASSERT_TRUE(drawing) << drawing.error().message << page;
  const auto own = raster::drawn(drawing->lines, kPixels, kPixels, kScale);
  const auto peer = raster::rendered(folder.file("page.svg"), kPixels, kPixels, folder.path());
  ASSERT_EQ(peer.width, kPixels) << page;
  ASSERT_GT(peer.area(), 100.0) << page;
  EXPECT_NEAR(own.area() / peer.area(), 1.0, 6e-3) << page;  // cairo draws curves within 0.1 pixels
  // cairo samples a pixel in 15 x 17 places.
  EXPECT_LT(raster::largest_difference(own, peer), 0.15) << page;
}

const std::vector<std::string> kElements = {
    "<path {} d='M 10 10 h 20 q 8 5 0 12 c 4 4 -2 9 0 13 A 12 8 20 0 1 12 30 Z'/>",
    "<polygon {} points='10,10 30,12 25,35 8,30'/>",
    "<polyline {} points='10,10 30,12 25,35 8,30'/>",
    "<rect {} x='10' y='10' width='20' height='15' rx='4' ry='3'/>",
    "<circle {} cx='20' cy='20' r='11'/>",
    "<ellipse {} cx='20' cy='20' rx='9' ry='13'/>",
    "<path {} d='m10,10l20,2 -5 23-17-5z m4 4 l 8 1 -2 9z' fill-rule='evenodd'/>"};
const std::vector<std::string> kTransforms = {
    "translate(12 9)",
    "translate(7)",
    "scale(1.5)",
    "scale(1.3 0.7)",
    "rotate(17)",
    "rotate(40 30 30)",
    "skewX(20)",
    "skewY(-12)",
    "matrix(0.9 0.2 -0.3 1.1 15 4)",
    "translate(40,5) rotate(30),scale(1 -1) translate(0 -30)"};

TEST(SvgRender, EveryElementWithEveryTransform) {
  for (const std::string& element : kElements)
    for (const std::string& transform : kTransforms)
      compare(fmt::format(fmt::runtime(element), "transform='" + transform + "'"));
}

TEST(SvgRender, NestedTransforms) {
  for (const std::string& element : kElements) {
    const std::string own = fmt::format(fmt::runtime(element), "transform='rotate(9)'");
    compare("<g transform='translate(6 3)'><g transform='scale(1.2)'>" + own + "</g></g>");
    compare("<svg x='20' y='10' width='60' height='60' viewBox='0 0 80 40' overflow='visible'>" +
            own + "</svg>");
    compare("<defs><g id='a' transform='skewX(5)'>" + own +
            "</g></defs><use xlink:href='#a' x='10' y='4' transform='rotate(8)'/>");
    compare("<symbol id='a' viewBox='0 0 50 50' overflow='visible'>" + own +
            "</symbol><use href='#a' x='10' y='4' width='90' height='70' transform='scale(.9)'/>");
  }
}

TEST(SvgRender, PercentagesOfTheViewport) {
  const std::vector<std::string> shapes = {
      "<rect x='25%' y='30%' width='15%' height='40%' rx='3%'/>",
      "<circle cx='40%' cy='50%' r='20%'/>", "<ellipse cx='40%' cy='50%' rx='10%' ry='20%'/>",
      "<rect width='50%' height='25%'/>"};
  for (const char* box : {"0 0 120 120", "0 0 50 80", "-10 -5 130 100"})
    for (const std::string& shape : shapes) {
      compare(shape, box);
      compare("<g transform='scale(.8)'>" + shape + "</g>", box);
      compare("<svg x='10%' y='5%' width='60%' height='50%' overflow='visible'>" + shape + "</svg>",
              box);
      compare("<svg width='90%' height='95%' viewBox='0 0 90 60' overflow='visible'>" + shape +
                  "</svg>",
              box);
      compare(shape, box);
      compare("<defs><g id='a'>" + shape + "</g></defs><use href='#a' x='8%' y='3%'/>", box);
    }
}

// In pixels: librsvg takes a translation in another unit as 0.
TEST(SvgRender, TransformsOfStyles) {
  for (const std::string& element : kElements)
    for (const char* transform :
         {"translate(12px,9px)", "translate(5px)", "translate(20px, 12px) rotate(18deg)",
          "translateX(9px)", "translateY(3px) scaleX(1.4)", "rotate(17deg) scale(1.2,0.8)",
          "rotate(.2rad)", "skewX(10deg)", "skewY(8grad)", "matrix(0.9,0.2,-0.3,1.1,15,4)"}) {
      compare(
          fmt::format(fmt::runtime(element), std::string("style='transform:") + transform + "'"));
      compare(std::string("<style>.moved {transform: ") + transform + "}</style>" +
              fmt::format(fmt::runtime(element), "class='moved'"));
    }
}

TEST(SvgRender, StylesThatHideAndShow) {
  const std::string shape = "<rect {} x='40' y='40' width='20' height='15'/>";
  const std::string base = "<rect x='10' y='10' width='20' height='15'/>";
  for (const char* style :
       {"style='display:none'", "visibility='hidden'", "class='gone'", "class='x gone y'",
        "id='gone'", "style='mix-blend-mode:normal;-inkscape-stroke:none;paint-order:fill'",
        "vector-effect='none' unknown='7'", "style='visibility:collapse'", "fill='none'",
        "class='gone' style='display:inline'", "style='fill:none;stroke:none'", "class='only'",
        "style='fill-opacity:0'", "fill-opacity='0' stroke-opacity='0' stroke='black'"})
    compare(
        "<style>/* a */ @media print { rect {display:none} } .gone, #gone {display : none} "
        "g > .only {display:none} rect:hover {display:none} .a .b {fill:none}</style>" +
        base + fmt::format(fmt::runtime(shape), style));
  compare("<style>.only{display:none} g>rect.only{display:inline}</style><g>" + base +
          "<rect class='only' x='40' y='40' width='20' height='15'/></g>");
  compare(base +
          "<g visibility='hidden'><rect x='40' y='40' width='20' height='15'/>"
          "<rect x='70' y='40' width='20' height='15' visibility='visible'/></g>");
  compare(
      base +
      "<switch><foreignObject requiredExtensions='x'/><rect x='40' y='40' width='20' height='15'/>"
      "<rect x='70' y='40' width='20' height='15'/></switch>");
  compare(base +
          "<clipPath id='c'><rect x='40' y='40' width='20' height='15'/></clipPath>"
          "<defs><rect x='40' y='40' width='20' height='15'/></defs>");
}

}  // namespace
}  // namespace clay::importing
