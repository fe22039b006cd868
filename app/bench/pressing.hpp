#pragma once
// The work that ticks are timed by: a tool pressed into the middle of a hollow lump.

#include "app/bench/literal/literal_paper.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/wheel.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace clay::bench {

inline constexpr int kPressTicks = 1000;  ///< of 1 ms
inline constexpr double kPressMm = 6.0;   ///< inward, and as far upward

/// Every stage in but the pinch; a ball that touches about 30 rings.
[[nodiscard]] SceneSpec press_scene(std::size_t rings);
/// The same with an upright rib that touches as many rings as are named, from 1 to 300.
[[nodiscard]] SceneSpec rib_scene(std::size_t touched);
/// The same scene in the paper's own terms: K, mu and the threshold of stress as well.
[[nodiscard]] LiteralScene literal_of(const SceneSpec& scene, LiteralWriting writing);

/// Presses a lump at one place after the other; when there is none left it takes a new lump.
class Presser {
 public:
  /// Of a scene that Wheel::build takes. The tool rises by so much while it is pressed; one that
  /// rises by more than it is pressed in takes a new lump each time.
  explicit Presser(const SceneSpec& scene, double rise_mm = kPressMm);
  /// Seconds of the ticks of one press. To make the lump and to go there does not count.
  double press();
  /// The mean tick of the last press. 0 before any.
  [[nodiscard]] double rings_touched() const { return touched_; }
  /// Seconds of a tick at the foot of the stack, after one at its top.
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

/// The same of the literal paper, a new lump for each press.
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
