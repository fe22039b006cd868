#pragma once
// The steps of a sample as a lesson: the path of the hand in the next stroke on the present pot,
// and the remaining difference of the clay from the result. Plain values that any thread can
// compute.

#include "app/history/work.hpp"
#include "app/render/picture.hpp"
#include "app/strokes/strokes.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/scene.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

namespace clay::studio {

/// The area [mm^2] that belongs to one of two half-sections and not to the other.
[[nodiscard]] double difference_mm2(const render::PotView& a, const render::PotView& b);

/// The same for the widths of the walls, at any radius: the difference of the widths at every
/// height.
[[nodiscard]] double width_difference_mm2(const render::PotView& a, const render::PotView& b);

struct LessonQuestion {
  std::shared_ptr<const strokes::StrokeScript> script;
  SceneSpec scene;
  history::SharedPot pot;
  history::NodeId node = 0;  ///< of the pot
  std::size_t step = 0;
  int passes_left = 1;
};

/// A point of the path, in the section plane.
struct PathPoint {
  glm::dvec2 at_mm{0.0};  ///< (rho, y) of the tool
  double time_s = 0.0;    ///< for an experienced hand, from the start of the path
  friend bool operator==(const PathPoint&, const PathPoint&) = default;
};

/// The next stroke of a step.
struct LessonPlan {
  history::NodeId node = 0;
  std::size_t step = 0;
  ToolMode mode = ToolMode::press;
  double gap_mm = 0.0;
  std::vector<PathPoint> path;  ///< empty: the tool would not touch the clay
  render::PotView after;        ///< the pot after all passes that are left
  double left_mm2 = 0.0;        ///< difference of the pot from that, see `left_from`
  std::string problem;          ///< reason why there is no plan; then the path is empty

  /// Difference of a pot from the result [mm^2]. A pull should make the wall thinner and taller, at
  /// any radius, so only widths count; all other strokes move the wall.
  [[nodiscard]] double left_from(const render::PotView& pot) const {
    return mode == ToolMode::pinch ? width_difference_mm2(pot, after) : difference_mm2(pot, after);
  }
};

[[nodiscard]] LessonPlan plan_step(const LessonQuestion& question);

}  // namespace clay::studio
