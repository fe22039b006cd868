#include "claystack/export/formats.hpp"

#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using shapes::pot_of;
using shapes::stack_of;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++times;
  return times;
}

/// The outlines of every path of a style, in px.
std::vector<std::vector<glm::dvec2>> outlines(const std::string& svg, const std::string& style) {
  const std::string opening = "<path class=\"" + style + "\" d=\"";
  std::vector<std::vector<glm::dvec2>> all;
  for (std::size_t at = svg.find(opening); at != svg.npos; at = svg.find(opening, at + 1)) {
    const std::size_t begin = at + opening.size();
    std::string d = svg.substr(begin, svg.find('"', begin) - begin);
    std::replace(d.begin(), d.end(), 'Z', ' ');
    std::istringstream loops(d);
    for (std::string loop; std::getline(loops, loop, 'M');) {
      std::istringstream numbers(loop);
      std::vector<glm::dvec2> outline;
      for (double x = 0.0, y = 0.0; numbers >> x >> y;) outline.emplace_back(x, y);
      if (!outline.empty()) all.push_back(std::move(outline));
    }
  }
  return all;
}

double area(const std::vector<glm::dvec2>& outline) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    doubled += a.x * b.y - b.x * a.y;
  }
  return std::abs(0.5 * doubled);
}

TEST(SectionSvg, ShowsTheDimensionsOfThePot) {
  const std::string svg =
      section_svg(pot_of(stack_of(2.5, {{20, 0}, {30, 25}, {25, 20}, {22, 18}})));
  EXPECT_EQ(svg.rfind("<svg xmlns=", 0), 0u);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
  EXPECT_EQ(count(svg, ">\u2300 60.0 mm</text>"), 1u);
  EXPECT_EQ(count(svg, ">10.0 mm</text>"), 1u);
  EXPECT_EQ(count(svg, "class=\"axis\""), 1u);
}

TEST(SectionSvg, DrawsBothHalvesToScale) {
  // 40 mm wide and 10 mm high; two thirds of the section is clay.
  const std::string svg = section_svg(pot_of(stack_of(5.0, {{20, 0}, {20, 40.0 / 3}})));
  const auto cut = outlines(svg, "cut");
  const auto beyond = outlines(svg, "beyond");
  ASSERT_EQ(cut.size(), 1u);  // both halves are connected: no seam on the axis
  ASSERT_EQ(beyond.size(), 1u);
  const double scale2 = area(beyond[0]) / (40.0 * 10.0);
  EXPECT_NEAR(area(cut[0]) / scale2, 40.0 * 5.0 + 2 * 20.0 / 3 * 5.0, 0.5);
}

TEST(SectionSvg, DrawsCavitiesAsSeparateOutlines) {
  const std::string svg =
      section_svg(pot_of(stack_of(2.0, {{10, 0}, {10, 4}, {10, 0}, {10, 6}, {10, 0}})));
  EXPECT_EQ(outlines(svg, "cut").size(), 3u);
  EXPECT_NE(svg.find("evenodd"), std::string::npos);
}

TEST(SectionSvg, DrawsOneOutlinePerSideOfTubesAndPieces) {
  EXPECT_EQ(outlines(section_svg(pot_of(stack_of(2.0, {{10, 5}}))), "cut").size(), 2u);
  EXPECT_EQ(outlines(section_svg(pot_of(stack_of(2.0, {{10, 5}, {4, 0}}))), "cut").size(), 3u);
}

