#include "app/strokes/planned.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace clay::strokes {
namespace {

constexpr double kStepMm = 0.5;   // between the points of a planned path
constexpr double kAwayMm = 8.0;   // a tool that leaves the clay goes this far
constexpr double kClearMm = 2.0;  // and passes clay at this distance
constexpr double kCloseS = 0.6;  // two fingers close on the wall, and then gather speed for as long
constexpr double kSpareMm = 0.3;  // above the least wall
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The pot's section at one moment.
class Section {
 public:
  explicit Section(const ClayStack& stack) : height_(stack.height_mm()) {
    const double h = stack.ring_height_mm();
    for (const Ring& ring : stack.rings()) {
      outer_.push_back(ring.outer_mm());
      inner_.push_back(ring.inner_mm());
    }
    per_ring_ = 1.0 / h;
  }
  [[nodiscard]] double height() const { return height_; }
  [[nodiscard]] double surface(bool inside, double up) const {
    const auto& radii = inside ? inner_ : outer_;
    const double level = std::clamp(up * per_ring_, 0.0, static_cast<double>(radii.size() - 1));
    return radii[static_cast<std::size_t>(level)];
  }

 private:
  std::vector<double> outer_, inner_;
  double height_, per_ring_ = 1.0;
};

/// The outline's distance from the axis at a height; beyond its ends, that of the end.
double along(const std::vector<glm::dvec2>& outline, double up) {
  const bool rising = outline.back().y > outline.front().y;
  const auto at = [&](std::size_t k) {
    return rising ? outline[k] : outline[outline.size() - 1 - k];
  };
  if (up <= at(0).y) return at(0).x;
  for (std::size_t k = 1; k < outline.size(); ++k)
    if (up < at(k).y)
      return at(k - 1).x + (at(k).x - at(k - 1).x) * (up - at(k - 1).y) / (at(k).y - at(k - 1).y);
  return at(outline.size() - 1).x;
}

/// A smooth curve through the points; heights in mm.
std::vector<glm::dvec2> curve_of(const Stroke& stroke, double height_mm) {
  Path points;
  for (const glm::dvec2& point : stroke.outline)
    points.push_back({{point.x, stroke.outline_in_mm ? point.y : point.y * height_mm}, 0.0});
  std::vector<glm::dvec2> curve;
  for (const Place& place : spline(points)) curve.push_back(place.at);
  return curve;
}

using Surface = std::function<double(double)>;

/// The distance from the axis at which a tool at height `up` touches a surface and cuts nowhere
/// into it; none beside the pot, or where the tool does not fit. Above the rim there is no surface.
std::optional<double> touching(const Tool& tool, double up, double rim, bool inside,
                               const Surface& surface) {
  constexpr int kParts = 64;
  double at = inside ? kInfinity : -1.0;
  for (int k = 0; k <= kParts; ++k) {
    const double t = tool.low() + (tool.high() - tool.low()) * k / kParts, level = up + t;
    if (level < 0.0 || level > rim) continue;
    at = inside ? std::min(at, surface(level) - tool.radius(t))
                : std::max(at, surface(level) + tool.radius(t));
  }
  if (at < 0.0 || at == kInfinity) return std::nullopt;
  return at;
}

/// The places of a tool that moves along a surface between two heights.
Path touching_path(const Tool& tool, double from, double to, double rim, bool inside,
                   const Surface& surface) {
  const int count = std::max(1, static_cast<int>(std::abs(to - from) / kStepMm));
  Path path;
  for (int k = 0; k <= count; ++k) {
    const double up = from + (to - from) * k / count;
    if (const auto at = touching(tool, up, rim, inside, surface)) path.push_back({{*at, up}, 0.0});
  }
  return path;
}

/// The widest line down the bore that a tool can take to a height: `kClearMm` from the clay, or the
/// axis if the bore is narrower. None where less than half of that distance is free.
std::optional<double> free_line(const Tool& tool, const Section& section, double down_to) {
  const Surface bore = [&](double up) { return section.surface(true, up); };
  double line = kInfinity;
  for (double up = down_to; up < section.height() + tool.high(); up += kStepMm)
    line = std::min(line, touching(tool, up, section.height(), true, bore).value_or(0.0));
  if (line < 0.5 * kClearMm) return std::nullopt;
  return std::max(0.0, line - kClearMm);
}

/// Plays a path with its way in and out; inside a pot, those lead through its mouth.
void lead(Hand& hand, Path path, const Section& section, bool inside, const Stroke& stroke) {
  if (path.empty()) return;
  const Tool& tool = hand.wheel().plan().tool;
  const double out = inside ? -kAwayMm : kAwayMm;
  const auto beside = [&](const Place& place) {
    return Place{{std::max(0.0, place.at.x + out), place.at.y}, 0.0};
  };
  const Place enter = beside(path.front()), leave = beside(path.back());
  path.push_back(leave);
  if (!inside) {
    // Rises and descends beside the pot, which may be wider above.
    const glm::dvec2 start = hand.script().start_mm;
    approach(hand, {start.x, enter.at.y});
    hand.travel({hand.here(), enter});
    path.insert(path.begin(), enter);
    hand.move(path, stroke.speed_mm_s, stroke.trim);
    hand.hold(stroke.hold_s, stroke.trim);
    hand.travel({hand.here(), {{start.x, leave.at.y}, 0.0}, {start, 0.0}});
    return;
  }
  const double top = section.height() + tool.high() + kClearMm;
  const double line = free_line(tool, section, std::min(enter.at.y, leave.at.y)).value_or(0.0);
  approach(hand, {line, std::max(top, enter.at.y)});
  hand.travel({hand.here(), {{line, enter.at.y}, 0.0}});
  path.insert(path.begin(), hand.here());
  hand.move(path, stroke.speed_mm_s, stroke.trim);
  hand.hold(stroke.hold_s, stroke.trim);
  hand.travel({hand.here(), {{line, leave.at.y}, 0.0}, {{line, std::max(top, leave.at.y)}, 0.0}});
}

double smooth(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

double gap_at(const Stroke& stroke, double share) {
  const double low = stroke.gap_mm.front(), high = stroke.gap_mm.back();
  return low + (high - low) * std::clamp(share, 0.0, 1.0);
}

}  // namespace

void approach(Hand& hand, glm::dvec2 first_mm) {
  const StrokeScript& script = hand.script();
  if (hand.here().at != script.start_mm) hand.travel({{hand.here().at}, {script.start_mm}});
  hand.travel({{script.start_mm}, {first_mm}});
}

void shape(Hand& hand, const Stroke& stroke, int pass) {
  const Section section(hand.wheel().stack());
  const Tool& tool = hand.wheel().plan().tool;
  const auto goal = curve_of(stroke, section.height());
  const double low = std::min(goal.front().y, goal.back().y);
  const double high = std::max(goal.front().y, goal.back().y);
  const double part = 1.0 / (stroke.passes - pass), inward = stroke.inside ? 1.0 : -1.0;
  const Surface surface = [&](double up) {
    const double now = section.surface(stroke.inside, up);
    if (up < low || up > high) return now;
    const double by = along(goal, up) - now;
    return now + (by * inward > 0.0 ? by * part : by);
  };
  lead(hand,
       touching_path(tool, goal.front().y, goal.back().y, section.height(), stroke.inside, surface),
       section, stroke.inside, stroke);
}

void pull(Hand& hand, const Stroke& stroke) {
  const Section section(hand.wheel().stack());
  const Tool& tool = hand.wheel().plan().tool;
  const auto middle_seen = [](const Section& seen, double up) {
    return 0.5 * (seen.surface(false, up) + seen.surface(true, up));
  };
  double thickest = 0.0;
  for (double up = stroke.from_mm; up < section.height(); up += kStepMm)
    thickest = std::max(thickest, section.surface(false, up) - section.surface(true, up));
  const double wide = thickest + 6.0 * kClearMm;
  const double top = section.height() + tool.high() + kClearMm;
  approach(hand, {middle_seen(section, section.height()), top});
  Path down;
  for (double up = top; up > stroke.from_mm; up -= kStepMm)
    down.push_back({{middle_seen(section, std::min(up, section.height())), up}, wide});
  down.push_back({{middle_seen(section, stroke.from_mm), stroke.from_mm}, wide});
  hand.travel(down);

  const double tick = 1.0 / hand.script().rate_hz;
  const double began = hand.here().at.x;
  const double wall =
      section.surface(false, stroke.from_mm) - section.surface(true, stroke.from_mm);
  double up = stroke.from_mm, height = section.height();
  for (double time = 0.0; up < height + tool.high() + kClearMm; time += tick) {
    height = hand.wheel().stack().height_mm();
    const double closed = smooth(time / kCloseS);
    up += stroke.speed_mm_s * tick * smooth(time / kCloseS - 1.0);
    const double eased =
        stroke.ease_mm > 0.0 ? smooth((up - stroke.from_mm) / stroke.ease_mm) : 1.0;
    const double goal = along(curve_of(stroke, height), up), aimed = gap_at(stroke, up / height);
    const double gap = aimed + (std::max(aimed, wall) - aimed) * (1.0 - eased);
    hand.emit({{began + (goal - began) * closed * eased, up}, wide + (gap - wide) * closed},
              stroke.trim);
  }
  hand.hold(stroke.hold_s, stroke.trim);
}

// As far as the minimum wall allows: a tool that moves on bends the rim.
void round_lip(Hand& hand, const Stroke& stroke) {
  const Section section(hand.wheel().stack());
  const StepPlan& plan = hand.wheel().plan();
  const double rim = section.height(), below = rim - 2.0 * kStepMm;
  const double outer = section.surface(false, below), inner = section.surface(true, below);
  const double middle = 0.5 * (outer + inner), round = 0.5 * (outer - inner);
  const double least = std::min(round, 0.5 * plan.removal.min_wall_mm + kSpareMm);
  const auto half_width = [&](double up) {
    const double t = std::max(0.0, up - (rim - round));
    return std::max(least, std::sqrt(std::max(0.0, round * round - t * t)));
  };
  for (const bool inside : {false, true}) {
    if (inside && !free_line(plan.tool, section, rim - round - plan.tool.high())) break;
    const Surface lip = [&](double up) {
      if (up < rim - round) return section.surface(inside, up);
      return inside ? middle - half_width(up) : middle + half_width(up);
    };
    const auto path = touching_path(plan.tool, rim - round - plan.tool.high(),
                                    rim + plan.tool.high(), rim, inside, lip);
    lead(hand, path, section, inside, stroke);
  }
}

}  // namespace clay::strokes
