#pragma once
// Simulates a potter's hand from a script: strokes along smooth paths, at human speeds, with
// tremor. Some strokes are planned on the pot as it is when they begin.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"
#include "claystack/engine/wheel.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::strokes {

/// path: through fixed points. shape: leads the tool's surface along an outline, in passes that
/// each take an equal part of the way that remains from the pot's surface. pull: two tools rise
/// from the floor over the rim, which rises with them. lip: rounds the rim, from the outside over
/// the top to the inside.
enum class StrokeKind { path, shape, pull, lip };

/// One stroke, repeated. Before each pass the hand moves in straight lines to the script's start
/// and on to the first point: both lines must be clear of the clay.
struct Stroke {
  std::string name;  ///< of the step for a learner, such as "Open"
  std::string hint;  ///< instruction for a learner, one or two sentences
  StrokeKind kind = StrokeKind::path;
  /// path: a smooth curve through points (distance from the axis, height) in mm: at least two, no
  /// equal neighbours; pass k is shifted by k * step.
  std::vector<glm::dvec2> through_mm;
  /// shape: the surface aimed at; pull: the middle of the wall aimed at. Points (distance from the
  /// axis in mm, height); at least two, heights strictly ascending or descending. Heights are
  /// shares of the pot's height, or mm with `outline_in_mm`. A shape follows the order of its
  /// points.
  std::vector<glm::dvec2> outline;
  bool outline_in_mm = false;
  bool inside = false;       ///< shape: press the wall from the inside
  double speed_mm_s = 40.0;  ///< maximum speed, without tremor
  int passes = 1;
  glm::dvec2 step_mm{0.0};
  double hold_s = 0.0;  ///< rest at the end of each pass
  bool trim = false;    ///< button pressed along the path
  /// Gap between the two tools of a pinch: empty for one tool; one value for the whole stroke; or,
  /// for a path, one per point, and for a pull, two: at the wheel and at the rim. Between the
  /// script's start and the stroke the hand is one tool.
  std::vector<double> gap_mm;
  double from_mm = 0.0;  ///< pull: height of the HIP at the beginning
  double ease_mm = 0.0;  ///< pull: the tools reach gap and outline after rising by this
};

struct StrokeScript {
  std::uint64_t seed = 1;
  double rate_hz = 1000.0;
  double tremor_mm = 0.05;     ///< root mean square along each axis, at about 9 Hz
  double travel_mm_s = 150.0;  ///< maximum speed between strokes
  glm::dvec2 start_mm{80.0, 100.0};
  std::vector<Stroke> strokes;
};

/// `*.strokes.json`: one object with the fields of StrokeScript; start_mm and strokes are required;
/// so is through_mm in each path, and outline or outline_mm in each shape and pull; gap_mm may be a
/// number. Errors read "NAME:LINE: strokes[2].speed_mm_s: what was expected, what was found".
/// Errors are also fields that the kind of a stroke does not use, and strokes that would have more
/// poses than a session holds (kMaxPoses).
Result<StrokeScript> parse_strokes(std::string_view text, std::string_view name);

/// The pot after a stroke, and warnings for the author of the script.
struct PlayedStroke {
  double seconds = 0.0;    ///< all passes, with the ways between them
  double height_mm = 0.0;  ///< of the pot
  std::optional<double>
      thinnest_mm;  ///< wall of the thinnest ring with a bore; empty: none has one
  std::vector<std::string> warnings;  ///< "touches no clay", ...
};
struct Played {
  std::vector<Pose> poses;
  std::vector<PlayedStroke> strokes;  ///< as in the script
};

/// Poses in a vertical plane through the axis, at the script's rate, quantized as in a session, on
/// `wheel`, which was built for `scene`. The same bits on every platform: uses no libm except the
/// square root, and no distribution of the standard library. Fails for a gap in a scene of one
/// tool, and for more than `most_poses`.
Result<Played> play(const StrokeScript& script, const SceneSpec& scene, Wheel wheel,
                    std::size_t most_poses = kMaxPoses);

/// A stroke, planned on a pot.
struct PlannedStroke {
  /// The first pass, from the approach to the clay until the tool has left it. No tremor.
  std::vector<Pose> poses;
  Pot after;  ///< the pot after all passes
};
/// Plans stroke number `index` on a pot instead of the scene's lump. Fails where Wheel::build
/// refuses the pot.
Result<PlannedStroke> plan(const StrokeScript& script, std::size_t index, const SceneSpec& scene,
                           const Pot& pot);

}  // namespace clay::strokes
