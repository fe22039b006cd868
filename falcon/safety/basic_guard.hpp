#pragma once
// The guard as a template over its rules: ForceGuard has all of them; tests compile guards that
// lack one, to show its effect.

#include "claystack/falcon/guard.hpp"
#include "core/limit_norm.hpp"
#include "falcon/safety/guard_rules.hpp"

#include <algorithm>
#include <cstdint>

namespace clay::falcon::inline safety {

enum GuardRule : std::uint32_t {
  kRuleFinite = 1u << 0,
  kRuleNotFiniteLatch = 1u << 1,
  kRuleLimit = 1u << 2,
  kRuleSlew = 1u << 3,
  kRuleSmallForce = 1u << 4,
  kRuleRamp = 1u << 5,
  kRuleReady = 1u << 6,
  kRuleStaleFrames = 1u << 7,
  kRulePause = 1u << 8,
  kRuleJump = 1u << 9,
  kRuleStep = 1u << 10,
  kRuleLate = 1u << 11,
  kRuleOverrun = 1u << 12,
  kRuleOldClay = 1u << 13,
  kRulePassive = 1u << 14,
  kRuleHeat = 1u << 15,
  kRuleLatch = 1u << 16,
  kRuleStop = 1u << 17,
  kRuleRecovery = 1u << 18,
};

[[nodiscard]] constexpr bool clears_itself(SafeCause cause) noexcept {
  return cause == SafeCause::jumped || cause == SafeCause::overrun;
}

/// `rules`: bits of GuardRule.
template <std::uint32_t rules>
class BasicForceGuard {
 public:
  /// `settings` must pass `check`.
  explicit BasicForceGuard(const GuardSettings& settings) noexcept : settings_(settings) {}

  // As ForceGuard.
  [[nodiscard]] Admission admit(std::int64_t now_us, const GuardSample& sample) noexcept;
  [[nodiscard]] GuardedForce force(std::int64_t now_us, const WantedForce& wanted) noexcept;
  void pause() noexcept { latch(SafeCause::paused); }
  void stop() noexcept { latch(SafeCause::stopped); }
  void was_zeroed() noexcept { sent_n_ = glm::dvec3(0.0); }
  bool rearm() noexcept;

 private:
  [[nodiscard]] static constexpr bool on(std::uint32_t rule) noexcept {
    return (rules & rule) != 0;
  }
  void latch(SafeCause cause) noexcept;
  [[nodiscard]] bool is_new_frame(std::int64_t now_us, const GuardSample& sample) noexcept;
  [[nodiscard]] bool take_frame(std::int64_t now_us, const GuardSample& sample,
                                Admission& admission) noexcept;
  void watch_force(const WantedForce& wanted) noexcept;
  void watch_clock(const TickTime& time) noexcept;
  void watch_ages(const TickTime& time, std::int64_t now_us, const WantedForce& wanted) noexcept;
  /// For this tick: it is late, or a value is not finite.
  [[nodiscard]] bool ends_force() const noexcept;
  void rest(double growing_s) noexcept;
  [[nodiscard]] glm::dvec3 limit(const glm::dvec3& wanted_n) noexcept;
  [[nodiscard]] double remaining_part(const TickTime& time, std::int64_t now_us) noexcept;
  void engage(const glm::dvec3& limited_n, double contact_n, double growing_s) noexcept;
  [[nodiscard]] glm::dvec3 rise(const glm::dvec3& force_n, double growing_s) noexcept;
  [[nodiscard]] GuardState state(double gain) const noexcept;

