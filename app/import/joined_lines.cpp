#include "app/import/joined_lines.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace clay::importing {
namespace {

bool same(glm::dvec2 a, glm::dvec2 b) { return glm::length(a - b) <= kSamePointMm; }

/// One end of an open line.
struct End {
  std::size_t line = 0;
  bool first = false;
};

/// The ends of the lines that are not yet part of a chain, by their cells.
class LooseEnds {
 public:
  explicit LooseEnds(const std::vector<Line>& lines) : lines_(lines), places_(2 * lines.size()) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (const bool first : {true, false}) {
        std::vector<End>& ends = cells_[cell_of(point({i, first}))];
        place({i, first}) = ends.size();
        ends.push_back({i, first});
      }
    }
  }

  void remove(std::size_t line) {
    remove({line, true});
    remove({line, false});
  }

  /// The end nearest to `p` among those that are the same point.
  [[nodiscard]] std::optional<End> nearest(glm::dvec2 p) const {
    std::optional<End> best;
    double best_mm = kSamePointMm;
    const Cell middle = cell_of(p);
    for (const int across : {-1, 0, 1}) {
      for (const int up : {-1, 0, 1}) {
        const auto cell = cells_.find({middle.first + across, middle.second + up});
        if (cell == cells_.end()) continue;
        // A drawing has few ends at one place. Of very many, only the last are compared.
        const std::size_t count = cell->second.size();
        for (std::size_t i = count - std::min(count, kMostCompared); i < count; ++i) {
          const double mm = glm::length(point(cell->second[i]) - p);
          if (mm > best_mm || (mm == best_mm && best)) continue;
          best = cell->second[i];
          best_mm = mm;
        }
      }
    }
    return best;
  }

 private:
  static constexpr std::size_t kMostCompared = 64;

  [[nodiscard]] glm::dvec2 point(const End& end) const {
    const std::vector<glm::dvec2>& points = lines_[end.line].points_mm;
    return end.first ? points.front() : points.back();
  }

  std::size_t& place(const End& end) { return places_[2 * end.line + (end.first ? 0 : 1)]; }

  void remove(const End& end) {
    std::vector<End>& ends = cells_[cell_of(point(end))];
    const End last = ends.back();
    ends[place(end)] = last;
    place(last) = place(end);
    ends.pop_back();
  }

  const std::vector<Line>& lines_;
  std::vector<std::size_t> places_;  ///< of each end in its cell
  std::map<Cell, std::vector<End>> cells_;
};

/// Appends loose lines to the end of `chain` as long as one continues it.
void extend(std::vector<glm::dvec2>& chain, const std::vector<Line>& lines, LooseEnds& loose,
            std::vector<bool>& used) {
  while (const auto next = loose.nearest(chain.back())) {
    const std::vector<glm::dvec2>& points = lines[next->line].points_mm;
    if (next->first)
      chain.insert(chain.end(), std::next(points.begin()), points.end());
    else
      chain.insert(chain.end(), std::next(points.rbegin()), points.rend());
    loose.remove(next->line);
    used[next->line] = true;
  }
}

/// The cells of a line's points, the same for equal lines.
std::vector<Cell> cells_along(const Line& line) {
  std::vector<Cell> cells;
  std::ranges::transform(line.points_mm, std::back_inserter(cells), cell_of);
  std::vector<Cell> reversed(cells.rbegin(), cells.rend());
  if (line.closed)
    for (std::vector<Cell>* loop : {&cells, &reversed})
      std::rotate(loop->begin(), std::min_element(loop->begin(), loop->end()), loop->end());
  return std::min(cells, reversed);
}

bool a_point(const Line& line) {
  return std::all_of(line.points_mm.begin(), line.points_mm.end(),
                     [&](glm::dvec2 p) { return p == line.points_mm.front(); });
}

}  // namespace

Cell cell_of(glm::dvec2 p) {
  return {std::llround(p.x / kSamePointMm), std::llround(p.y / kSamePointMm)};
}

std::size_t remove_repeats(std::vector<Line>& lines) {
  std::set<std::pair<bool, std::vector<Cell>>> drawn;
  return std::erase_if(lines, [&](const Line& line) {
    return !drawn.emplace(line.closed, cells_along(line)).second;
  });
}

std::vector<Line> joined(std::vector<Line> lines) {
  std::vector<Line> whole, open;
  for (Line& line : lines) {
    if (a_point(line)) continue;
    (line.closed ? whole : open).push_back(std::move(line));
  }
  LooseEnds loose(open);
  std::vector<bool> used(open.size(), false);
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (used[i]) continue;
    loose.remove(i);
    Line chain{open[i].points_mm, false};
    extend(chain.points_mm, open, loose, used);
    std::reverse(chain.points_mm.begin(), chain.points_mm.end());
    extend(chain.points_mm, open, loose, used);
    if (chain.points_mm.size() > 3 && same(chain.points_mm.front(), chain.points_mm.back())) {
      chain.points_mm.pop_back();
      chain.closed = true;
    }
    whole.push_back(std::move(chain));
  }
  return whole;
}

}  // namespace clay::importing
