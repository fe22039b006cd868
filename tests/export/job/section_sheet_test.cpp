// The drawing: its sizes against the pot's, its lines against its volume, in every format.

#include "export/job/section_sheet.hpp"

#include "tests/export/job/sample_pots.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid {
namespace {

using shapes::pot_of;
using shapes::stack_of;

/// A cup of 40 mm radius outside and 35 mm inside, 60 mm high, with a foot of 38 mm radius and a
/// floor of 10 mm.
Pot cup() {
  return pot_of(stack_of(10.0, {{38, 0}, {40, 35}, {40, 35}, {40, 35}, {40, 35}, {40, 35}}));
}

Sheet sheet_of(const Pot& pot, ExportOptions options = {}) {
  options.smoothing = Smoothing::none;
  const auto report = run_export(pot, {}, options);
  if (!report) throw std::runtime_error(report.error().message);
  return section_sheet(*report, options);
}

/// The words on a layer.
std::vector<std::string> words_on(const Sheet& sheet, SheetLayer layer) {
  std::vector<std::string> words;
  for (const SheetText& text : sheet.texts)
    if (text.layer == layer) words.push_back(text.words);
  return words;
}

TEST(SectionSheet, StatesTheSizesOfThePot) {
  const std::vector<std::string> expected{"\u2300 80.0", "\u2300 70.0", "\u2300 76.0", "50.0",
                                          "floor 10.0",  "60.0",        "40.0",        "5.0",
                                          "5.0",         "5.0",         "5.0"};
  // At 10 mm the caliper meets the step of the foot from above or below.
  std::vector<std::string> found = words_on(sheet_of(cup()), SheetLayer::dimensions);
  ASSERT_EQ(found.size(), 11u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(found[i], expected[i]);
  for (std::size_t i = 7; i < 11; ++i) EXPECT_EQ(found[i], expected[i]);
}

/// A letter takes one to four bytes.
TEST(SectionSheet, HasThePaperOfItsLettersNotOfItsBytes) {
  ExportOptions options;
  const auto paper = [&](const char* letter) {
    options.name.clear();
    for (int i = 0; i < 40; ++i) options.name += letter;
    const Sheet sheet = sheet_of(cup(), options);
    return sheet.high - sheet.low;
  };
  EXPECT_EQ(paper("a"), paper("\u8336"));
}

TEST(SectionSheet, StatesNoCapacityOfATube) {
  const auto holds = [](const Sheet& sheet) {
    return std::ranges::any_of(sheet.texts, [](const SheetText& text) {
      return text.words.find("holds") != std::string::npos;
    });
  };
  EXPECT_TRUE(holds(sheet_of(cup())));
  EXPECT_FALSE(holds(sheet_of(pot_of(stack_of(10.0, {{40, 35}, {40, 35}, {40, 35}})))));
}

TEST(SectionSheet, StatesALipThatCanBeMeasured) {
  const auto lip = [](double fillet_mm, double glaze_mm = 0.0) {
    ExportOptions options;
    options.smoothing = Smoothing::none;
    options.finish.glaze_mm = glaze_mm;
    auto report = run_export(cup(), {}, options);
    if (!report) throw std::runtime_error(report.error().message);
    report->section.smoothed.lip_fillet_mm = fillet_mm;
    const Sheet sheet = section_sheet(*report, options);
    for (const std::string& words : words_on(sheet, SheetLayer::dimensions))
      if (words.starts_with("lip R")) return words;
    return std::string();
  };
  EXPECT_EQ(lip(1.5), "lip R 1.5");
  EXPECT_EQ(lip(0.03), "");
  // A round edge that is set back has a smaller radius; one as small as the allowance is sharp.
  EXPECT_EQ(lip(1.5, 0.5), "lip R 1.0");
  EXPECT_EQ(lip(0.5, 0.5), "");
}

TEST(SectionSheet, StatesFiredSizesBesideThoseDrawn) {
  ExportOptions options;
  options.shrinkage = 0.2;
  const auto words = words_on(sheet_of(cup(), options), SheetLayer::dimensions);
  EXPECT_EQ(words[0], "\u2300 100.0 (fired 80.0)");
  // The bore is too narrow for one line.
  EXPECT_EQ(words[4], "floor 12.5");
  EXPECT_EQ(words[5], "(fired 10.0)");
}

struct Box {
  glm::dvec2 low, high;
};

/// Around words in DejaVu Sans, whose digits are 0.636 em wide, with parts below the base line.
Box box_of(const SheetText& text) {
  const double em = 1.37 * text.height_mm;
  double length = 0.0;
  for (const char c : text.words) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) == 0x80U) continue;
    length += em * (byte > 0x7F                                                       ? 0.84
                    : std::string_view(" .()fitrl").find(c) != std::string_view::npos ? 0.40
                                                                                      : 0.64);
  }
  const double before = 0.5 * static_cast<double>(text.anchor) * length;
  const double below = 0.2 * em, above = 0.76 * em;
  if (text.upright)
    return {{text.at.x - above, text.at.y - before},
            {text.at.x + below, text.at.y + length - before}};
  return {{text.at.x - before, text.at.y - below},
          {text.at.x + length - before, text.at.y + above}};
}

