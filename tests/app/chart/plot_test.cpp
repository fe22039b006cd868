// Axes and drawings, compared with their geometry.

#include "app/chart/plot.hpp"
#include "app/chart/axis_scale.hpp"
#include "app/chart/label_placer.hpp"
#include "core/svg_writer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

namespace clay::test {
namespace {

using namespace chart;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> labels(const AxisScale& axis) {
  std::vector<std::string> texts;
  for (const Tick& tick : axis.ticks())
    if (!tick.label.empty()) texts.push_back(tick.label);
  return texts;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(PlotAxis, LinearTicksAreRound) {
  EXPECT_EQ(labels({false, 0.0, 10.0}), (std::vector<std::string>{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(labels({false, -0.3, 0.3}),
            (std::vector<std::string>{"-0.3", "-0.2", "-0.1", "0", "0.1", "0.2", "0.3"}));
}

TEST(PlotAxis, TheMarginOfTheLargestNumbersIsFinite) {
  Extent extent{.logarithmic = true};
  extent.add(std::vector{1e-307, 1e308});
  const AxisScale axis = extent.scale(0.1);
  EXPECT_TRUE(std::isfinite(axis.high()));
  EXPECT_GT(axis.low(), 0.0);
  for (const Tick& tick : axis.ticks()) EXPECT_TRUE(std::isfinite(tick.value));
  EXPECT_GE(axis.ticks().size(), 2u);
}

TEST(PlotAxis, LabelsDecadesOnly) {
  EXPECT_EQ(labels({true, 0.9, 1100.0}), (std::vector<std::string>{"1", "10", "100", "1000"}));
  EXPECT_EQ(labels({true, 1e-9, 1e-5}),
            (std::vector<std::string>{"10⁻⁹", "10⁻⁸", "10⁻⁷", "10⁻⁶", "10⁻⁵"}));
  // 0.9 and 2..9 of three decades.
  EXPECT_EQ((AxisScale{true, 0.9, 1000.0}.ticks().size()), 1u + 3u * 9u + 1u);
}

TEST(PlotAxis, LabelsFifthsOfFewDecadesAndThinsMany) {
  EXPECT_EQ(labels({true, 1.0, 20.0}), (std::vector<std::string>{"1", "2", "5", "10", "20"}));
  EXPECT_LE(labels({true, 1e-150, 1e150}).size(), 12u);
}

TEST(PlotAxis, PlacesValuesByTheirLogarithm) {
  AxisScale axis(true, 1.0, 1e4);
  axis.place(100.0, 300.0);
  EXPECT_NEAR(axis.at(1.0), 100.0, 1e-9);
  EXPECT_NEAR(axis.at(100.0), 200.0, 1e-9);
  EXPECT_NEAR(axis.at(1e4), 300.0, 1e-9);
  EXPECT_FALSE(axis.shows(0.0));
  EXPECT_FALSE(axis.shows(-1.0));
  EXPECT_FALSE(axis.shows(kMissing));
}

RC_GTEST_PROP(PlotAxis, TicksAscendAndAreFew, (bool logarithmic)) {
  const double low = std::pow(10.0, *rc::gen::inRange(-12, 12)) * *rc::gen::inRange(1, 100);
  const double high = low * (1.0 + 0.001 * *rc::gen::inRange(1, 1'000'000));
  const AxisScale axis(logarithmic, low, high);
  double last = -std::numeric_limits<double>::infinity();
  for (const Tick& tick : axis.ticks()) {
    RC_ASSERT(tick.value > last);
    RC_ASSERT(tick.value >= axis.low() * (1.0 - 1e-6));
    RC_ASSERT(tick.value <= axis.high() * (1.0 + 1e-6));
    last = tick.value;
  }
  RC_ASSERT(labels(axis).size() >= 2u);
  RC_ASSERT(labels(axis).size() <= 14u);
}

TEST(PlotAxis, LabelsARangeWithOneRoundNumber) {
  EXPECT_GE(labels(AxisScale(true, 1.1e-11, 3.48e-11)).size(), 2u);
  EXPECT_GE(labels(AxisScale(true, 2.1, 9.9)).size(), 2u);
}

TEST(PlotAxis, GivesEmptyAndSingleValueRangesALength) {
  for (const bool logarithmic : {false, true}) {
    Extent extent{logarithmic};
    for (int values = 0; values < 2; ++values) {
      const AxisScale axis = extent.scale(0.05);
      EXPECT_LT(axis.low(), axis.high());
      extent.add(3.0);
      extent.add(kMissing);
      extent.add(std::numeric_limits<double>::infinity());
    }
  }
}

TEST(Plot, DrawsEveryPointOnTheAxesAndZerosAtTheEdge) {
  Plot plot{"p", "", {"x", true}, {"y", true}, {}, ""};
  plot.curves.push_back(
      {"c", {1.0, 10.0, 100.0, 1000.0, -1.0}, {1.0, 0.0, kMissing, 3.0, 1.0}, {}, {}});
  const std::string svg = svg_of(plot, Place::page);
  // Two points and the mark in the legend; one zero and its mark in the legend.
  EXPECT_EQ(count(svg, "class=\"mark f0\""), 3u);
  EXPECT_EQ(count(svg, "class=\"zero"), 2u);
  EXPECT_NE(svg.find("exactly 0"), std::string::npos);
}

TEST(Plot, DrawsLabelsAndSpreadsOfBothAxesAtTheirPoints) {
  // The frame is 660 px wide, from 78, and two decades of x; 5 % of its range lie beyond each end.
  Plot plot{"p", "", {"x", true}, {"y", true}, {}, ""};
  Curve curve{"c", {1.0, 10.0, 100.0}, {1.0, 1.0, 100.0}, {}, {}};
  curve.x_low = {1.0, kMissing, 50.0};
  curve.x_high = {10.0, 20.0, 100.0};
  curve.labels = {"50", "100", "<200>"};
  plot.curves.push_back(curve);
  const std::string svg = svg_of(plot, Place::page);
  EXPECT_EQ(count(svg, "class=\"label f0\""), 3u);
  EXPECT_NE(svg.find(">&lt;200&gt;</text>"), std::string::npos);
  std::smatch match;
  ASSERT_TRUE(
      std::regex_search(svg, match, std::regex(R"(M([0-9.]+) [0-9.]+v6m0 -3H([0-9.]+)m0 -3v6M)")));
  EXPECT_NEAR(std::stod(match[1]), 78.0 + 660.0 * 0.05 / 1.1, 0.1);
  EXPECT_NEAR(std::stod(match[2]), 78.0 + 660.0 * 0.55 / 1.1, 0.1);
  EXPECT_EQ(count(svg, "v6m0 -3H"), 2u);  // one low end is missing
}

/// The boxes of the labels in a drawing, by the width of a digit of DejaVu Sans at 10 px (6.36).
std::vector<Box> label_boxes(const std::string& svg) {
  std::vector<Box> boxes;
  const std::regex label(
      "class=\"label f[0-9]\" x=\"([0-9.]+)\" y=\"([0-9.]+)\"( "
      "text-anchor=\"(start|end)\")?>([^<]*)<");
  for (std::sregex_iterator it(svg.begin(), svg.end(), label), end; it != end; ++it) {
    const double x = std::stod((*it)[1]), y = std::stod((*it)[2]);
    const double width = 5.5 * static_cast<double>((*it)[5].length());
    const bool left = (*it)[4] == "end";
    boxes.push_back({left ? x - width : x, y - 8.0, left ? x : x + width, y});
  }
  return boxes;
}

TEST(Plot, LabelsStayWithinTheFrameAndApart) {
  Plot plot{"p", "", {"x", true}, {"y", true}, {}, ""};
  // Two curves that meet at the right and upper edges.
  for (const double factor : {1.0, 1.03}) {
    Curve curve{"c", {1.0, 10.0, 100.0}, {1.0, 30.0 * factor, 100.0 * factor}, {}, {}};
    curve.labels = {"N 50", "N 800", "N 3200"};
    plot.curves.push_back(curve);
  }
  const auto boxes = label_boxes(svg_of(plot, Place::page));
  ASSERT_EQ(boxes.size(), 6u);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_GT(boxes[i].left, 78.0) << i;
    EXPECT_LT(boxes[i].right, 738.0) << i;
    EXPECT_GT(boxes[i].top, 12.0) << i;
    EXPECT_LT(boxes[i].bottom, 352.0) << i;
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_TRUE(boxes[i].right <= boxes[k].left || boxes[k].right <= boxes[i].left ||
                  boxes[i].bottom <= boxes[k].top || boxes[k].bottom <= boxes[i].top)
          << i << " over " << k;
  }
}

TEST(LabelPlacer, TakesTheFreeSide) {
  LabelPlacer placer({0.0, 0.0, 300.0, 300.0});
  const auto free = placer.place({100.0, 100.0}, 30.0);
  EXPECT_STREQ(free.anchor, "start");
  EXPECT_LT(free.at.y, 100.0);
  // A line up to the right, and one down to the right: the labels go to the other side.
  LabelPlacer crossed({0.0, 0.0, 300.0, 300.0});
  crossed.avoid_line({100.0, 100.0}, {150.0, 80.0});
  crossed.avoid_line({100.0, 100.0}, {150.0, 120.0});
  EXPECT_STREQ(crossed.place({100.0, 100.0}, 30.0).anchor, "end");
}

TEST(Plot, ThinningKeepsSinglePointSpikes) {
  Plot plot{"p", "", {"x", false}, {"y", false}, {Curve{}}, ""};
  for (int k = 0; k < 100'000; ++k) {
    plot.curves[0].x.push_back(k);
    plot.curves[0].y.push_back(k == 54'321 ? 1.0 : k == 76'543 ? -1.0 : 0.0);
  }
  const std::string svg = svg_of(plot, Place::page);
  EXPECT_LT(svg.size(), 60'000u);
  // The frame is 340 px high with 6 % of the range above and below.
  std::smatch match;
  const std::regex number("L[0-9.]+ ([0-9.]+)");
  double least = 1e9, most = 0.0;
  for (auto at = svg.cbegin(); std::regex_search(at, svg.cend(), match, number);
       at = match[0].second) {
    least = std::min(least, std::stod(match[1]));
    most = std::max(most, std::stod(match[1]));
  }
  EXPECT_NEAR(most - least, 340.0 / 1.12, 0.1);
}

TEST(PlotMap, DrawsACellPerNumberAndMarksMissingOnes) {
  Map map{"m", "", {"x", true}, {"y", false}, {1.0, 10.0, 100.0}, {0.0, 1.0}, {}, {}, ""};
  map.cells = {{0.0, 1.0, 0.5}, {kMissing, 0.25, 0.0}};
  const std::string svg = svg_of(map, Place::page);
  EXPECT_EQ(count(svg, "class=\"cell\""), 5u + 3u);      // plus three in the legend
  EXPECT_EQ(count(svg, "class=\"cell-dot\""), 3u + 2u);  // none where the value is 0
  EXPECT_EQ(count(svg, "class=\"none\""), 1u + 1u);
}

TEST(XmlText, EscapesMarkupAndReplacesInvalidCharacters) {
  EXPECT_EQ(escaped("<a b='c' d=\"e\">&"), "&lt;a b=&#39;c&#39; d=&quot;e&quot;&gt;&amp;");
  EXPECT_EQ(escaped("µ – 💡\t"), "µ – 💡\t");
  const std::string bad = "\xEF\xBF\xBD";
  EXPECT_EQ(escaped(std::string(1, '\0')), bad);
  EXPECT_EQ(escaped("\xff|"), bad + "|");
  EXPECT_EQ(escaped("\xC0\x80"), bad + bad);            // overlong
  EXPECT_EQ(escaped("\xED\xA0\x80"), bad + bad + bad);  // a surrogate
  EXPECT_EQ(escaped("\xEF\xBF\xBF"), bad + bad + bad);  // U+FFFF
  EXPECT_EQ(escaped("\xE2\x82"), bad + bad);            // cut off
}

}  // namespace
}  // namespace clay::test
