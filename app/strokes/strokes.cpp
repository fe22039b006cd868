#include "app/strokes/strokes.hpp"

#include "app/strokes/hand.hpp"
#include "app/strokes/planned.hpp"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>
#include <string>
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
  const Path through = points_of(stroke, pass);
  approach(hand, through.front().at);
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

constexpr double kAirMm = 8.0;  // way in the air before and after a planned pass

double way_mm(const Pose& a, const Pose& b) { return glm::distance(a.position_mm, b.position_mm); }

/// The poses of a pass in contact, with some air around them. A pull begins where it is lowest: two
/// fingers close on the wall there.
std::vector<Pose> around_contact(const Hand& hand, bool pull) {
  const std::vector<Pose>& poses = hand.poses();
  std::size_t first = hand.touch().first, last = hand.touch().last;
  if (last == 0) return {};
  double air_mm = 0.0;
  if (pull)
    first = static_cast<std::size_t>(
        std::ranges::min_element(poses, {}, [](const Pose& pose) { return pose.position_mm.y; }) -
        poses.begin());
  else
    for (; first > 0 && air_mm < kAirMm; --first) air_mm += way_mm(poses[first], poses[first - 1]);
  for (air_mm = 0.0; last + 1 < poses.size() && air_mm < kAirMm; ++last)
    air_mm += way_mm(poses[last], poses[last + 1]);
  const auto at = [&](std::size_t k) { return poses.begin() + static_cast<std::ptrdiff_t>(k); };
  return {at(first), at(last + 1)};
}

/// The wheel would refuse the poses of two tools one by one.
Result<void> check_gaps(const StrokeScript& script, const SceneSpec& scene) {
  if (scene.tool.gap_mm) return {};
  const auto pinch = std::ranges::find_if(
      script.strokes, [](const Stroke& stroke) { return !stroke.gap_mm.empty(); });
  if (pinch == script.strokes.end()) return {};
  return failure(ErrorKind::bad_input,
                 "strokes[" + std::to_string(pinch - script.strokes.begin()) +
                     "].gap_mm: expected one tool, because the scene sets no tool.gap_mm, found a "
                     "gap between two");
}

/// A warning if the tool presses clay on its way for long enough to mark it.
std::optional<std::string> obstacle_of(Hand& hand) {
  constexpr double kLongS = 0.05;
  const Hand::Obstacle obstacle = hand.take_obstacle();
  if (static_cast<double>(obstacle.ticks) < kLongS * hand.script().rate_hz) return std::nullopt;
  const glm::dvec2 start = hand.script().start_mm;
  return fmt::format(
      "the tool presses the clay at a height of {:.1f} mm on its way between start_mm ({:g}, {:g}) "
      "and the stroke: expected a way clear of the pot, which is {:.1f} mm high now",
      obstacle.height_mm, start.x, start.y, hand.wheel().stack().height_mm());
}

std::optional<double> thinnest_mm(const ClayStack& stack) {
  std::optional<double> least;
  for (const Ring& ring : stack.rings())
    if (ring.inner2 > 0) {
      const double wall = ring.outer_mm() - ring.inner_mm();
      least = std::min(least.value_or(wall), wall);
    }
  return least;
}

bool solid_at(const ClayStack& stack, double height_mm) {
  const auto ring = static_cast<std::size_t>(std::max(0.0, height_mm) / stack.ring_height_mm());
  return stack.rings()[std::min(ring, stack.size() - 1)].inner2 == 0;
}

/// All passes of a stroke.
PlayedStroke played(Hand& hand, const Stroke& stroke) {
  PlayedStroke done;
  const ClayStack& stack = hand.wheel().stack();
  const std::size_t before = hand.poses().size();
  const bool stood = !hand.wheel().collapsed();
  if (stood && stroke.kind == StrokeKind::pull && solid_at(stack, stroke.from_mm))
    done.warnings.push_back(fmt::format(
        "expected a wall between the two tools at a height of {:g} mm, found solid clay",
        stroke.from_mm));
  (void)hand.take_obstacle();
  for (int pass = 0; pass < stroke.passes && !hand.full(); ++pass) perform(hand, stroke, pass);
  done.seconds = static_cast<double>(hand.poses().size() - before) / hand.script().rate_hz;
  done.height_mm = stack.height_mm();
  done.thinnest_mm = thinnest_mm(stack);
  if (auto obstacle = obstacle_of(hand)) done.warnings.push_back(std::move(*obstacle));
  if (!stood)
    done.warnings.emplace_back("does nothing, because the pot has fallen");
  else if (hand.wheel().collapsed())
    done.warnings.emplace_back("the pot falls");
  else if (hand.touch().last < before || hand.touch().last == 0)
    done.warnings.emplace_back("touches no clay");
  return done;
}

}  // namespace

Result<PlannedStroke> plan(const StrokeScript& script, std::size_t index, const SceneSpec& scene,
                           const Pot& pot) {
  StrokeScript steady = script;
  steady.tremor_mm = 0.0;
  return Wheel::build(scene, pot).map([&](Wheel&& wheel) {
    Hand hand(steady, std::move(wheel), kMaxPoses);
    const Stroke& stroke = steady.strokes.at(index);
    PlannedStroke planned;
    for (int pass = 0; pass < stroke.passes; ++pass) {
      perform(hand, stroke, pass);
      if (pass == 0) planned.poses = around_contact(hand, stroke.kind == StrokeKind::pull);
    }
    planned.after = hand.wheel().pot();
    return planned;
  });
}

Result<Played> play(const StrokeScript& script, const SceneSpec& scene, Wheel wheel,
                    std::size_t most_poses) {
  if (auto gaps = check_gaps(script, scene); !gaps) return tl::make_unexpected(gaps.error());
  Hand hand(script, std::move(wheel), most_poses);
  std::vector<PlayedStroke> strokes;
  for (const Stroke& stroke : script.strokes) strokes.push_back(played(hand, stroke));
  if (!hand.full()) return Played{hand.take(), std::move(strokes)};
  return failure(ErrorKind::bad_input,
                 "strokes: expected at most " + std::to_string(most_poses) + " poses, found more");
}

}  // namespace clay::strokes