bool overlap(const Box& a, const Box& b) {
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

/// Whether the line from `a` to `b` enters the box: the part of it between each pair of sides.
bool enters(const Box& box, glm::dvec2 a, glm::dvec2 b) {
  double from = 0.0, to = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double way = b[axis] - a[axis];
    if (way == 0.0) {
      if (a[axis] <= box.low[axis] || a[axis] >= box.high[axis]) return false;
      continue;
    }
    const double s = (box.low[axis] - a[axis]) / way, t = (box.high[axis] - a[axis]) / way;
    from = std::max(from, std::min(s, t));
    to = std::min(to, std::max(s, t));
  }
  return from < to;
}

/// The words that touch other words or a line; empty if none do.
std::string touching(const Sheet& sheet) {
  for (std::size_t i = 0; i < sheet.texts.size(); ++i) {
    const SheetText& text = sheet.texts[i];
    const Box box = box_of(text);
    for (std::size_t j = 0; j < i; ++j)
      if (overlap(box, box_of(sheet.texts[j]))) return text.words + " | " + sheet.texts[j].words;
    for (const SheetLines& lines : sheet.lines)
      for (const auto& line : lines.lines)
        for (std::size_t k = lines.closed ? 0 : 1; k < line.size(); ++k)
          if (enters(box, line[k == 0 ? line.size() - 1 : k - 1], line[k]))
            return text.words + " | a line of " + std::string(style_of(lines.layer).name);
  }
  return "";
}

TEST(SectionSheet, NothingTouchesTheWords) {
  for (const char* sample : samples::kStandingPots)
    for (const double shrinkage : {0.0, 0.12})
      for (const double lip_mm : {0.0, 1.0}) {
        ExportOptions options;
        options.shrinkage = shrinkage;
        options.lip_fillet_mm = lip_mm;
        const Pot pot = samples::thrown_pot(sample).value();
        const auto report = run_export(pot, {}, options);
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_EQ(touching(section_sheet(*report, options)), "")
            << sample << " " << shrinkage << " " << lip_mm;
      }
}

TEST(SectionSheet, TheFloorOfANarrowBoreStandsBesideTheFoot) {
  ExportOptions options;
  options.shrinkage = 0.2;
  const Sheet sheet =
      sheet_of(pot_of(stack_of(10.0, {{20, 0}, {20, 12}, {20, 12}, {20, 12}})), options);
  EXPECT_EQ(words_on(sheet, SheetLayer::dimensions).at(4), "floor 12.5 (fired 10.0)");
}

TEST(SectionSheet, WordsOfASmallFootStandBesideItsArrow) {
  ExportOptions options;
  options.shrinkage = 0.2;
  const auto foot = [&](double radius_mm) {
    const Pot pot = pot_of(stack_of(10.0, {{radius_mm, 0}, {40, 0}, {40, 35}, {40, 35}}));
    return sheet_of(pot, options).texts.at(2);
  };
  const SheetText small = foot(15), large = foot(38);
  EXPECT_EQ(small.words, "\u2300 37.5 (fired 30.0)");
  EXPECT_GT(small.at.x, 0.5 * 37.5);
  EXPECT_EQ(large.words, "\u2300 95.0 (fired 76.0)");
  EXPECT_LT(large.at.x, 0.5 * 95.0 - 40.0);
}

TEST(SectionSheet, DimensionLinesAreAsLongAsTheySay) {
  // Every line between two arrows, by the length in its text, which is the next on the layer.
  const Sheet sheet = sheet_of(cup());
  std::vector<double> lengths;
  for (std::size_t i = 0; i + 2 < sheet.lines.size(); ++i) {
    const auto &line = sheet.lines[i], &arrow = sheet.lines[i + 1];
    if (line.layer != SheetLayer::dimensions || line.lines[0].size() != 2 ||
        arrow.layer != SheetLayer::dimensions || arrow.lines[0].size() != 3)
      continue;
    lengths.push_back(glm::distance(line.lines[0][0], line.lines[0][1]));
  }
  ASSERT_EQ(lengths.size(), 5u);
  const std::vector<double> expected{80, 70, 76, 50, 60};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(lengths[i], expected[i], 1e-4);
}

