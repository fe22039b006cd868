#pragma once
// The workload for timing ticks: a tool pressed into the middle of a hollow lump.

#include "app/bench/literal/literal_paper.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/wheel.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace clay::bench {

inline constexpr int kPressTicks = 1000;  ///< of 1 ms
inline constexpr double kPressMm = 6.0;   ///< inward, and the same upward

/// All stages except the pinch; a ball that touches about 30 rings.
[[nodiscard]] SceneSpec press_scene(std::size_t rings);
/// The same with a vertical rib that touches the given number of rings, from 1 to 300.
[[nodiscard]] SceneSpec rib_scene(std::size_t touched);
/// The same scene in the paper's terms, including K, mu and the stress threshold.
[[nodiscard]] LiteralScene literal_of(const SceneSpec& scene, LiteralWriting writing);

/// Presses a lump at one place after the other, then continues with a new lump.
class Presser {
 public:
  /// For a scene that Wheel::build accepts. The tool rises by `rise_mm` during a press; if that
  /// exceeds the depth, each press takes a new lump.
  explicit Presser(const SceneSpec& scene, double rise_mm = kPressMm);
  /// Duration [s] of the ticks of one press, without making the lump and moving there.
  double press();
  /// Mean over the ticks of the last press. 0 before the first.
  [[nodiscard]] double rings_touched() const { return touched_; }
  /// Duration [s] of a tick at the foot of the stack, after one at its top.
  double jump();

 private:
  [[nodiscard]] Pose pose(double middle_mm, int tick) const;
  void next_place();
  SceneSpec scene_;
  std::optional<Wheel> wheel_;
  std::size_t place_ = 0, places_ = 0;
  std::int64_t time_us_ = 0;
  double first_distance_mm_ = 0.0, rise_mm_ = 0.0;
  double touched_ = 0.0;
  int jumps_ = 0;
};

/// The same for the literal paper, with a new lump for each press.
class LiteralPresser {
 public:
  LiteralPresser(const SceneSpec& scene, LiteralWriting writing, int ticks = kPressTicks);
  double press();
  [[nodiscard]] double rings_touched() const { return touched_; }
  [[nodiscard]] int ticks() const { return ticks_; }

 private:
  LiteralScene scene_;
  double first_distance_mm_;
  int ticks_;
  double touched_ = 0.0;
};

}  // namespace clay::bench
