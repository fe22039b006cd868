#pragma once
// The rules of the guard, each a unit of its own. Time that lets force grow is counted short,
// time that takes it away is counted long: so a clock that stands, leaps or runs backwards can
// take force away and never give any.

#include <cstdint>
#include <glm/vec3.hpp>

namespace clay::falcon {

/// Seconds from one reading of the clock to a later one; 0 when the clock went back. At most 1000.
[[nodiscard]] double elapsed_s(std::int64_t from_us, std::int64_t to_us) noexcept;

[[nodiscard]] bool is_finite(const glm::dvec3& v) noexcept;

/// Length that does not overflow: infinite for vectors that are, NaN for those that are none.
[[nodiscard]] double norm(const glm::dvec3& v) noexcept;

/// The nearest vector of the same direction that is no longer than `limit`, in exact arithmetic:
/// what is cut comes out up to 2^-49 shorter. `v` finite.
[[nodiscard]] glm::dvec3 limit_norm(const glm::dvec3& v, double limit) noexcept;

/// The way from `before` to `wanted`, in one tick: to let go costs nothing, so the force may first
/// shrink to any part of `before`; from there it goes `rise` at most. A force that turns
/// about thus begins again at 0.
[[nodiscard]] glm::dvec3 limit_rise(const glm::dvec3& wanted, const glm::dvec3& before,
                                    double rise) noexcept;

/// 1 up to `from`, 0 from `zero` on, a line between.
[[nodiscard]] double fade(double age, double from, double zero) noexcept;

/// How long the last tick was.
struct TickTime {
  double real_s = 0.0;     ///< by the clock
  double growing_s = 0.0;  ///< counted short: at most a period
  double fading_s = 0.0;   ///< counted long: at least kShortestStepS
};

class TickClock {
 public:
  [[nodiscard]] TickTime advance(std::int64_t now_us, double period_s) noexcept;

 private:
  std::int64_t last_us_ = 0;
  bool started_ = false;
};

/// How old the newest of a stream of stamped things is: by its stamp and by our own ticks,
/// whichever says more.
class Age {
 public:
  /// A thing with this stamp is there, unless it is the last one again.
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

/// Positions faster than a hand. One frame alone is dropped; where the next stands by it, or is as
/// far elsewhere, the jump stays.
class JumpFilter {
 public:
  enum class Verdict { plausible, dropped, stays };

  /// `reach_mm`: how far a hand gets since the last plausible frame. A jump that stays is believed
  /// from the next frame on.
  [[nodiscard]] Verdict take(const glm::dvec3& position_mm, double reach_mm) noexcept;
  void forget() noexcept { *this = {}; }

 private:
  glm::dvec3 plausible_mm_{0.0}, suspect_mm_{0.0};
  bool any_ = false, suspected_ = false;
};

/// Force is earned: little has to be wanted for some ticks, then it grows in a line.
class Engagement {
 public:
  enum class Phase { waiting, ramping, engaged };

  void restart() noexcept { *this = {}; }
  /// A tick of waiting in which this much was wanted [N].
  void want(double wanted_n, double small_n, int ticks) noexcept;
  void grow(double growing_s, double ramp_s) noexcept;
  [[nodiscard]] double gain() const noexcept { return gain_; }
  [[nodiscard]] Phase phase() const noexcept { return phase_; }

 private:
  Phase phase_ = Phase::waiting;
  int small_ticks_ = 0;
  double gain_ = 0.0;
};

/// Motors that pushed hard for long. What cools counts as much as what warms.
class HeatLimit {
 public:
  /// The force held in the last tick.
  void hold(double force_n, double hot_n, const TickTime& time, double most_s) noexcept;
  /// Once hot, fades within `fade_s`. True when it has come to 0, once: then force is to be
  /// earned anew.
  [[nodiscard]] bool fade_out(double fading_s, double fade_s) noexcept;
  [[nodiscard]] double gain() const noexcept { return gain_; }
  [[nodiscard]] bool fading() const noexcept { return fading_; }

 private:
  double hot_s_ = 0.0, gain_ = 1.0;
  bool fading_ = false;
};

}  // namespace clay::falcon