TEST(SectionSheet, TheScaleBarIs100MmOnPaper) {
  const std::string svg = svg_of(sheet_of(cup()));
  double width = 0.0, box = 0.0, from = 0.0, to = 0.0, y = 0.0;
  ASSERT_EQ(std::sscanf(svg.c_str() + svg.find("width="), "width=\"%lfmm\"", &width), 1);
  ASSERT_EQ(std::sscanf(svg.c_str() + svg.find("viewBox="), "viewBox=\"0 0 %lf", &box), 1);
  const std::size_t bar = svg.find("<path d=", svg.find("id=\"scale\""));
  ASSERT_EQ(std::sscanf(svg.c_str() + bar, "<path d=\"M%lf %lfL%lf", &from, &y, &to), 3);
  EXPECT_DOUBLE_EQ(width, box);
  EXPECT_NEAR(to - from, 100.0, 1e-4);
}

/// Volume by Pappus' theorem of the outlines on the layer "section" of a DXF: half of the area
/// times the way of its middle, which is pi times the integral of |x| over both halves.
double volume_in(const std::string& dxf) {
  std::istringstream lines(dxf);
  std::string code, value;
  std::vector<std::vector<glm::dvec2>> outlines;
  bool wanted = false, vertex = false;
  while (std::getline(lines, code) && std::getline(lines, value)) {
    const int number = std::stoi(code);
    if (number == 0) {
      vertex = value == "VERTEX" && wanted;
      if (vertex) outlines.back().emplace_back(0.0);
      if (value == "POLYLINE") outlines.emplace_back();
    }
    if (number == 8 && !vertex) wanted = value == "section";
    if (vertex && number == 10) outlines.back().back().x = std::stod(value);
    if (vertex && number == 20) outlines.back().back().y = std::stod(value);
  }
  double sum = 0.0;  // of the integral of |x| over the area: sign(x) x^2 / 2 dy around it
  for (const auto& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const glm::dvec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
      const double squares = (a.x * a.x + a.x * b.x + b.x * b.x) / 6.0;
      sum += (a.x + b.x < 0.0 ? -1.0 : 1.0) * squares * (b.y - a.y);
    }
  return std::numbers::pi * sum;
}

TEST(SectionSheet, TheOutlineInDxfHoldsTheClay) {
  for (const ClayStack& stack :
       {cup().stack, shapes::vase(80), stack_of(5.0, {{30, 20}, {28, 18}, {25, 15}})}) {
    const double volume = stack.volume_mm3();
    EXPECT_NEAR(volume_in(dxf_of(sheet_of(pot_of(stack)))), volume, 1e-5 * volume);
  }
}

TEST(SectionSheet, EveryFormatHasEveryLayer) {
  const Sheet sheet = sheet_of(cup());
  const std::string svg = svg_of(sheet), dxf = dxf_of(sheet);
  for (const LayerStyle& style : kLayerStyles) {
    EXPECT_NE(svg.find("<g id=\"" + std::string(style.name) + "\""), svg.npos) << style.name;
    EXPECT_NE(dxf.find("LAYER\n2\n" + std::string(style.name) + "\n"), dxf.npos) << style.name;
    EXPECT_NE(dxf.find("\n8\n" + std::string(style.name) + "\n"), dxf.npos) << style.name;
  }
  const std::string pdf = pdf_of(sheet).value();
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_EQ(pdf, pdf_of(sheet).value());
}

TEST(SectionSheet, TheCaliperTableIsThatOfTheSection) {
  ExportOptions options;
  options.smoothing = Smoothing::none;
  const auto report = run_export(cup(), {}, options);
  const auto rows = caliper_rows(report->section.profile());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].height, 10.0 * static_cast<double>(i + 1));
    EXPECT_NEAR(rows[i].outer, 80.0, 1e-4);
    EXPECT_NEAR(rows[i].bore, 70.0, 1e-4);
  }
}

TEST(SectionSheet, HostileNamesStayText) {
  ExportOptions options;
  options.name = "<b>\n0\nEOF & \u00e4";
  const Sheet sheet = sheet_of(cup(), options);
  EXPECT_EQ(svg_of(sheet).find("<b>"), std::string::npos);
  const std::string dxf = dxf_of(sheet);
  EXPECT_EQ(dxf.find("\n0\nEOF\n"), dxf.size() - 7);
}

}  // namespace
}  // namespace clay::solid
