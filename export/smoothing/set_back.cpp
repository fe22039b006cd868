#include "export/smoothing/set_back.hpp"

#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/section/simplify_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace clay::solid::inline smoothing {
namespace {

constexpr int kDeepest = 12;           ///< halvings between two known heights
constexpr double kBeside = 1e-9;       ///< of a jump, on either side [mm]
constexpr double kNearest = 1e-4;      ///< heights closer than this count once [mm]
constexpr double kLipStep = 1.0 / 16;  ///< of the search for the rim, in distances

/// A wall that rises with the clay at smaller radii, set back by a disc: at each height, the
/// smallest radius that a disc about a point of the wall reaches.
class SetBackWall {
 public:
  SetBackWall(const Polygon& line, double distance_mm) : line_(line), distance_mm_(distance_mm) {}

  [[nodiscard]] double at(double y) const {
    double least = std::numeric_limits<double>::infinity();
    auto edge = std::ranges::lower_bound(line_, y - distance_mm_ - kBeside, {}, &ProfilePoint::y);
    if (edge != line_.begin()) --edge;
    for (; edge + 1 < line_.end() && edge->y <= y + distance_mm_ + kBeside; ++edge)
      least = std::min(least, reached(edge[0], edge[1], y));
    return least;
  }

  /// Between two heights, within the tolerance.
  [[nodiscard]] Polygon line(double low, double high, double tolerance_mm) const {
    Polygon points{{at(low), low}};
    for (const Stop& stop : stops(low, high)) {
      step_of_loop();
      if (!stop.jump && stop.y - points.back().y < kNearest) continue;
      const double aside = stop.jump ? kBeside : 0.0;
      refine(points, {at(stop.y - aside), stop.y}, 0.25 * tolerance_mm, 0);
      if (stop.jump) points.push_back({at(stop.y + aside), stop.y});
    }
    refine(points, {at(high), high}, 0.25 * tolerance_mm, 0);
    std::vector<double> tolerances(points.size(), 0.5 * tolerance_mm);
    tolerances.front() = tolerances.back() = 0.0;
    return simplified(points, tolerances);
  }

 private:
  struct Stop {
    double y = 0.0;
    bool jump = false;
  };

  [[nodiscard]] double reached(const ProfilePoint& a, const ProfilePoint& b, double y) const {
    const double length = std::hypot(b.rho - a.rho, b.y - a.y);
    const double out_rho = (b.y - a.y) / length, out_y = (a.rho - b.rho) / length;
    const double touch = y + distance_mm_ * out_y;
    if (a.y < touch && touch < b.y)
      return a.rho + (b.rho - a.rho) * (touch - a.y) / (b.y - a.y) - distance_mm_ * out_rho;
    return std::min(reached(a, y), reached(b, y));
  }
  [[nodiscard]] double reached(const ProfilePoint& p, double y) const {
    const double up = p.y - y;
    if (std::abs(up) > distance_mm_ + 0.5 * kBeside) return std::numeric_limits<double>::infinity();
    return p.rho - std::sqrt(std::max(distance_mm_ * distance_mm_ - up * up, 0.0));
  }

  /// Heights at which the curve changes from an edge to a corner; beyond a tread it jumps.
  [[nodiscard]] std::vector<Stop> stops(double low, double high) const {
    std::vector<Stop> found;
    const auto add = [&](double y, bool jump) {
      if (low + kBeside < y && y < high - kBeside) found.push_back({y, jump});
    };
    for (std::size_t i = 0; i + 1 < line_.size(); ++i) {
      const ProfilePoint &a = line_[i], &b = line_[i + 1];
      if (a.y == b.y) {
        add(a.y - distance_mm_, true);
        add(a.y + distance_mm_, true);
        continue;
      }
      const double up = distance_mm_ * (b.rho - a.rho) / std::hypot(b.rho - a.rho, b.y - a.y);
      for (const double y : {a.y, b.y, a.y + up, b.y + up}) add(y, false);
    }
    std::ranges::sort(found, {}, &Stop::y);
    return found;
  }

  /// Appends the curve from the last point to `end`.
  void refine(Polygon& points, const ProfilePoint& end, double error_mm, int depth) const {
    const ProfilePoint begin = points.back();
    const double y = 0.5 * (begin.y + end.y), rho = at(y);
    if (depth < kDeepest && std::abs(rho - 0.5 * (begin.rho + end.rho)) > error_mm) {
      refine(points, {rho, y}, error_mm, depth + 1);
      refine(points, end, error_mm, depth + 1);
    } else {
      points.push_back(end);
    }
  }

  const Polygon& line_;
  double distance_mm_;
};

tl::unexpected<Error> wrong(const std::string& why) {
  return failure(ErrorKind::bad_input, "glaze allowance: expected " + why);
}

}  // namespace

Result<Polygon> set_back(const WallLines& lines, double distance_mm, double tolerance_mm) {
  const auto off_axis = [](const ProfilePoint& p) { return p.rho > 0.0; };
  const auto floor = std::ranges::find_if(lines.bore, off_axis);
  if (!std::all_of(floor, lines.bore.end(), off_axis))
    return wrong("a pot that is open above and solid below its floor");
  const bool solid = floor == lines.bore.end(), open_below = floor == lines.bore.begin();
  const double low = lines.outer.front().y;
  const double bottom = solid || open_below ? low : floor->y - distance_mm;
  double top = lines.outer.back().y - distance_mm;
  if (!open_below && !((solid ? top : bottom) > low))
    return wrong("a floor thicker than " + nine_digit_text(distance_mm) + " mm");

  const Polygon bore_line = mirrored({floor, lines.bore.end()});
  const SetBackWall outer(lines.outer, distance_mm), bore(bore_line, distance_mm);
  const auto width = [&](double y) { return solid ? 2.0 * outer.at(y) : outer.at(y) + bore.at(y); };
  double narrow = top;
  while (top > bottom && width(top) < kLeastRimMm)
    narrow = std::exchange(top, top - kLipStep * distance_mm);
  while (narrow - top > kNearest) {
    const double middle = 0.5 * (narrow + top);
    (width(middle) < kLeastRimMm ? narrow : top) = middle;
  }
  if (!(top > bottom)) return wrong("walls thicker than twice the allowance");
  if (solid) return outline_of({outer.line(low, top, tolerance_mm), {{0.0, low}, {0.0, top}}});
  Polygon inside = mirrored(bore.line(bottom, top, tolerance_mm));
  if (!open_below) inside.insert(inside.begin(), {{0.0, low}, {0.0, bottom}});
  return outline_of({outer.line(low, top, tolerance_mm), std::move(inside)});
}

}  // namespace clay::solid::inline smoothing
