#include "app/import/joined_lines.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>

namespace clay::importing {
namespace {

bool same(glm::dvec2 a, glm::dvec2 b) { return glm::length(a - b) <= kSamePointMm; }

/// Removes from `rest` a line that begins or ends at the end of `chain`, and appends it to `chain`.
bool extend(std::vector<glm::dvec2>& chain, std::vector<Line>& rest) {
  const auto next = std::find_if(rest.begin(), rest.end(), [&](const Line& line) {
    return same(line.points_mm.front(), chain.back()) || same(line.points_mm.back(), chain.back());
  });
  if (next == rest.end()) return false;
  std::vector<glm::dvec2>& points = next->points_mm;
  if (!same(points.front(), chain.back())) std::reverse(points.begin(), points.end());
  chain.insert(chain.end(), std::next(points.begin()), points.end());
  rest.erase(next);
  return true;
}

}  // namespace

std::vector<Line> joined(std::vector<Line> lines) {
  std::vector<Line> whole, open;
  for (Line& line : lines) {
    if (line.points_mm.size() < 2) continue;
    (line.closed ? whole : open).push_back(std::move(line));
  }
  while (!open.empty()) {
    Line chain = std::move(open.back());
    open.pop_back();
    while (extend(chain.points_mm, open)) {
    }
    std::reverse(chain.points_mm.begin(), chain.points_mm.end());
    while (extend(chain.points_mm, open)) {
    }
    if (chain.points_mm.size() > 3 && same(chain.points_mm.front(), chain.points_mm.back())) {
      chain.points_mm.pop_back();
      chain.closed = true;
    }
    whole.push_back(std::move(chain));
  }
  return whole;
}

}  // namespace clay::importing