  GuardSettings settings_;
  SafeCause cause_ = SafeCause::none;
  TickClock clock_;
  Age frame_age_, clay_age_;
  JumpFilter jumps_;
  Engagement engagement_;
  Recovery recovery_;
  HeatLimit heat_;
  double rested_s_ = 0.0;
  std::int64_t seen_us_ = 0;  // stamp of the newest frame, plausible or not
  bool seen_ = false;
  int not_finite_ticks_ = 0;
  std::uint32_t flags_ = 0;  // of the tick that runs
  bool ready_ = false, admitted_ = false;
  glm::dvec3 sent_n_{0.0};
};

inline constexpr std::uint32_t kAllGuardRules = ~0u;

template <std::uint32_t rules>
Admission BasicForceGuard<rules>::admit(std::int64_t now_us, const GuardSample& sample) noexcept {
  Admission admission;
  flags_ = 0;
  admitted_ = false;
  ready_ = sample.ready || !on(kRuleReady);
  const bool is_new = is_new_frame(now_us, sample);
  if (!ready_) {
    flags_ |= kGuardNotReady;
    jumps_.forget();
    frame_age_.forget();
    engagement_.restart();
  } else if (on(kRuleFinite) && !is_finite(sample.position_mm)) {
    flags_ |= kGuardNotFinite;
  } else if (is_new) {
    admitted_ = take_frame(now_us, sample, admission);
  }
  admission.may_deform = admitted_ && cause_ == SafeCause::none &&
                         (frame_age_.at(now_us) < settings_.stale_fade_s || !on(kRuleStaleFrames));
  return admission;
}

template <std::uint32_t rules>
bool BasicForceGuard<rules>::is_new_frame(std::int64_t now_us, const GuardSample& sample) noexcept {
  if (!sample.fresh || (seen_ && sample.time_us == seen_us_)) return false;
  if (elapsed_s(now_us, sample.time_us) >= kLongestToZeroS) {  // from the future
    flags_ |= kGuardClock;
    return false;
  }
  seen_us_ = sample.time_us;
  seen_ = true;
  return true;
}

/// True if the frame is plausible.
template <std::uint32_t rules>
bool BasicForceGuard<rules>::take_frame(std::int64_t now_us, const GuardSample& sample,
                                        Admission& admission) noexcept {
  const double since =
      frame_age_.any() ? elapsed_s(frame_age_.stamp_us(), sample.time_us) : kShortestStepS;
  admission.step_s = on(kRuleStep) ? std::clamp(since, kShortestStepS, kLongestStepS) : since;
  const double reach = settings_.jump_mm_per_s * std::max(admission.step_s, settings_.period_s);
  const auto verdict =
      on(kRuleJump) ? jumps_.take(sample.position_mm, reach) : JumpFilter::Verdict::plausible;
  if (verdict == JumpFilter::Verdict::plausible) {
    frame_age_.see(sample.time_us, now_us);
    return true;
  }
  flags_ |= kGuardJump;
  if (verdict == JumpFilter::Verdict::stays) latch(SafeCause::jumped);
  return false;
}

template <std::uint32_t rules>
GuardedForce BasicForceGuard<rules>::force(std::int64_t now_us,
                                           const WantedForce& wanted) noexcept {
  const TickTime time = clock_.advance(now_us, settings_.period_s);
  if (on(kRuleHeat)) heat_.hold(norm(sent_n_), settings_.hot_force_n, time, settings_.hot_time_s);
  watch_force(wanted);
  watch_clock(time);
  watch_ages(time, now_us, wanted);
  rest(time.growing_s);

  const glm::dvec3 limited = limit(wanted.force_n);
  const double held = remaining_part(time, now_us);
  engage(limited, wanted.contact_n, time.growing_s);
  const double gain = held * engagement_.gain();
  const bool zero =
      cause_ != SafeCause::none || !ready_ || !frame_age_.any() || ends_force() || gain == 0.0;
  sent_n_ = zero ? glm::dvec3(0.0) : rise(gain * limited, time.growing_s);

  const GuardedForce out{sent_n_, gain, state(gain), cause_, flags_};
  flags_ = 0;
  admitted_ = false;
  return out;
}

template <std::uint32_t rules>
void BasicForceGuard<rules>::watch_force(const WantedForce& wanted) noexcept {
  if (!is_finite(wanted.force_n)) flags_ |= kGuardNotFinite;
  not_finite_ticks_ = (flags_ & kGuardNotFinite) != 0 ? not_finite_ticks_ + 1 : 0;
  if (on(kRuleNotFiniteLatch) && not_finite_ticks_ >= settings_.not_finite_ticks)
    latch(SafeCause::not_finite);
  if (on(kRulePassive) && !wanted.passive) latch(SafeCause::not_passive);
}

template <std::uint32_t rules>
void BasicForceGuard<rules>::watch_clock(const TickTime& time) noexcept {
  if (time.real_s == 0.0) flags_ |= kGuardClock;
  if (time.real_s >= settings_.late_zero_s) flags_ |= kGuardLate;
  if (on(kRuleOverrun) && time.real_s > settings_.pause_s) latch(SafeCause::overrun);
}

template <std::uint32_t rules>
void BasicForceGuard<rules>::watch_ages(const TickTime& time, std::int64_t now_us,
                                        const WantedForce& wanted) noexcept {
  if (!admitted_) frame_age_.pass(time.fading_s);
  if (clay_age_.is_last(wanted.clay_time_us)) clay_age_.pass(time.fading_s);
  clay_age_.see(wanted.clay_time_us, now_us);
  if (!on(kRulePause)) return;
  if (frame_age_.any() && frame_age_.at(now_us) > settings_.pause_s) {
    jumps_.forget();
    frame_age_.forget();
    engagement_.restart();
  }
  if (clay_age_.at(now_us) >= settings_.clay_zero_s) engagement_.restart();
}

template <std::uint32_t rules>
bool BasicForceGuard<rules>::ends_force() const noexcept {
  return (on(kRuleFinite) && (flags_ & kGuardNotFinite) != 0) ||
         (on(kRuleLate) && (flags_ & kGuardLate) != 0);
}

template <std::uint32_t rules>
void BasicForceGuard<rules>::rest(double growing_s) noexcept {
  if (!admitted_) return;
  rested_s_ += growing_s;
  const bool rested = clears_itself(cause_) && rested_s_ >= settings_.safe_rest_s;
  if (rested || !on(kRuleLatch)) cause_ = SafeCause::none;
}

template <std::uint32_t rules>
glm::dvec3 BasicForceGuard<rules>::limit(const glm::dvec3& wanted_n) noexcept {
  if (!is_finite(wanted_n) && on(kRuleFinite)) return glm::dvec3(0.0);
  if (norm(wanted_n) > settings_.force_limit_n) flags_ |= kGuardLimited;
  return on(kRuleLimit) ? limit_norm(wanted_n, settings_.force_limit_n) : wanted_n;
}

/// Remaining fraction of the force, 0 to 1: while it fades because of frames, clay or motors, in a
/// tick that ends it, and until it has recovered.
template <std::uint32_t rules>
double BasicForceGuard<rules>::remaining_part(const TickTime& time, std::int64_t now_us) noexcept {
  const double frame_s = frame_age_.at(now_us), clay_s = clay_age_.at(now_us);
  double held = 1.0;
  if (frame_age_.any() && frame_s > settings_.stale_fade_s) flags_ |= kGuardStale;
  if (clay_s > settings_.clay_fade_s) flags_ |= kGuardOldClay;
  // The force of this tick stands until the next one, which must not find it too old.
  const double last_s = settings_.stale_zero_s - kHeldPeriods * settings_.period_s;
  if (on(kRuleStaleFrames) && frame_age_.any())
    held *= fade(frame_s, settings_.stale_fade_s, last_s);
  if (on(kRuleOldClay)) held *= fade(clay_s, settings_.clay_fade_s, settings_.clay_zero_s);
  if (ends_force()) held = 0.0;
  if (on(kRuleRecovery)) held = recovery_.after(held, time.growing_s);
  if (heat_.fading()) flags_ |= kGuardHot;
  if (heat_.fade_out(time.fading_s, settings_.hot_fade_s)) engagement_.restart();
  return held * heat_.gain();
}

template <std::uint32_t rules>
void BasicForceGuard<rules>::engage(const glm::dvec3& limited_n, double contact_n,
                                    double growing_s) noexcept {
  if (cause_ != SafeCause::none || !ready_) return;
  const double small = settings_.small_force_n;
  const bool large = (flags_ & kGuardNotFinite) != 0 || !(contact_n < small);
  const double wanted = large ? settings_.force_limit_n : norm(limited_n);
  if (!on(kRuleSmallForce))
    engagement_.want(0.0, small, 1);
  else if (admitted_ || !(wanted < small))
    engagement_.want(wanted, small, settings_.small_force_ticks);
  engagement_.grow(growing_s, on(kRuleRamp) ? settings_.ramp_s : kShortestStepS);
}

template <std::uint32_t rules>
glm::dvec3 BasicForceGuard<rules>::rise(const glm::dvec3& force_n, double growing_s) noexcept {
  if (!on(kRuleSlew)) return force_n;
  const glm::dvec3 risen = limit_rise(force_n, sent_n_, settings_.slew_n_per_s * growing_s);
  if (risen != force_n) flags_ |= kGuardSlewed;
  // Between two forces within the limit, apart from rounding.
  return on(kRuleLimit) ? limit_norm(risen, settings_.force_limit_n) : risen;
}

template <std::uint32_t rules>
GuardState BasicForceGuard<rules>::state(double gain) const noexcept {
  if (cause_ != SafeCause::none) return GuardState::safe;
  if (!ready_ || !frame_age_.any()) return GuardState::idle;
  if (engagement_.phase() == Engagement::Phase::waiting) return GuardState::waiting;
  if ((flags_ & (kGuardStale | kGuardOldClay | kGuardHot)) != 0) return GuardState::fading;
  return gain < 1.0 ? GuardState::ramping : GuardState::engaged;
}

template <std::uint32_t rules>
void BasicForceGuard<rules>::latch(SafeCause cause) noexcept {
  if (cause == SafeCause::stopped && !on(kRuleStop)) return;
  const bool holds = cause_ != SafeCause::none && !clears_itself(cause_);
  if (cause != SafeCause::stopped && holds) return;
  cause_ = cause;
  rested_s_ = 0.0;
  engagement_.restart();
}

template <std::uint32_t rules>
bool BasicForceGuard<rules>::rearm() noexcept {
  if (cause_ == SafeCause::stopped) return false;
  cause_ = SafeCause::none;
  engagement_.restart();
  return true;
}

}  // namespace clay::falcon::inline safety
