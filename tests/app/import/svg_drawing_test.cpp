#include "tests/app/import/solids.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace clay::importing {
namespace {

using testing::HasSubstr;

// 1 unit is 1 mm, as drawing programs set up their pages.
std::string page(const std::string& shapes) {
  return "<svg xmlns='http://www.w3.org/2000/svg' width='200mm' height='200mm' "
         "viewBox='0 0 200 200'>" +
         shapes + "</svg>";
}

double volume_of(const std::string& shapes) {
  const auto section = section_of(page(shapes), "pot.svg");
  EXPECT_TRUE(section) << refusal_of(section);
  return section ? section->volume_mm3() : 0.0;
}

constexpr double kPi = std::numbers::pi;

TEST(SvgDrawing, RectangleAtTheAxisIsACylinder) {
  const auto section = section_of(page("<rect x='20' y='30' width='40' height='50'/>"), "pot.svg",
                                  {AxisRule::left, 0.0, {}});
  ASSERT_TRUE(section) << refusal_of(section);
  EXPECT_NEAR(section->height_mm, 50.0, 1e-9);
  EXPECT_NEAR(section->axis_mm, 20.0, 1e-9);
  EXPECT_NEAR(section->volume_mm3(), kPi * 1600.0 * 50.0, 1e-6);
}

TEST(SvgDrawing, UsesTheMirrorLineOfASymmetricDrawingAsAxis) {
  EXPECT_NEAR(volume_of("<rect x='20' y='30' width='40' height='50'/>"), kPi * 400.0 * 50.0, 1e-6);
  EXPECT_NEAR(volume_of("<circle cx='90' cy='90' r='30'/>"), 4.0 / 3.0 * kPi * 27000.0,
              kFlatMm * 4.0 * kPi * 900.0);
}

TEST(SvgDrawing, WarnsOfAShapeThatIsSymmetricButForItsCorners) {
  const auto section = section_of(page("<path d='M 20 30 H 60 V 80 H 20 V 50 Z'/>"), "pot.svg");
  ASSERT_TRUE(section) << refusal_of(section);
  EXPECT_NEAR(section->volume_mm3(), kPi * 1600.0 * 50.0, 1e-6);
  ASSERT_EQ(section->notes.size(), 1u);
  EXPECT_THAT(section->notes[0], HasSubstr("symmetric about x = 40 mm but for its corners; its "
                                           "left end, x = 20 mm, is used as the axis"));
  EXPECT_TRUE(section_of(page("<path d='M 20 30 H 60 V 80 H 20 V 50 Z'/>"), "pot.svg",
                         {AxisRule::left, 0.0, {}})
                  ->notes.empty());
  // The images of all corners of this bore are on the outlines, and its wall is not symmetric.
  EXPECT_TRUE(section_of(page("<path d='M 0 60 H 30 V 0 H 0 Z M 0 54 H 26 V 0 H 0 Z'/>"), "pot.svg")
                  ->notes.empty());
}

TEST(SvgDrawing, FlattenedCurvesKeepTheirArea) {
  // A half circle by one arc, then by the usual two cubics, which deviate by 2.7e-4 of the radius.
  const std::string end = " Z'/>";
  const double ball = 4.0 / 3.0 * kPi * 27000.0, surface = 4.0 * kPi * 900.0;
  EXPECT_NEAR(volume_of("<path d='M 10 10 A 30 30 0 0 1 10 70" + end), ball, kFlatMm * surface);
  EXPECT_NEAR(volume_of("<path d='M 10 10 c 16.5685 0 30 13.4315 30 30 S 26.5685 70 10 70" + end),
              ball, (2.8e-4 * 30.0 + kFlatMm) * surface);
}

TEST(SvgDrawing, ArcsFollowTheirFlags) {
  // A circle of radius 30 about a point 18 to one side of the axis, cut there at +-24: the moment
  // of a circle's segment about its chord, in closed form.
  const double moment = 2.0 / 3.0 * 24.0 * 24.0 * 24.0, angle = std::acos(18.0 / 30.0);
  const double small = 900.0 * angle - 18.0 * 24.0, large = 900.0 * kPi - small;
  EXPECT_NEAR(volume_of("<path d='M 0 1 a 30 30 0 0 1 0 48 Z'/>"),
              2.0 * kPi * (moment - 18.0 * small), kFlatMm * 4.0 * kPi * 900.0);
  EXPECT_NEAR(volume_of("<path d='M 0 49 a 30 30 0 1 0 0 -48 Z'/>"),
              2.0 * kPi * (moment + 18.0 * large), kFlatMm * 4.0 * kPi * 48.0 * 48.0);
  // An ellipse on its side with radii too short for its ends: SVG enlarges them.
  EXPECT_NEAR(volume_of("<path d='M 0 0 A 20 10 90 0 1 0 80 Z'/>"),
              4.0 / 3.0 * kPi * 20.0 * 20.0 * 40.0, kFlatMm * 4.0 * kPi * 1600.0);
}

TEST(SvgDrawing, AppliesTransformsGroupsAndUnits) {
  const double wanted = kPi * 900.0 * 60.0;
  EXPECT_NEAR(volume_of("<g transform='translate(5 7) scale(2 3)'><g transform='scale(0.5)'>"
                        "<path d='M 10 0 H 40 V 40 H 10 Z M 0 0' transform='scale(1 1)'/></g></g>"),
              kPi * 15.0 * 15.0 * 60.0, 1e-6);
  const auto inches =
      section_of("<svg xmlns='http://www.w3.org/2000/svg'><path d='M 0 0 H 96 V 192 H 0 Z'/></svg>",
                 "pot.svg", {AxisRule::left, 0.0, {}});
  ASSERT_TRUE(inches) << refusal_of(inches);
  EXPECT_NEAR(inches->volume_mm3(), kPi * 25.4 * 25.4 * 50.8, 1e-6);
  const auto high = section_of(page("<polygon points='0,0 10,0 10,20 0,20'/>"), "pot.svg",
                               {AxisRule::left, 0.0, 60.0});
  ASSERT_TRUE(high) << refusal_of(high);
  EXPECT_NEAR(high->volume_mm3(), wanted, 1e-6);
}

TEST(SvgDrawing, AppliesTheTransformOfThePage) {
  for (const char* attribute : {"transform='scale(2)'", "style='transform: scale(2)'"}) {
    const auto section = section_of(
        std::string("<svg xmlns='http://www.w3.org/2000/svg' width='200mm' height='200mm' "
                    "viewBox='0 0 200 200' ") +
            attribute + "><rect width='15' height='30'/></svg>",
        "pot.svg", {AxisRule::left, 0.0, {}});
    ASSERT_TRUE(section) << refusal_of(section);
    EXPECT_NEAR(section->volume_mm3(), kPi * 900.0 * 60.0, 1e-6) << attribute;
  }
}

TEST(SvgDrawing, PercentagesAreOfTheViewBox) {
  const auto section = section_of(
      "<svg xmlns='http://www.w3.org/2000/svg' width='120mm' height='120mm' "
      "viewBox='0 0 120 120'><rect x='25%' y='30%' width='15%' height='40%'/></svg>",
      "pot.svg");
  ASSERT_TRUE(section) << refusal_of(section);
  EXPECT_NEAR(section->height_mm, 48.0, 1e-9);
  EXPECT_NEAR(section->volume_mm3(), kPi * 81.0 * 48.0, 1e-6);
}

TEST(SvgDrawing, APageWithoutAWidthOrAHeightTakesThatOfItsViewBox) {
  const auto high = [](const std::string& size) {
    const auto section = section_of("<svg xmlns='http://www.w3.org/2000/svg' " + size +
                                        "><rect x='10' y='10' width='20' height='40'/></svg>",
                                    "pot.svg");
    EXPECT_TRUE(section) << refusal_of(section);
    return section ? section->height_mm : 0.0;
  };
  const double px = 25.4 / 96.0;
  EXPECT_NEAR(high("viewBox='0 0 100 50'"), 40.0 * px, 1e-9);
  EXPECT_NEAR(high("width='100%' height='100%' viewBox='0 0 100 50'"), 40.0 * px, 1e-9);
  EXPECT_NEAR(high("width='200mm' viewBox='0 0 100 50'"), 80.0, 1e-9);
  EXPECT_NEAR(high("height='5cm' viewBox='0 0 100 50'"), 40.0, 1e-9);
  EXPECT_NEAR(high(""), 40.0 * px, 1e-9);
  const std::string sizeless =
      "<svg xmlns='http://www.w3.org/2000/svg'><rect width='20' height='40%'/></svg>";
  EXPECT_THAT(refusal_of(read_drawing(sizeless, "pot.svg")),
              HasSubstr("expected a viewBox, or a width and a height of the drawing"));
}

TEST(SvgDrawing, TransformsOfStylesAreHonouredOrRefusedByName) {
  const std::string shape = " d='M 0 0 H 30 V 60 H 0 L 0 30 Z'/>";
  const double wanted = kPi * 900.0 * 60.0;
  EXPECT_NEAR(volume_of("<path style='transform: skew(0, 0) translate(5px,0)'" + shape), wanted,
              1e-6);
  // Twice as large about any origin.
  EXPECT_NEAR(volume_of("<path style='transform-origin: 7px 9mm; transform: scale(2)'" + shape),
              8.0 * wanted, 1e-5);
  // Mirrored about (50, 0), x from 0 to 30 becomes 70 to 100; the axis is the left end.
  const auto turned =
      section_of(page("<path style='transform:scaleX(-1);transform-origin:50px 0px'" + shape),
                 "pot.svg", {AxisRule::left, 0.0, {}});
  ASSERT_TRUE(turned) << refusal_of(turned);
  EXPECT_NEAR(turned->axis_mm, 70.0, 1e-9);
  for (const char* transform :
       {"translate3d(1px,2px,3px)", "translate(50%)", "scale(50%)", "rotate(5px)", "translate(1em)",
        "rotate(1deg 2px)", "translate(1px", "wobble"})
    EXPECT_THAT(
        refusal_of(read_drawing(
            page(std::string("<path style='transform:") + transform + "'" + shape), "pot.svg")),
        HasSubstr("pot.svg:1: transform: expected matrix, translate"))
        << transform;
  EXPECT_THAT(
      refusal_of(read_drawing(
          page("<path style='transform:scale(2);transform-origin:center'" + shape), "pot.svg")),
      HasSubstr("transform-origin: expected two lengths, such as 10px 20px, found center"));
}

TEST(SvgDrawing, RefusesRecursiveUse) {
  EXPECT_THAT(refusal_of(read_drawing(page("<g id='a'><use href='#b'/></g><g id='b'><use "
                                           "href='#a'/></g>"),
                                      "pot.svg")),
              HasSubstr("use: expected an element that does not use itself, found #b -> #a -> #b"));
  EXPECT_THAT(refusal_of(read_drawing(page("<use id='u' href='#u'/>"), "pot.svg")),
              HasSubstr("found #u -> #u"));
  EXPECT_NEAR(volume_of("<defs><path id='p' d='M 0 0 H 30 V 60 H 0 L 0 30 Z'/></defs>"
                        "<use href='#p'/>"),
              kPi * 900.0 * 60.0, 1e-6);
}

// Each use copies the path: 1 MB of it, 3000 times, are 3 GB.
TEST(SvgDrawing, RefusesUsesThatCopyTooMuch) {
  std::string path = "<path id='p' d='M 0 0 H 30 V 60 H 0 L 0 30 Z";
  path += std::string(1'000'000, ' ') + "'/>", path = "<defs>" + path + "</defs>";
  std::string uses;
  for (int i = 0; i < 3000; ++i) uses += "\n<use href='#p'/>";
  EXPECT_THAT(refusal_of(read_drawing(page(path + uses), "pot.svg")),
              testing::MatchesRegex("pot\\.svg:1: expected attributes of at most 64 MiB with all "
                                    "uses, found more"));
  EXPECT_NEAR(volume_of(path + "<use href='#p'/>"), kPi * 900.0 * 60.0, 1e-6);
}

// Each of 1000 rules was compared once for each of 2000 equal classes, each time with all of them.
TEST(SvgDrawing, ClassesThatAreRepeatedCountOnce) {
  std::string rules, classes = "b ";
  for (int i = 0; i < 1000; ++i) rules += ".a.b{fill:none}.a.c{display:none}";
  for (int i = 0; i < 2000; ++i) classes += "a ";
  const std::string shape = " d='M 0 0 H 30 V 60 H 0 L 0 30 Z'/>";
  const std::string style = "<style>" + rules + "</style>";
  const double wanted = kPi * 900.0 * 60.0;
  EXPECT_NEAR(volume_of(style + "<path class='" + classes + "' stroke='red'" + shape), wanted,
              1e-6);
  EXPECT_NEAR(
      volume_of(style + "<path class='" + classes + "'" + shape + "<path class='a'" + shape),
      wanted, 1e-6)
      << "the first path has no paint";
}

TEST(SvgDrawing, RefusesTooManyComparisons) {
  std::string rules, classes;
  for (int i = 0; i < 200; ++i) {
    classes += " c" + std::to_string(i);
    for (int k = 0; k < 600; ++k) rules += ".c" + std::to_string(i) + "{fill:red}";
  }
  std::string paths;
  for (int i = 0; i < 200; ++i) paths += "\n<path class='" + classes + "' d='M 0 0 L 1 1'/>";
  EXPECT_THAT(refusal_of(read_drawing(page("<style>" + rules + "</style>" + paths), "pot.svg")),
              HasSubstr("expected style sheets that need at most 20000000 comparisons"));
}

TEST(SvgDrawing, IgnoresHiddenElements) {
  const std::string pot = "<path d='M 0 0 H 30 V 60 H 0 L 0 30 Z'/>";
  const std::string hidden = "<path d='M 0 0 H 90 V 60 H 0 Z'/>";
  const double wanted = kPi * 900.0 * 60.0;
  for (const std::string& wrapped :
       {"<defs>" + hidden + "</defs>", "<g display='none'>" + hidden + "</g>",
        "<g style='display:none'>" + hidden + "</g>", "<g opacity='0'>" + hidden + "</g>",
        "<g style='opacity:0.0'>" + hidden + "</g>", "<clipPath id='c'>" + hidden + "</clipPath>",
        "<g fill-opacity='0'>" + hidden + "</g>",
        "<g style='stroke:red;fill-opacity:0;stroke-opacity:0%'>" + hidden + "</g>"})
    EXPECT_NEAR(volume_of(wrapped + pot), wanted, 1e-6) << wrapped;
  // Its stroke or its fill is still visible.
  for (const char* style : {"fill-opacity:0;stroke:red", "stroke-opacity:0", "fill-opacity:0.5"})
    EXPECT_NEAR(volume_of(std::string("<g style='") + style + "'>" + pot + "</g>"), wanted, 1e-6)
        << style;
}

/// SVG 2 renders none of them; drawing programs leave them behind.
TEST(SvgDrawing, ShapesWithoutGeometryDrawNothing) {
  const std::string pot = "<path d='M 0 0 H 30 V 60 H 0 L 0 30 Z'/>";
  for (const std::string empty :
       {"<path d=''/>", "<path/>", "<path d='none'/>", "<polygon points=''/>", "<polyline/>",
        "<rect/>", "<rect width='50'/>", "<rect width='auto' height='50'/>", "<circle cx='50'/>"})
    EXPECT_NEAR(volume_of(empty + pot), kPi * 900.0 * 60.0, 1e-6) << empty;
}

TEST(SvgDrawing, ImportantDeclarationsPrevail) {
  const std::string pot = "<path d='M 0 0 H 30 V 60 H 0 L 0 30 Z'/>";
  const auto with = [&](const std::string& css, const std::string& style) {
    return volume_of("<style>" + css + "</style>" + pot + "<rect id='x' class='a b' style='" +
                     style + "' width='90' height='60'/>");
  };
  const double wanted = kPi * 900.0 * 60.0;
  EXPECT_NEAR(with(".a{display:none !important} #x{display:inline}", ""), wanted, 1e-6);
  EXPECT_NEAR(with(".a{display:none!important}", "display:inline"), wanted, 1e-6);
  EXPECT_NEAR(with(".a{fill: none ! important}", "fill:red"), wanted, 1e-6);
  EXPECT_NEAR(with(".a.b{display:inline!important}", "display:none !important"), wanted, 1e-6);
  EXPECT_NEAR(with("rect{display:none!important; display:inline}", ""), wanted, 1e-6);
}

TEST(SvgDrawing, KeywordsOfCssMayBeInCapitals) {
  const std::string pot = "<path d='M 0 0 H 30 V 60 H 0 L 0 30 Z'/>";
  for (const std::string hidden :
       {"style='display:NONE'", "style='DISPLAY:none'", "display='None'", "class='off'",
        "visibility='HIDDEN'", "style='fill:None;stroke:NONE'", "fill='Transparent'",
        "style='display:None!IMPORTANT'"})
    EXPECT_NEAR(volume_of("<style>.off{Display:nOne}</style>" + pot + "<rect " + hidden +
                          " width='90' height='60'/>"),
                kPi * 900.0 * 60.0, 1e-6)
        << hidden;
  for (const std::string shown :
       {"visibility='VISIBLE'", "visibility='INHERIT'", "style='transform:NONE'"})
    EXPECT_NEAR(volume_of(pot + "<rect " + shown + " y='60' width='30' height='40'/>"),
                kPi * 900.0 * 100.0, 1e-6)
        << shown;
}

TEST(SvgDrawing, ReportsClipPathsAndMasksOnce) {
  const std::string start = "<svg xmlns='http://www.w3.org/2000/svg'>";
  const auto notes_of = [&](const std::string& shapes) {
    return read_drawing(start + shapes + "</svg>", "mask.svg").value().notes;
  };
  const std::string path = "<path d='M 0 0 H 90 V 60 H 0 Z' ";
  EXPECT_TRUE(notes_of(path + "clip-path='none'/>").empty());
  EXPECT_EQ(
      notes_of(path + "clip-path='url(#c)'/>\n" + path + "style='clip-path:url(#c)'/>"),
      std::vector<std::string>{"mask.svg:1: a clip-path is not applied: the whole shape was read"});
  EXPECT_EQ(notes_of(path + "mask='url(#m)' clip-path='url(#c)'/>").size(), 2u);
}

/// Programs differ in the length of a px: Adobe Illustrator has 72 to the inch.
TEST(SvgDrawing, WarnsOfAPageWithoutALengthOnPaper) {
  const auto notes_of = [](const std::string& page_attributes, const std::string& unit = "",
                           const HalfSectionSettings& settings = {}) {
    const std::string svg = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 96 96' " +
                            page_attributes + "><rect width='48" + unit + "' height='48" + unit +
                            "'/></svg>";
    return section_of(svg, "a.svg", settings).value().notes;
  };
  for (const char* size : {"", "width='96' height='96'", "width='96px'", "width='100%'",
                           "preserveAspectRatio='xMinYMin'"}) {
    ASSERT_EQ(notes_of(size).size(), 1u) << size;
    EXPECT_THAT(notes_of(size)[0],
                HasSubstr("a.svg: expected a page with a size in mm, cm or in, found none"));
    EXPECT_TRUE(notes_of(size, "", {{}, 0.0, 25.4}).empty()) << "the height is given";
    EXPECT_TRUE(notes_of(size, "mm").empty()) << "the shape has a unit";
  }
  for (const char* size : {"width='1in'", "height='25.4mm'", "width='2.54cm'", "width='72pt'"})
    EXPECT_TRUE(notes_of(size).empty()) << size;
}

TEST(SvgDrawing, CupOfTwoOutlinesEqualsCupOfOne) {
  // A wall of 4 around a bore of 26, floor of 6; the foot is below, because y points down on a
  // page.
  const double wanted = kPi * (900.0 * 60.0 - 676.0 * 54.0);
  EXPECT_NEAR(volume_of("<path d='M 0 60 H 30 V 0 H 26 V 54 H 0 Z'/>"), wanted, 1e-6);
  EXPECT_NEAR(volume_of("<path d='M 0 60 H 30 V 0 H 0 Z M 0 0 H 26 V 54 H 0 V 20 Z'/>"), wanted,
              1e-6);
  EXPECT_NEAR(volume_of("<path d='M 0 60 H 30 V 0 H 26 V 54 H 0'/>"), wanted, 1e-6);
}

TEST(SvgDrawing, RefusesFilesThatAreNotDrawings) {
  const auto refused = [](const std::string& bytes) {
    return refusal_of(read_drawing(bytes, "pot.svg"));
  };
  EXPECT_THAT(refused("<svg"), HasSubstr("pot.svg:1: "));
  EXPECT_THAT(refused("\n\n<svg><g></svg>"), HasSubstr("pot.svg:3: "));
  EXPECT_THAT(refused("<html/>"), HasSubstr("pot.svg:1: expected"));
  EXPECT_THAT(refused(page("")), HasSubstr("no line in it"));
  EXPECT_THAT(refused(page("<path d='M 0 0 L 1'/>")), HasSubstr("expected an SVG drawing"));
  EXPECT_THAT(refused(page("<path d='M 0 0 L 1e300 1e300'/>")), HasSubstr("within 1e+06 mm"));
  EXPECT_THAT(refused(std::string(3, '\0')), HasSubstr("pot.svg"));
}

TEST(SvgDrawing, ReplacesEntitiesOnceOnly) {
  // Entities as Adobe Illustrator writes them.
  const std::string start =
      "<?xml version='1.0'?><!DOCTYPE svg [<!ENTITY ns 'http://www.w3.org/2000/svg'>"
      "<!ENTITY st0 'display:none'>";
  const auto pot = section_of(start +
                                  "]><svg xmlns='&ns;'><path d='M 0 0 H 96 V 96 H 0 Z'/>"
                                  "<path style='&st0;' d='M 0 0 H 99 V 99 H 0 Z'/></svg>",
                              "pot.svg", {AxisRule::left, 0.0, {}});
  ASSERT_TRUE(pot) << refusal_of(pot);
  EXPECT_NEAR(pot->volume_mm3(), kPi * 25.4 * 25.4 * 25.4, 1e-6);
  std::string bomb = start + "<!ENTITY l0 'lol'>";
  for (int i = 1; i < 12; ++i) {
    bomb += "<!ENTITY l" + std::to_string(i) + " '";
    for (int k = 0; k < 10; ++k) bomb += "&l" + std::to_string(i - 1) + ";";
    bomb += "'>";
  }
  for (const char* use : {"<path d='&l11;'/>", "<style>&l11;</style>", "<g id='&l11;'>&l11;</g>"})
    EXPECT_THAT(refusal_of(read_drawing(bomb + "]><svg xmlns='&ns;'>" + use + "</svg>", "pot.svg")),
                HasSubstr("pot.svg"));
}

/// A text in ASCII as UTF-16.
std::string wide(const std::string& text, bool high_first) {
  std::string bytes = high_first ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text)
    for (const bool high : {high_first, !high_first}) bytes += high ? '\0' : c;
  return bytes;
}