TEST(SectionSvg, DrawsTheFallenPartRotated) {
  // Sections of two cubes, 20 x 10 mm; the upper one rotates by 90 degrees about its lower right
  // corner, toward the left, and then extends from 0 to 10 mm across and from -10 to 10 mm up.
  Pot pot = pot_of(stack_of(10.0, {{10, 0}, {10, 0}}));
  pot.collapse = Collapse{0, {0, 10, 10}, {-1, 0, 0}, std::numbers::pi / 2, 1.0};
  const std::string svg = section_svg(pot);
  const auto cut = outlines(svg, "cut");
  ASSERT_EQ(cut.size(), 2u);
  const auto [low, high] =
      std::minmax_element(cut[0].begin(), cut[0].end(), [](auto a, auto b) { return a.x < b.x; });
  const double scale = (high->x - low->x) / 20.0;
  const double middle = 0.5 * (high->x + low->x), floor = std::max(cut[0][0].y, cut[0][1].y);
  glm::dvec2 least{1e9}, most{-1e9};
  for (const glm::dvec2& p : cut[1]) {
    const glm::dvec2 mm{(p.x - middle) / scale, (floor - p.y) / scale};
    least = glm::min(least, mm);
    most = glm::max(most, mm);
  }
  EXPECT_NEAR(least.x, 0.0, 0.01);
  EXPECT_NEAR(most.x, 10.0, 0.01);
  EXPECT_NEAR(least.y, -10.0, 0.01);
  EXPECT_NEAR(most.y, 10.0, 0.01);
}

TEST(SectionSvg, DrawsAFallenCrownAtItsRestingPlace) {
  // 4 mm of crown, above 10 mm of ring that stays; it falls by 10 mm, 30 mm to the right.
  Pot pot = pot_of(stack_of(10.0, {{10, 0}}, quanta_from_radius(10) * 4 / 10));
  pot.collapse = Collapse{0, {12, 10, 0}, {0, 0, 1}, 0.0, 1.0, {30, -10, 0}};
  const auto cut = outlines(section_svg(pot), "cut");
  ASSERT_EQ(cut.size(), 2u);
  const auto box = [&](std::size_t k) {
    glm::dvec2 least{1e9}, most{-1e9};
    for (const glm::dvec2& p : cut[k]) {
      least = glm::min(least, p);
      most = glm::max(most, p);
    }
    return std::pair{least, most};
  };
  const auto [ring_low, ring_high] = box(0);
  const auto [crown_low, crown_high] = box(1);
  const double scale = (ring_high.x - ring_low.x) / 20.0;
  EXPECT_NEAR((ring_high.y - ring_low.y) / scale, 10.0, 0.01);
  EXPECT_NEAR((crown_high.y - crown_low.y) / scale, 4.0, 0.01);
  EXPECT_NEAR((crown_low.x - ring_low.x) / scale, 30.0, 0.01);
  EXPECT_NEAR(crown_high.y, ring_high.y, 0.01);
}

TEST(SectionSvg, DrawsThePathOfFallDashed) {
  Pot pot = pot_of(stack_of(10.0, {{10, 0}, {10, 0}, {10, 0}}));
  pot.collapse = Collapse{0, {0, 10, 0}, {0, 0, 1}, 0.0, 1.0, {0, -10, 0}};
  EXPECT_EQ(outlines(section_svg(pot), "ghost").size(), 0u);  // the path of fall is unknown
  pot.collapse->threshold_kpa = 0.1;                          // half of its weight
  const auto ghosts = outlines(section_svg(pot), "ghost");
  ASSERT_EQ(ghosts.size(), 4u);
  // Before the collapse, and after each quarter of the descent: all 20 mm high, to within a step.
  const auto foot = [](const std::vector<glm::dvec2>& outline) {
    return std::max_element(outline.begin(), outline.end(),
                            [](auto a, auto b) { return a.y < b.y; })
        ->y;
  };
  const double way = foot(outlines(section_svg(pot), "cut")[0]) - foot(ghosts[0]);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR((foot(ghosts[k]) - foot(ghosts[0])) / way, 0.25 * static_cast<double>(k), 0.02);
}

TEST(SectionSvg, DrawsPotsThatHaveNoSolid) {
  const std::string svg = section_svg(pot_of(stack_of(2.0, {{5, 0}, {9, 5}})));
  EXPECT_EQ(outlines(svg, "cut").size(), 3u);
  EXPECT_NE(section_svg(Pot{}).find("</svg>"), std::string::npos);
}

TEST(SectionSvg, HugeStackGivesASmallFile) {
  EXPECT_LT(section_svg(pot_of(shapes::vase(100'000))).size(), 500'000u);
}

}  // namespace
}  // namespace clay::solid
