#pragma once
// The work that the ticks are timed by: a tool that is pressed into the middle of a lump.

#include "claystack/engine/scene.hpp"
#include "claystack/engine/wheel.hpp"

#include <cstddef>
#include <optional>

namespace clay::bench {

inline constexpr int kPressTicks = 1000;  ///< of 1 ms

/// Hollow, with a ball that touches about 30 rings while it is pressed, every stage in.
[[nodiscard]] SceneSpec press_scene(std::size_t rings);
/// The same with a rib so high that it touches so many rings, on a stack to suit.
[[nodiscard]] SceneSpec rib_scene(std::size_t touched);

/// Where the tool is at a tick: pressed in, rising a little all the while.
[[nodiscard]] Pose press_pose(const SceneSpec& scene, double middle_mm, int tick);

/// Presses a lump again and again, each time at a place that has not been pressed yet.
class Presser {
 public:
  /// `scene` must be one that Wheel::build takes.
  explicit Presser(const SceneSpec& scene);
  /// Seconds of the ticks of one press; making the lump and going there are not counted.
  double press();
  /// Rings touched by the median tick of the last press.
  [[nodiscard]] double rings_touched() const { return touched_; }

 private:
  void next_place();
  SceneSpec scene_;
  std::optional<Wheel> wheel_;
  std::size_t place_ = 0, places_ = 0;
  std::int64_t time_us_ = 0;
  double touched_ = 0.0;
};

}  // namespace clay::bench
