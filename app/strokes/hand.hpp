#pragma once
// A hand that moves a tool over a wheel, and records its poses.

#include "app/strokes/strokes.hpp"
#include "claystack/engine/wheel.hpp"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace clay::strokes {

/// A point of the hand's path, and the gap of its tools.
struct Place {
  glm::dvec2 at{0.0};
  double gap_mm = 0.0;
};
using Path = std::vector<Place>;

/// A centripetal Catmull-Rom spline by Barry and Goldman's pyramid (SIGGRAPH 1988): unlike the
/// uniform one it does not overshoot where long and short spans meet. Gaps are interpolated
/// linearly, because a curve would undershoot the given values.
[[nodiscard]] Path spline(const Path& through);

/// Band-limited noise of unit root mean square: a resonator at 9 Hz driven by white noise.
class Tremor {
 public:
  explicit Tremor(double rate_hz);
  double next(std::mt19937_64& random);

 private:
  double a1_ = 0.0, a2_ = 0.0, gain_ = 1.0, y1_ = 0.0, y2_ = 0.0;
};

class Hand {
 public:
  Hand(const StrokeScript& script, Wheel wheel, std::size_t most_poses);

  /// Moves along a path in minimum-jerk time (Flash and Hogan, J. Neurosci. 5(7) 1985), with a peak
  /// speed of 15/8 of the mean.
  void move(const Path& path, double speed_mm_s, bool trim);
  /// Moves along straight lines between strokes.
  void travel(const Path& path);
  void hold(double seconds, bool trim);
  /// One pose; after `most_poses` none, see full().
  void emit(const Place& place, bool trim);

  [[nodiscard]] const Place& here() const { return here_; }
  [[nodiscard]] const Wheel& wheel() const { return wheel_; }
  [[nodiscard]] const StrokeScript& script() const { return script_; }
  /// There were more than `most_poses`.
  [[nodiscard]] bool full() const { return full_; }
  std::vector<Pose> take() { return std::move(poses_); }
  [[nodiscard]] const std::vector<Pose>& poses() const { return poses_; }
  /// The first and the last pose at which the tool touched the clay; both 0: none.
  struct Touch {
    std::size_t first = 0, last = 0;
  };
  [[nodiscard]] const Touch& touch() const { return touch_; }
  /// The clay that a tool presses while it travels: contact that begins on the way, or with more
  /// rings than at its beginning.
  struct Obstacle {
    std::size_t ticks = 0;
    double height_mm = 0.0;  ///< of the tool in the last of them
  };
  /// Of all travels since the last call.
  [[nodiscard]] Obstacle take_obstacle() { return std::exchange(obstacle_, {}); }

 private:
  const StrokeScript& script_;
  Wheel wheel_;
  std::mt19937_64 random_;
  Place here_;
  Tremor radial_, vertical_, sideways_;
  std::vector<Pose> poses_;
  std::size_t most_poses_;
  bool full_ = false;
  Touch touch_;
  bool travels_ = false;
  std::uint32_t touched_ = 0;   ///< rings that the last tick touched
  std::uint32_t released_ = 0;  ///< of a travel: those at its beginning, 0 once it was in the air
  Obstacle obstacle_;
};

}  // namespace clay::strokes
