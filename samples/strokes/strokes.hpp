#pragma once
// Simulates a potter's hand from a script: strokes along smooth paths, at human speeds, with
// tremor.

#include "claystack/core/result.hpp"
#include "claystack/engine/tool.hpp"

#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

namespace clay::samples {

/// One stroke, repeated. The path is a smooth curve through points (distance from the axis, height)
/// in mm; pass k is shifted by k * step. Before each pass the hand moves in straight lines to the
/// script's start and on to the first point: both lines must be clear of the clay.
struct Stroke {
  std::vector<glm::dvec2> through_mm;  ///< at least two, no equal neighbours
  double speed_mm_s = 40.0;            ///< maximum speed, without tremor
  int passes = 1;
  glm::dvec2 step_mm{0.0};
  double hold_s = 0.0;  ///< rest at the end of each pass
  bool trim = false;    ///< button pressed along the path
  /// Gap between the two tools of a pinch: empty for one tool; one value for the whole path; or one
  /// per point. Between the script's start and the path the hand is one tool.
  std::vector<double> gap_mm;
};

struct StrokeScript {
  std::uint64_t seed = 1;
  double rate_hz = 1000.0;
  double tremor_mm = 0.05;     ///< root mean square along each axis, at about 9 Hz
  double travel_mm_s = 150.0;  ///< maximum speed between strokes
  glm::dvec2 start_mm{80.0, 100.0};
  std::vector<Stroke> strokes;
};

/// `*.strokes.json`: one object with the fields of StrokeScript; start_mm and strokes are required,
/// and through_mm in each stroke; gap_mm may be a number. Errors read "NAME: strokes[2].speed_mm_s:
/// what was expected, what was found". Unknown fields are errors, and so are strokes with more
/// poses than a session holds (kMaxPoses).
Result<StrokeScript> parse_strokes(std::string_view text, std::string_view name);

/// Poses in a vertical plane through the axis, at the script's rate, quantized as in a session. The
/// same bits on every platform: uses no libm except the square root, and no distribution of the
/// standard library.
std::vector<Pose> play(const StrokeScript& script);

}  // namespace clay::samples
