#include "app/strokes/strokes.hpp"

#include "app/strokes/hand.hpp"
#include "app/strokes/planned.hpp"

#include <utility>

namespace clay::strokes {
namespace {

Path points_of(const Stroke& stroke, int pass) {
  Path points;
  for (std::size_t k = 0; k < stroke.through_mm.size(); ++k) {
    const double gap_mm = stroke.gap_mm.empty()       ? 0.0
                          : stroke.gap_mm.size() == 1 ? stroke.gap_mm[0]
                                                      : stroke.gap_mm[k];
    points.push_back({stroke.through_mm[k] + static_cast<double>(pass) * stroke.step_mm, gap_mm});
  }
  return points;
}

void follow(Hand& hand, const Stroke& stroke, int pass) {
  const StrokeScript& script = hand.script();
  const Path through = points_of(stroke, pass);
  if (hand.here().at != script.start_mm)
    hand.move({{hand.here().at}, {script.start_mm}}, script.travel_mm_s, false);
  hand.move({{script.start_mm}, {through.front().at}}, script.travel_mm_s, false);
  hand.move(spline(through), stroke.speed_mm_s, stroke.trim);
  hand.hold(stroke.hold_s, stroke.trim);
}

void perform(Hand& hand, const Stroke& stroke, int pass) {
  switch (stroke.kind) {
    case StrokeKind::path:
      return follow(hand, stroke, pass);
    case StrokeKind::shape:
      return shape(hand, stroke, pass);
    case StrokeKind::pull:
      return pull(hand, stroke);
    case StrokeKind::lip:
      return round_lip(hand, stroke);
  }
}

}  // namespace

Result<std::vector<Pose>> play(const StrokeScript& script, const SceneSpec& scene) {
  return Wheel::build(scene).map([&](Wheel&& wheel) {
    Hand hand(script, std::move(wheel));
    for (const Stroke& stroke : script.strokes)
      for (int pass = 0; pass < stroke.passes; ++pass) perform(hand, stroke, pass);
    return hand.take();
  });
}

}  // namespace clay::strokes