// libxml2 compares each attribute with all others of its tag: 930 KB of them took half a minute.
TEST(SvgDrawing, RefusesTooManyAttributesOfATagInAdvance) {
  const auto with = [](int count) {
    std::string path = "<!-- don't --><path";
    for (int i = 0; i < count; ++i) path += "\n data-" + std::to_string(i) + "='a=\"b>c='";
    return page(path + " d='M 0 0 H 96 V 96 H 0 Z'/>");
  };
  const std::string because = "expected at most 1000 attributes of one tag, found more";
  EXPECT_TRUE(read_drawing(with(999), "pot.svg")) << refusal_of(read_drawing(with(999), "pot.svg"));
  EXPECT_THAT(refusal_of(read_drawing(with(1000), "pot.svg")),
              HasSubstr("pot.svg:1001: " + because));
  // Faults before the tag do not hide it.
  for (const char* before : {"<g b'c>", "<g b='<", "<!DOCTYPE g [<!ENTITY e '<!--'>]>", "<!-- '"})
    EXPECT_THAT(refusal_of(read_drawing(before + with(1000), "pot.svg")), HasSubstr(because))
        << before;
  for (const bool high_first : {false, true}) {
    EXPECT_TRUE(read_drawing(wide(with(999), high_first), "pot.svg")) << high_first;
    EXPECT_THAT(refusal_of(read_drawing(wide(with(1000), high_first), "pot.svg")),
                HasSubstr("pot.svg:1001: " + because))
        << high_first;
  }
}

