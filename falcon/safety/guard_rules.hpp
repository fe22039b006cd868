#pragma once
// The rules of the guard, each a separate unit. Time that increases the force is rounded down, and
// time that decreases it is rounded up, so that a clock that stops, jumps or runs backwards can
// only reduce the force.

#include "claystack/falcon/guard.hpp"

#include <cstdint>
#include <glm/vec3.hpp>

namespace clay::falcon::inline safety {

/// Seconds from one reading of the clock to a later one; 0 if the clock went back. At most 1000.
[[nodiscard]] double elapsed_s(std::int64_t from_us, std::int64_t to_us) noexcept;

/// The force of this tick on the way from `before` to `wanted`. It may first shrink freely to any
/// fraction of `before`; from there it changes by `rise` at most. A force that reverses its
/// direction thus starts from 0.
[[nodiscard]] glm::dvec3 limit_rise(const glm::dvec3& wanted, const glm::dvec3& before,
                                    double rise) noexcept;

/// Without frames, a tick that is on time comes 1.5 periods after the last one: it waits for a
/// frame until then. The device holds the last force meanwhile.
inline constexpr double kHeldPeriods = 1.5;

/// 1 up to `from`, 0 from `zero` on, linear between.
[[nodiscard]] double fade(double age, double from, double zero) noexcept;

/// Duration of the last tick.
struct TickTime {
  double real_s = 0.0;     ///< by the clock
  double growing_s = 0.0;  ///< rounded down: at most a period
  double fading_s = 0.0;   ///< rounded up: at least kShortestStepS
};

class TickClock {
 public:
  [[nodiscard]] TickTime advance(std::int64_t now_us, double period_s) noexcept;

 private:
  std::int64_t last_us_ = 0;
  bool started_ = false;
};

/// Age of the newest item of a time-stamped stream: by its stamp or by the ticks since then,
/// whichever is larger.
class Age {
 public:
  /// Registers an item with this stamp, unless it repeats the last one.
  void see(std::int64_t stamp_us, std::int64_t now_us) noexcept;
  void pass(double fading_s) noexcept { passed_s_ += fading_s; }
  [[nodiscard]] double at(std::int64_t now_us) const noexcept;
  [[nodiscard]] bool is_last(std::int64_t stamp_us) const noexcept;
  [[nodiscard]] std::int64_t stamp_us() const noexcept { return stamp_us_; }
  [[nodiscard]] bool any() const noexcept { return any_; }
  void forget() noexcept { *this = {}; }

 private:
  std::int64_t stamp_us_ = 0;
  double passed_s_ = 0.0;
  bool any_ = false;
};

/// Detects positions that imply a motion faster than a hand. A single such frame is dropped. If the
/// next frame is near it, or again out of reach, the jump is real.
class JumpFilter {
 public:
  enum class Verdict { plausible, dropped, stays };

  /// `reach_mm`: the farthest a hand can move since the last plausible frame. The position after a
  /// real jump is accepted from the next frame on.
  [[nodiscard]] Verdict take(const glm::dvec3& position_mm, double reach_mm) noexcept;
  void forget() noexcept { *this = {}; }

 private:
  glm::dvec3 plausible_mm_{0.0}, suspect_mm_{0.0};
  bool any_ = false, suspected_ = false;
};

/// Engages the force: after some ticks with a small requested force, it ramps up linearly.
class Engagement {
 public:
  enum class Phase { waiting, ramping, engaged };

  void restart() noexcept { *this = {}; }
  /// A tick of waiting with this requested force [N].
  void want(double wanted_n, double small_n, int ticks) noexcept;
  void grow(double growing_s, double ramp_s) noexcept;
  [[nodiscard]] double gain() const noexcept { return gain_; }
  [[nodiscard]] Phase phase() const noexcept { return phase_; }

 private:
  Phase phase_ = Phase::waiting;
  int small_ticks_ = 0;
  double gain_ = 0.0;
};

/// The part of the force that fades, late ticks and invalid values have left. It falls with them
/// and recovers slowly: otherwise frames or ticks that keep coming late would shake the hand.
class Recovery {
 public:
  /// `held`: the part that they leave in this tick.
  [[nodiscard]] double after(double held, double growing_s) noexcept;

 private:
  double part_ = 1.0;
};

/// Limits long, large forces. Cooling counts at the same rate as heating.
class HeatLimit {
 public:
  /// `force_n`: displayed in the last tick.
  void hold(double force_n, double hot_n, const TickTime& time, double most_s) noexcept;
  /// Once hot, fades within `fade_s`. Returns true once, when the force has reached 0: then it must
  /// ramp up again.
  [[nodiscard]] bool fade_out(double fading_s, double fade_s) noexcept;
  [[nodiscard]] double gain() const noexcept { return gain_; }
  [[nodiscard]] bool fading() const noexcept { return fading_; }

 private:
  double hot_s_ = 0.0, gain_ = 1.0;
  bool fading_ = false;
};

}  // namespace clay::falcon::inline safety
