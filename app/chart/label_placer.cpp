#include "app/chart/label_placer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clay::chart {
namespace {

constexpr double kBesidePx = 6.0;                    // from the mark to the text
constexpr double kAbovePx = 5.0, kBelowPx = 13.0;    // from the mark to the baseline
constexpr double kAscentPx = 8.0, kDescentPx = 2.0;  // of a label of 10 px
constexpr double kMarkPx = 4.0;                      // half the width of a mark

double overlap(const Box& a, const Box& b) {
  const double width = std::min(a.right, b.right) - std::max(a.left, b.left);
  const double height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  return width > 0.0 && height > 0.0 ? width * height : 0.0;
}

double area(const Box& box) { return (box.right - box.left) * (box.bottom - box.top); }

/// The length of the part of a line that is in a box (Liang and Barsky).
double length_in(const Box& box, Spot from, Spot to) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  double enter = 0.0, leave = 1.0;
  const auto clip = [&](double way, double room) {  // way * t <= room
    if (way == 0.0 && room < 0.0) leave = -1.0;
    if (way > 0.0) leave = std::min(leave, room / way);
    if (way < 0.0) enter = std::max(enter, room / way);
  };
  clip(-dx, from.x - box.left);
  clip(dx, box.right - from.x);
  clip(-dy, from.y - box.top);
  clip(dy, box.bottom - from.y);
  return std::max(0.0, leave - enter) * std::hypot(dx, dy);
}

}  // namespace

/// The covered area [px²], weighted: a label over another is unreadable, one over a line is not.
double LabelPlacer::cost(const Box& box) const {
  constexpr double kOutside = 100.0, kLabel = 10.0, kMark = 3.0, kLine = 2.0;
  double sum = kOutside * (area(box) - overlap(box, frame_));
  for (const Box& label : labels_) sum += kLabel * overlap(box, label);
  for (const Spot& m : marks_)
    sum += kMark * overlap(box, {m.x - kMarkPx, m.y - kMarkPx, m.x + kMarkPx, m.y + kMarkPx});
  for (const Line& line : lines_) sum += kLine * length_in(box, line.from, line.to);
  return sum;
}

LabelPlacer::Label LabelPlacer::place(Spot at, double width_px) {
  Label best;
  Box taken;
  double least = std::numeric_limits<double>::infinity();
  for (const double down : {-kAbovePx, kBelowPx})
    for (const double side : {1.0, -1.0}) {
      const Spot text{at.x + side * kBesidePx, at.y + down};
      const Box box{side > 0.0 ? text.x : text.x - width_px, text.y - kAscentPx,
                    side > 0.0 ? text.x + width_px : text.x, text.y + kDescentPx};
      const double costs = cost(box);
      if (costs >= least) continue;
      least = costs;
      taken = box;
      best = {text, side > 0.0 ? "start" : "end"};
    }
  labels_.push_back(taken);
  return best;
}

}  // namespace clay::chart