TEST(SvgDrawing, RefusesEncodingsThatHideTags) {
  const std::string drawing = page("<path d='M 0 0 H 96 V 96 H 0 Z'/>");
  const auto declared = [&](const std::string& encoding) {
    return "<?xml version='1.0' encoding = \"" + encoding + "\"?>" + drawing;
  };
  for (const char* encoding : {"UTF-8", "utf-8", "ISO-8859-1", "windows-1252", "US-ASCII"})
    EXPECT_TRUE(read_drawing(declared(encoding), "pot.svg")) << encoding;
  for (const char* encoding : {"UTF-7", "ISO-2022-JP", "UTF-16LE", "IBM037"})
    EXPECT_THAT(refusal_of(read_drawing(declared(encoding), "pot.svg")),
                HasSubstr("pot.svg:1: expected the encoding UTF-8 or UTF-16, found "))
        << encoding;
  // Also from standard input, which has no ending.
  for (const char* encoding : {"UTF-16", "utf-16le"})
    for (const char* name : {"pot.svg", "-"})
      EXPECT_TRUE(read_drawing(wide(declared(encoding), false), name)) << encoding << name;
  EXPECT_TRUE(read_drawing(wide(declared("UTF-16"), true), "-"));
  EXPECT_THAT(refusal_of(read_drawing(wide(declared("UTF-16BE"), false), "pot.svg")),
              HasSubstr("expected the encoding UTF-8 or UTF-16, found 'utf-16be'"));
}

