#include "falcon/safety/passivity_law.hpp"

#include "core/limit_norm.hpp"
#include "falcon/device/setting_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace clay::falcon::inline safety {
namespace {

// A single debt may be accidental; several without a quiet interval between them are an
// oscillation.
constexpr int kMostDebts = 3;
constexpr double kGoodWhileS = 2.0;
constexpr double kYield = 0.5;
constexpr double kPayWithinS = 0.5;  // or it counts again

double most_damping(const PassivitySettings& settings, const SampledLoop& loop,
                    double stiffness) noexcept {
  const double borne = 0.5 * stable_damping(loop, stiffness);
  if (!(settings.step_mm > 0.0)) return borne;
  return std::min(borne, 0.25 * settings.reversal_force_n / (settings.step_mm * loop.rate_hz));
}

}  // namespace

tl::expected<void, OutOfRange> check(const PassivitySettings& settings) noexcept {
  if (auto checked = check(settings.loop); !checked) return checked;
  const OutOfRange ranges[] = {
      {"step_mm", 0.0, 10.0, settings.step_mm},
      {"energy_limit_mj", 1e-6, 1e6, settings.energy_limit_mj},
      {"energy_window_s", 1e-3, 10.0, settings.energy_window_s},
      {"reversal_limit", 2.0, kMostSwings, static_cast<double>(settings.reversal_limit)},
      {"reversal_window_s", 1e-3, 10.0, settings.reversal_window_s},
      {"reversal_force_n", 1e-9, 1e3, settings.reversal_force_n},
  };
  return check_ranges(ranges);
}

PassivityLaw::PassivityLaw(const PassivitySettings& settings) noexcept
    : settings_(settings),
      period_(settings.loop.period_s()),
      stiffness_(accepted_stiffness(settings.loop)),
      most_damping_(most_damping(settings, settings.loop, stiffness_)),
      observer_(settings.loop, settings.step_mm, settings.energy_window_s),
      swings_(settings.reversal_limit, settings.reversal_window_s, settings.reversal_force_n) {}

PassiveForce PassivityLaw::tick(std::int64_t time_us, const glm::dvec3& reading_mm,
                                const glm::dvec3& force_n) noexcept {
  const bool advances = !last_ || time_us > last_->time_us;
  if (!advances || !is_finite(reading_mm) || !is_finite(force_n)) {
    send(glm::dvec3(0.0));
    return {glm::dvec3(0.0), state_};
  }
  const Reading before = last_.value_or(Reading{time_us, reading_mm});
  // Unsigned: the difference of two signed extremes must not overflow.
  const double dt_s = 1e-6 * static_cast<double>(static_cast<std::uint64_t>(time_us) -
                                                 static_cast<std::uint64_t>(before.time_us));
  const glm::dvec3 way = reading_mm - before.at_mm;
  last_ = Reading{time_us, reading_mm};
  now_s_ += dt_s;
  if (dt_s > 0.0 && period_.follow(dt_s)) set_period(period_.in_use_s());

  judge(observer_.observe(dt_s, sent_[oldest_], way, force_n), force_n);
  const glm::dvec3 force = answer(dt_s, way, force_n);
  send(force);
  return {force, state_};
}

void PassivityLaw::displayed(const glm::dvec3& force_n) noexcept {
  if (is_finite(force_n)) sent_[newest_] = force_n;
}

std::optional<double> PassivityLaw::slow_rate_hz() const noexcept {
  return period_.is_slow() ? std::optional(1.0 / period_.in_use_s()) : std::nullopt;
}

/// Force that was built up at a greater stiffness is reduced in the same ratio: otherwise the way
/// out would return more energy than the way in has taken.
void PassivityLaw::set_period(double period_s) noexcept {
  SampledLoop loop = settings_.loop;
  loop.rate_hz = 1.0 / period_s;
  const double before = std::exchange(stiffness_, accepted_stiffness(loop));
  most_damping_ = most_damping(settings_, loop, stiffness_);
  if (stiffness_ < before) earned_n_ *= stiffness_ / before;
}

