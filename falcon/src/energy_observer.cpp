#include "claystack/falcon/energy_observer.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace clay::falcon {

EnergyObserver::EnergyObserver(const SampledLoop& loop, double step_m, double window_s) noexcept
    : damping_(loop.damping_ns_per_m),
      step_m_(step_m),
      bucket_s_(window_s / static_cast<double>(kBuckets)),
      drain_ticks_(loop.delay_ticks + 1) {}

bool EnergyObserver::observe(double dt_s, const glm::dvec3& held_n, const glm::dvec3& way_m,
                             const glm::dvec3& asked_n) noexcept {
  pass_time(dt_s);
  const double work = glm::dot(held_n, way_m);
  injected_ += work;
  if (in_contact_) {
    peak_n_ = std::max(peak_n_, glm::length(held_n));
    follow_stroke(dt_s, way_m, work);
  }

  const bool asks = glm::length(asked_n) > 0.0;
  quiet_ticks_ = asks ? 0 : quiet_ticks_ + 1;
  if (asks && !in_contact_) {
    in_contact_ = true;
    before_contact_ = injected_;
    peak_n_ = 0.0;
    stroke_ = {};
  }
  // The last forces of a contact are on their way when it has ceased to ask for any.
  const bool ends = in_contact_ && quiet_ticks_ >= drain_ticks_;
  if (ends) end_contact();
  return ends;
}

/// The arm's own damping takes at least b L^2 / t out of a way L in the time t (Cauchy, Schwarz),
/// and an encoder knows L to a step.
void EnergyObserver::follow_stroke(double dt_s, const glm::dvec3& way_m, double work_j) noexcept {
  const double sign = work_j > 0.0 ? 1.0 : work_j < 0.0 ? -1.0 : stroke_.sign;
  if (sign * stroke_.sign < 0.0) stroke_ = {};
  stroke_.sign = sign;
  stroke_.way_m += way_m;
  stroke_.time_s += dt_s;
  const double way = std::max(0.0, glm::length(stroke_.way_m) - step_m_);
  const double credit = std::max(stroke_.credit, damping_ * way * way / stroke_.time_s);
  injected_ -= credit - stroke_.credit;
  stroke_.credit = credit;
}

void EnergyObserver::end_contact() noexcept {
  in_contact_ = false;
  last_contact_ = injected_ - before_contact_;
  buckets_[bucket_] += std::max(0.0, last_contact_);
  injected_ = std::max(0.0, injected_);
}

void EnergyObserver::pass_time(double dt_s) noexcept {
  in_bucket_s_ += dt_s;
  for (std::size_t n = 0; n < kBuckets && in_bucket_s_ >= bucket_s_; ++n) {
    in_bucket_s_ -= bucket_s_;
    bucket_ = (bucket_ + 1) % kBuckets;
    buckets_[bucket_] = 0.0;
  }
  in_bucket_s_ = std::min(in_bucket_s_, bucket_s_);
}

double EnergyObserver::recent_j() const noexcept {
  double sum = in_contact_ ? std::max(0.0, injected_ - before_contact_) : 0.0;
  for (const double bucket : buckets_) sum += bucket;
  return sum;
}

void EnergyObserver::forgive() noexcept {
  injected_ = std::min(0.0, injected_);
  before_contact_ = injected_;
  buckets_ = {};
}

}  // namespace clay::falcon
