#include "falcon/safety/energy_observer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace clay::falcon::inline safety {
namespace {

constexpr double kDoubtfulSteps = 4.0;
constexpr double kPieceSteps = 16.0;

}  // namespace

EnergyObserver::EnergyObserver(const SampledLoop& loop, double step_mm, double window_s) noexcept
    : damping_(loop.damping_ns_per_mm),
      step_mm_(step_mm),
      mark_s_(window_s / static_cast<double>(kBuckets)),
      drain_ticks_(loop.delay_ticks + 1) {}

bool EnergyObserver::observe(double dt_s, const glm::dvec3& held_n, const glm::dvec3& way_mm,
                             const glm::dvec3& asked_n) noexcept {
  pass_time(dt_s);
  const double held = glm::length(held_n);
  if (in_contact_) {
    peak_n_ = std::max(peak_n_, held);
    follow_stroke(dt_s, held, held > 0.0 ? -glm::dot(held_n, way_mm) / held : 0.0);
  } else {
    injected_ += glm::dot(held_n, way_mm);
  }

  const bool asks = glm::length(asked_n) > 0.0;
  quiet_ticks_ = asks ? 0 : quiet_ticks_ + 1;
  if (asks && !in_contact_) begin_contact(dt_s, way_mm);
  // After a contact has stopped requesting force, its last forces are still delayed.
  const bool ends = in_contact_ && quiet_ticks_ >= drain_ticks_;
  if (ends) end_contact();
  return ends;
}

void EnergyObserver::begin_contact(double dt_s, const glm::dvec3& way_mm) noexcept {
  in_contact_ = true;
  before_contact_ = injected_;
  last_peak_n_ = std::exchange(peak_n_, 0.0);
  stroke_ = {};
  last_turn_.reset();
  // The surface was passed on the way to this reading.
  const double sure = std::max(0.0, glm::length(way_mm) - step_mm_);
  if (dt_s > 0.0) injected_ -= damping_ * sure * sure / dt_s;
}

void EnergyObserver::follow_stroke(double dt_s, double held_n, double inward_mm) noexcept {
  Stroke& s = stroke_;
  if (s.sign == 0.0 && inward_mm != 0.0) s.sign = inward_mm > 0.0 ? 1.0 : -1.0;
  s.depth_mm += inward_mm;
  s.time_s += dt_s;
  const double beyond = s.depth_mm - s.furthest_mm;
  if (beyond * s.sign >= 0.0) {
    injected_ -= held_n * beyond;
    s.furthest_mm = s.depth_mm;
    s.force_n = held_n;
    s.doubtful_mj = s.doubtful_s = 0.0;
    credit_stroke();
    return;
  }
  s.doubtful_mj -= held_n * inward_mm;
  s.doubtful_s += dt_s;
  if (std::abs(beyond) <= kDoubtfulSteps * step_mm_) return;
  if (s.sign > 0.0) close_loop();
  injected_ += s.doubtful_mj;
  stroke_ = {.sign = -s.sign,
             .from_mm = s.furthest_mm,
             .depth_mm = s.depth_mm,
             .furthest_mm = s.depth_mm,
             .force_n = held_n,
             .doubtful_mj = 0.0,
             .doubtful_s = 0.0,
             .time_s = s.doubtful_s,
             .credit_mj = 0.0};
  credit_stroke();
}

/// The spring has stored at least the smaller force times the distance inward, and has released at
/// most the larger force times the distance outward.
void EnergyObserver::close_loop() noexcept {
  const Turn turn{injected_, stroke_.furthest_mm, stroke_.force_n};
  if (last_turn_) {
    const double deeper = turn.depth_mm - last_turn_->depth_mm;
    const double least = std::min(turn.force_n, last_turn_->force_n);
    const double most = std::max(turn.force_n, last_turn_->force_n);
    const double stored = (deeper > 0.0 ? least : most) * deeper;
    looped_ = std::max(0.0, looped_ + turn.injected_mj - last_turn_->injected_mj + stored);
  }
  last_turn_ = turn;
}

/// The arm's damping dissipates at least b L^2 / t over a distance L in the time t (Cauchy,
/// Schwarz), and an encoder measures L to one step. Pieces of several steps lose little by either
/// bound.
void EnergyObserver::credit_stroke() noexcept {
  Stroke& s = stroke_;
  const double length = std::abs(s.furthest_mm - s.from_mm),
               sure = std::max(0.0, length - step_mm_);
  const double credit = std::max(s.credit_mj, damping_ * sure * sure / s.time_s);
  injected_ -= credit - s.credit_mj;
  s.credit_mj = credit;
  if (length < kPieceSteps * step_mm_) return;
  s.from_mm = s.furthest_mm;
  s.time_s = s.credit_mj = 0.0;
}

void EnergyObserver::end_contact() noexcept {
  in_contact_ = false;
  injected_ += stroke_.doubtful_mj;
  last_contact_ = injected_ - before_contact_;
  gains_ += std::max(0.0, last_contact_);
  injected_ = std::max(0.0, injected_);
}

double EnergyObserver::given() const noexcept {
  return gains_ + (in_contact_ ? std::max(0.0, injected_ - before_contact_) : 0.0);
}

void EnergyObserver::pass_time(double dt_s) noexcept {
  since_mark_s_ += dt_s;
  for (std::size_t n = 0; n < kBuckets && since_mark_s_ >= mark_s_; ++n) {
    since_mark_s_ -= mark_s_;
    given_before_[oldest_] = given();
    oldest_ = (oldest_ + 1) % kBuckets;
  }
  since_mark_s_ = std::min(since_mark_s_, mark_s_);
}

double EnergyObserver::recent_mj() const noexcept { return given() - given_before_[oldest_]; }

void EnergyObserver::forgive() noexcept {
  injected_ = std::min(0.0, injected_);
  looped_ = 0.0;
  last_turn_.reset();
  before_contact_ = injected_;
  gains_ = 0.0;
  given_before_ = {};
}

}  // namespace clay::falcon::inline safety