void PassivityLaw::judge(bool contact_ended, const glm::dvec3& asked_n) noexcept {
  if (state_ == PassivityState::safe) return;
  const bool yields = state_ == PassivityState::yielding;
  const glm::dvec3& swinging = yields ? last_sent_ : asked_n;
  const bool rattles = swings_.swings_too_often(now_s_, swinging);
  if (rattles || observer_.recent_mj() > settings_.energy_limit_mj) return escalate();
  if (yields) return;

  const bool owes = observer_.debt_mj() > observer_.tolerance_mj();
  const bool again = state_ == PassivityState::watching || now_s_ - last_debt_s_ > kPayWithinS ||
                     (contact_ended && observer_.last_contact_mj() > 0.0);
  if (owes && again) count_debt();
  if (debts_ >= kMostDebts) return escalate();
  state_ = owes ? PassivityState::damping : PassivityState::watching;
}

void PassivityLaw::count_debt() noexcept {
  if (now_s_ - last_debt_s_ > kGoodWhileS) debts_ = 0;
  last_debt_s_ = now_s_;
  ++debts_;
}

void PassivityLaw::escalate() noexcept {
  state_ = state_ == PassivityState::yielding ? PassivityState::safe : PassivityState::yielding;
  observer_.forgive();
  earned_n_ *= kYield;
  swings_ = SwingCounter(settings_.reversal_limit, settings_.reversal_window_s,
                         settings_.reversal_force_n);
}

glm::dvec3 PassivityLaw::answer(double dt_s, const glm::dvec3& way_mm,
                                const glm::dvec3& asked_n) noexcept {
  if (state_ == PassivityState::safe) return glm::dvec3(0.0);
  const glm::dvec3 force = earned(way_mm, asked_n);
  return state_ == PassivityState::damping ? force + damping(dt_s, way_mm) : force;
}

/// Equation (10) of the paper: the damping that removes the debt within a period.
glm::dvec3 PassivityLaw::damping(double dt_s, const glm::dvec3& way_mm) const noexcept {
  const double square = glm::dot(way_mm, way_mm);
  if (!(square > 0.0)) return glm::dvec3(0.0);
  const double debt = observer_.debt_mj() - observer_.tolerance_mj();
  const double amount = std::min(debt * dt_s / square, most_damping_);
  return -amount / dt_s * way_mm;
}

/// The smaller of two forces: the requested one, and that of a spring of the accepted stiffness
/// from the start of the contact. A softer contact passes unchanged. Force that a yielding contact
/// has lost must be built up again by moving inward.
glm::dvec3 PassivityLaw::earned(const glm::dvec3& way_mm, const glm::dvec3& asked_n) noexcept {
  const double asked = glm::length(asked_n);
  const double before = std::exchange(last_requested_n_, asked);
  if (!(asked > 0.0)) {
    earned_n_ = 0.0;
    return glm::dvec3(0.0);
  }
  const double stiffness = (state_ == PassivityState::yielding ? kYield : 1.0) * stiffness_;
  const glm::dvec3 direction = asked_n / asked;
  const double out_mm = glm::dot(way_mm, direction);
  // The force of a spring does not fall while it is pressed, so this part of it has yielded.
  const double yielded = out_mm <= 0.0 ? std::max(0.0, before - asked) : 0.0;
  earned_n_ = std::max(0.0, earned_n_ - stiffness * out_mm - yielded);
  return earned_n_ < asked ? earned_n_ * direction : asked_n;
}

void PassivityLaw::send(const glm::dvec3& force_n) noexcept {
  const auto length = static_cast<std::size_t>(settings_.loop.delay_ticks) + 1;
  last_sent_ = force_n;
  sent_[oldest_] = force_n;
  newest_ = oldest_;
  oldest_ = (oldest_ + 1) % length;
}

}  // namespace clay::falcon::inline safety
