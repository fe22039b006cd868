#include "app/import/outline_faults.hpp"

#include "app/import/deviation.hpp"
#include "app/import/joined_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace clay::importing {

bool mirrored_within(const std::vector<Line>& lines, double middle_mm, double within_mm) {
  std::vector<Segment> outline;
  std::vector<glm::dvec2> images;
  for_each_piece(lines, [&](glm::dvec2 a, glm::dvec2 b) {
    outline.push_back({a, b});
    for (const glm::dvec2& p : {a, 0.5 * (a + b), b})
      images.emplace_back(2.0 * middle_mm - p.x, p.y);
  });
  return std::ranges::all_of(distances_from(outline, images),
                             [&](double mm) { return mm <= within_mm; });
}

bool nearly_mirrored(const std::vector<Line>& lines, double middle_mm) {
  double half_mm = 0.0;
  for (const Line& line : lines)
    for (const glm::dvec2& p : line.points_mm)
      half_mm = std::max(half_mm, std::abs(p.x - middle_mm));
  return mirrored_within(lines, middle_mm, 0.04 * half_mm);
}

bool edge_along(const std::vector<Line>& lines, double x_mm) {
  bool found = false;
  for_each_piece(lines, [&](glm::dvec2 a, glm::dvec2 b) {
    found = found || (std::abs(a.x - x_mm) <= kSamePointMm &&
                      std::abs(b.x - x_mm) <= kSamePointMm && std::abs(a.y - b.y) > kSamePointMm);
  });
  return found;
}

std::optional<Gap> narrowest_gap(const std::vector<Line>& lines) {
  constexpr std::size_t kMostCompared = 1000;  // a drawing has few ends; of more, neighbours only
  std::vector<glm::dvec2> ends;
  for (const Line& line : lines) {
    if (line.closed) continue;
    for (const glm::dvec2& p : {line.points_mm.front(), line.points_mm.back()})
      if (p.x > kSamePointMm) ends.push_back(p);
  }
  std::sort(ends.begin(), ends.end(), [](glm::dvec2 a, glm::dvec2 b) { return a.y < b.y; });
  std::optional<Gap> narrowest;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t k = i + 1; k < std::min(ends.size(), i + kMostCompared); ++k) {
      const double mm = glm::length(ends[k] - ends[i]);
      if (!narrowest || mm < narrowest->mm) narrowest = Gap{ends[i], ends[k], mm};
      if (ends[k].y - ends[i].y > narrowest->mm) break;
    }
  return narrowest;
}

std::string clay_between(std::span<const double> radii_mm) {
  constexpr std::size_t kMostBounds = 8;
  std::string text;
  const std::size_t count = radii_mm.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = count - 1 - k;  // from the axis outward
    const bool ends = i % 2 == 0;
    if (k >= kMostBounds && !ends) return text + " and more";
    if (k == 0 && ends) text += "from the axis";
    text += fmt::format("{}{:.3f}{}",
                        ends    ? " to "
                        : k > 0 ? " and from "
                                : "from ",
                        radii_mm[i], ends ? " mm" : "");
  }
  return text;
}

}  // namespace clay::importing
