#pragma once
// Animation of a fall: the pot has already fallen, and the view replays the motion.

#include "app/history/work.hpp"
#include "app/render/picture.hpp"
#include "claystack/engine/collapse.hpp"

#include <optional>
#include <vector>

namespace clay::studio {

/// Duration of the animation, long enough to follow; a real fall takes a fifth of it.
inline constexpr double kFallS = 1.2;

/// Cause of a fall, as a clause of a sentence.
[[nodiscard]] const char* fall_reason(const Collapse& fall) noexcept;

class FallShow {
 public:
  /// Starts the animation of a collapsed pot. Does nothing if the frames of its fall are unknown.
  void begin(history::SharedPot pot, double now_s);
  void end() noexcept { frames_.clear(); }
  [[nodiscard]] bool running() const noexcept { return !frames_.empty(); }
  /// Place of the falling part, at a pace in proportion to the real one: it gains speed as it loses
  /// height. Nothing once it has come to rest.
  [[nodiscard]] std::optional<render::FallenView> at(double now_s, const render::PotView& view);

 private:
  history::SharedPot pot_;
  std::vector<FallFrame> frames_;
  std::vector<double> times_s_;  // time of each frame after the first
  double begun_s_ = 0.0;
};

}  // namespace clay::studio
