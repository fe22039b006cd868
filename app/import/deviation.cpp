#include "app/import/deviation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace clay::importing {
namespace {

double distance(const Segment& segment, glm::dvec2 p) {
  const glm::dvec2 along = segment.to - segment.from;
  const double square = glm::dot(along, along);
  const double part =
      square > 0.0 ? std::clamp(glm::dot(p - segment.from, along) / square, 0.0, 1.0) : 0.0;
  return glm::length(p - segment.from - part * along);
}

/// The clay at one level, from the bore to the outer bound; no clay if they are equal.
using Width = std::pair<double, double>;

/// The level parts of the outline: where there is clay on one side only.
void add_treads(std::vector<Segment>& outline, double y, Width below, Width above) {
  const auto add = [&](double from, double to) {
    if (to > from) outline.push_back({{from, y}, {to, y}});
  };
  if (std::max(below.first, above.first) >= std::min(below.second, above.second)) {
    add(below.first, below.second);
    add(above.first, above.second);
    return;
  }
  add(std::min(below.first, above.first), std::max(below.first, above.first));
  add(std::min(below.second, above.second), std::max(below.second, above.second));
}

struct Nearest {
  double mm = 1e300;
  const Segment* segment = nullptr;
};

/// An outline by height, for nearest points. The outline must outlive it.
class Levels {
 public:
  explicit Levels(const std::vector<Segment>& outline) {
    double rise_mm = 0.0;
    for (const Segment& s : outline) {
      low_ = std::min({low_, s.from.y, s.to.y});
      high_ = std::max({high_, s.from.y, s.to.y});
      rise_mm += std::abs(s.to.y - s.from.y);
    }
    // Each segment is in every row that it crosses: about 16 rows on average, at most.
    constexpr double kCrossed = 16.0;
    const double share = std::min(1.0, kCrossed * (high_ - low_) / std::max(rise_mm, 1e-9));
    const double rows = share * static_cast<double>(outline.size());
    rows_.resize(static_cast<std::size_t>(std::clamp(rows, 1.0, 100'000.0)));
    row_mm_ = std::max((high_ - low_) / static_cast<double>(rows_.size()), 1e-9);
    for (const Segment& s : outline)
      for (std::size_t row = row_at(std::min(s.from.y, s.to.y));
           row <= row_at(std::max(s.from.y, s.to.y)); ++row)
        rows_[row].push_back(&s);
    boxes_.resize(2 * rows_.size() - 1);
    set_box({0, 0, rows_.size()});
  }

  [[nodiscard]] Nearest nearest(glm::dvec2 p) const {
    Search search{p, row_at(p.y), {}, 0};
    const auto above = [&](std::size_t i) {
      return i < rows_.size() && bottom(i) - p.y < search.best.mm;
    };
    const auto below = [&](std::size_t i) { return i > 0 && p.y - bottom(i) < search.best.mm; };
    // Most points are near the outline. For those far from it, the rows are too many.
    constexpr std::size_t kBeside = 16;
    std::size_t up = search.start, down = search.start;
    for (; up < search.start + kBeside && above(up); ++up) search_row(up, search);
    for (; down + kBeside > search.start && below(down); --down) search_row(down - 1, search);
    if (above(up) || below(down)) search_rows({0, 0, rows_.size()}, search);
    return search.best;
  }

 private:
  /// A range of neighbouring rows: a node of a binary tree that halves it down to single rows.
  /// `boxes_` holds the tree in preorder: a range, its lower half with all parts of that, its upper
  /// half.
  struct Rows {
    std::size_t number = 0, first = 0, count = 0;

    [[nodiscard]] std::size_t half() const { return count / 2; }
    [[nodiscard]] Rows lower() const { return {number + 1, first, half()}; }
    [[nodiscard]] Rows upper() const {
      return {number + 2 * half(), first + half(), count - half()};
    }
  };

  struct Box {
    glm::dvec2 low{1e300}, high{-1e300};

    [[nodiscard]] double distance_from(glm::dvec2 p) const {
      return glm::length(glm::max(glm::max(low - p, p - high), glm::dvec2(0.0)));
    }
  };

  struct Search {
    glm::dvec2 p{0.0};
    std::size_t start = 0;  ///< the row of p
    Nearest best;
    std::size_t rank = 0;  ///< of the row of `best`
  };

  Box set_box(const Rows& rows) {
    Box box;
    if (rows.count > 1) {
      const Box lower = set_box(rows.lower()), upper = set_box(rows.upper());
      box = {glm::min(lower.low, upper.low), glm::max(lower.high, upper.high)};
    } else {
      for (const Segment* s : rows_[rows.first]) {
        box.low = glm::min(box.low, glm::min(s->from, s->to));
        box.high = glm::max(box.high, glm::max(s->from, s->to));
      }
      // The rest of a segment is in other rows.
      const double margin_mm = 1e-6 * row_mm_;
      box.low.y = std::max(box.low.y, bottom(rows.first) - margin_mm);
      box.high.y = std::min(box.high.y, bottom(rows.first + 1) + margin_mm);
    }
    return boxes_[rows.number] = box;
  }

  [[nodiscard]] double bottom(std::size_t row) const {
    return low_ + static_cast<double>(row) * row_mm_;
  }
  [[nodiscard]] std::size_t row_at(double y) const {
    const double row = std::clamp((y - low_) / row_mm_, 0.0, static_cast<double>(rows_.size() - 1));
    return static_cast<std::size_t>(row);
  }

  /// Of segments at one distance, the nearest is that of the first row from `start` upward, then
  /// downward.
  void search_row(std::size_t row, Search& search) const {
    const std::size_t rank =
        row >= search.start ? row - search.start : rows_.size() + search.start - row;
    for (const Segment* s : rows_[row]) {
      const double mm = distance(*s, search.p);
      if (mm > search.best.mm || (mm == search.best.mm && rank >= search.rank)) continue;
      search.best = {mm, s};
      search.rank = rank;
    }
  }

  void search_rows(const Rows& rows, Search& search) const {
    if (rows.count == 1) return search_row(rows.first, search);
    constexpr double kRoundingMm = 1e-9;
    std::array parts{rows.lower(), rows.upper()};
    std::array<double, 2> away_mm{};
    for (std::size_t i = 0; i < 2; ++i)
      away_mm[i] = boxes_[parts[i].number].distance_from(search.p) - kRoundingMm;
    const std::size_t nearer = away_mm[1] < away_mm[0] ? 1 : 0;
    for (const std::size_t i : {nearer, 1 - nearer})
      if (away_mm[i] <= search.best.mm) search_rows(parts[i], search);
  }

  double low_ = 1e300, high_ = -1e300, row_mm_ = 1.0;
  std::vector<std::vector<const Segment*>> rows_;
  std::vector<Box> boxes_;  ///< of the parts of the rows
};

/// A part of an outline, with the nearest segments of the other outline to its ends.
struct Part {
  Segment segment;
  Nearest from, to;
};

/// Upper bound of the distance of the part from the other outline. The distance to one segment is
/// convex along a line, and the distance to the nearest one changes by at most the length of the
/// way.
double farthest_in(const Part& part) {
  const auto& [segment, from, to] = part;
  const double both = std::min(std::max(from.mm, distance(*from.segment, segment.to)),
                               std::max(to.mm, distance(*to.segment, segment.from)));
  return std::min(both, 0.5 * (from.mm + to.mm + glm::length(segment.to - segment.from)));
}

/// Finds the largest distance from `outline` to `other`.
void widen(Deviation& worst, const std::vector<Segment>& outline, const Levels& other) {
  const auto measure = [&](glm::dvec2 p) {
    const Nearest nearest = other.nearest(p);
    if (nearest.mm > worst.mm) worst = {nearest.mm, p.x, p.y};
    return nearest;
  };
  std::vector<Part> parts;
  for (const Segment& segment : outline) {
    parts.push_back({segment, measure(segment.from), measure(segment.to)});
    while (!parts.empty()) {
      const Part part = parts.back();
      parts.pop_back();
      if (farthest_in(part) <= worst.mm + kDeviationStepMm) continue;
      const glm::dvec2 middle = 0.5 * (part.segment.from + part.segment.to);
      const Nearest nearest = measure(middle);
      parts.push_back({{part.segment.from, middle}, part.from, nearest});
      parts.push_back({{middle, part.segment.to}, nearest, part.to});
    }
  }
}

}  // namespace

std::vector<Segment> outline_of(std::span<const Slab> slabs) {
  std::vector<Segment> outline;
  outline.reserve(4 * slabs.size() + 1);
  Width below{0.0, 0.0};
  for (const Slab& slab : slabs) {
    add_treads(outline, slab.from_mm, below, {slab.inner_from_mm, slab.outer_from_mm});
    outline.push_back({{slab.outer_from_mm, slab.from_mm}, {slab.outer_to_mm, slab.to_mm}});
    if (slab.inner_from_mm > 0.0 || slab.inner_to_mm > 0.0)
      outline.push_back({{slab.inner_from_mm, slab.from_mm}, {slab.inner_to_mm, slab.to_mm}});
    below = {slab.inner_to_mm, slab.outer_to_mm};
  }
  if (!slabs.empty()) add_treads(outline, slabs.back().to_mm, below, {0.0, 0.0});
  return outline;
}

std::vector<double> distances_from(const std::vector<Segment>& outline,
                                   std::span<const glm::dvec2> points) {
  std::vector<double> distances(points.size(), std::numeric_limits<double>::infinity());
  if (outline.empty()) return distances;
  const Levels levels(outline);
  std::transform(points.begin(), points.end(), distances.begin(),
                 [&](glm::dvec2 p) { return levels.nearest(p).mm; });
  return distances;
}

Deviation deviation_between(const std::vector<Segment>& a, const std::vector<Segment>& b) {
  Deviation worst;
  if (a.empty() || b.empty()) return worst;
  const Levels in_a(a), in_b(b);
  widen(worst, a, in_b);
  widen(worst, b, in_a);
  return worst;
}

Deviation deviation_between(std::span<const Slab> a, std::span<const Slab> b) {
  return deviation_between(outline_of(a), outline_of(b));
}

double rounded_to(double value, double step) { return std::round(value / step) * step + 0.0; }

std::string text_of(const Deviation& deviation, std::string_view from) {
  return fmt::format(
      "largest deviation from the {}: {:.3f} mm, {:.2f} mm from the axis and {:.2f} mm above the "
      "foot",
      from, deviation.mm, deviation.radius_mm, rounded_to(deviation.height_mm, 0.01));
}

}  // namespace clay::importing