TEST(SvgDrawing, ReadsLongAttributes) {
  std::string points = "0,0 ";
  for (int i = 0; i < 400'000; ++i)
    points += "96.000000000000000000000," + std::to_string(i * 0.001) + " ";
  ASSERT_GT(points.size(), 10'000'000u);
  const auto pot = section_of(
      "<svg xmlns='http://www.w3.org/2000/svg'><polygon points='" + points + "0,399.999'/></svg>",
      "pot.svg", {AxisRule::left, 0.0, {}});
  ASSERT_TRUE(pot) << refusal_of(pot);
  EXPECT_NEAR(pot->volume_mm3() / (kPi * 25.4 * 25.4 * 399.999 * 25.4 / 96.0), 1.0, 1e-9);
}

TEST(SvgDrawing, MessagesShortenALongPath) {
  const std::string says = refusal_of(
      read_drawing(page("<path d='M 0 0 L 1 x" + std::string(100'000, '7') + "'/>"), "pot.svg"));
  EXPECT_THAT(says, HasSubstr("pot.svg:1: expected an SVG drawing"));
  EXPECT_LT(says.size(), 300u);
}

// An arc of such numbers has no angle, and the number of its chords was once computed from it as an
// int.
TEST(SvgDrawing, RefusesHugeNumbersWithTheirLine) {
  const auto refused = [](const std::string& shape) {
    return refusal_of(read_drawing(page("\n<g>\n" + shape + "</g>"), "pot.svg"));
  };
  EXPECT_THAT(refused("<path d='M 0 0 L 1e300 1e300'/>"),
              HasSubstr("pot.svg:3: expected points within 1e+06 mm"));
  for (const char* shape :
       {"<path d='M 0 0 A 1e200 1e200 0 0 1 10 1e200'/>", "<path d='M 0 0 A 1e308 1 0 1 1 9 9'/>",
        "<circle cx='0' cy='0' r='1e308'/>", "<ellipse cx='1e308' cy='0' rx='1e308' ry='3'/>",
        "<path d='M 0 0 C 1e308 -1e308 1e308 1e308 9 9'/>",
        "<path transform='scale(1e308)' d='M 1 1 A 5 5 0 0 1 1e9 9'/>"})
    EXPECT_THAT(refused(shape), HasSubstr("pot.svg:3: expected points within 1e+06 mm")) << shape;
  EXPECT_THAT(refused("<path d='M 0 0 L 1'/>"), HasSubstr("pot.svg:3: expected an SVG drawing"));
}

TEST(SvgDrawing, ErrorsNameLinesBeyond65535) {
  const std::string far(70'000, '\n');
  for (const char* shape : {"<path d='M 0 0 L 1'/>", "<path d='M 0 0 L 1e300 1e300'/>",
                            "<rect transform='bend(3)' width='5' height='5'/>", "<use href='#x'/>"})
    EXPECT_THAT(refusal_of(read_drawing(page(far + shape + "\n<g/>"), "pot.svg")),
                HasSubstr("pot.svg:70001: "))
        << shape;
}

// Each arc has 4096 chords: without an intermediate limit, 4 GB of them.
TEST(SvgDrawing, RefusesASmallFileThatDrawsTooMuch) {
  std::string arcs = "<path d='M 0 0";
  for (int i = 0; i < 60'000; ++i)
    arcs += i % 2 == 0 ? " A 4e5 4e5 0 1 1 1 1" : " A 4e5 4e5 0 1 1 0 0";
  EXPECT_THAT(refusal_of(read_drawing(page(arcs + "'/>"), "pot.svg")),
              HasSubstr("expected at most 1000000 points, found more"));
}

// Comparing every corner with all others on its level took hours.
TEST(SvgDrawing, MirrorsManyPointsOnOneLevelQuickly) {
  std::string points;
  for (int i = -400'000; i <= 400'000; ++i) points += std::to_string(i) + ",0 ";
  const auto section =
      section_of(page("<polygon points='" + points + "400000,50 -400000,50'/>"), "pot.svg");
  ASSERT_TRUE(section) << refusal_of(section);
  EXPECT_EQ(section->axis, AxisRule::middle);
}

}  // namespace
}  // namespace clay::importing
