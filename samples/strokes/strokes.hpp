#pragma once
// A potter's hand from a script: strokes along smooth paths, at human speeds, with tremor.

#include "claystack/engine/pose.hpp"
#include "claystack/engine/result.hpp"

#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

namespace clay::samples {

/// One stroke, repeated. The path is a Catmull-Rom spline through points (distance from the axis,
/// height) in mm; pass k is shifted by k * step. Between passes the hand goes back to where it began,
/// in straight lines: put that point clear of the clay.
struct Stroke {
  std::vector<glm::dvec2> through_mm;
  double speed_mm_s = 40.0;    ///< greatest speed along the path
  int passes = 1;
  glm::dvec2 step_mm{0.0};
  double hold_s = 0.0;         ///< rest at the end of each pass
  bool trim = false;           ///< button pressed along the path
};

struct StrokeScript {
  std::uint64_t seed = 1;
  double rate_hz = 1000.0;
  double tremor_mm = 0.05;     ///< root mean square, at about 9 Hz as in a human hand
  double travel_mm_s = 150.0;  ///< greatest speed between strokes
  glm::dvec2 start_mm{80.0, 100.0};
  std::vector<Stroke> strokes;
};

Result<StrokeScript> parse_strokes(std::string_view text, std::string_view name);

/// Poses in a vertical plane through the axis, at the script's rate, counted as in a session.
/// The same bits on every platform: no libm, no distribution of the standard library.
std::vector<Pose> play(const StrokeScript& script);

}  // namespace clay::samples
