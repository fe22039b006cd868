#include "claystack/falcon/energy_observer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace clay::falcon {
namespace {

constexpr double kDoubtfulSteps = 2.0;

}  // namespace

EnergyObserver::EnergyObserver(const SampledLoop& loop, double step_m, double window_s) noexcept
    : damping_(loop.damping_ns_per_m),
      step_m_(step_m),
      bucket_s_(window_s / static_cast<double>(kBuckets)),
      drain_ticks_(loop.delay_ticks + 1) {}

bool EnergyObserver::observe(double dt_s, const glm::dvec3& held_n, const glm::dvec3& way_m,
                             const glm::dvec3& asked_n) noexcept {
  pass_time(dt_s);
  const double held = glm::length(held_n);
  if (in_contact_) {
    peak_n_ = std::max(peak_n_, held);
    follow_stroke(dt_s, held, held > 0.0 ? -glm::dot(held_n, way_m) / held : 0.0);
  } else {
    injected_ += glm::dot(held_n, way_m);
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

void EnergyObserver::follow_stroke(double dt_s, double held_n, double inward_m) noexcept {
  Stroke& s = stroke_;
  if (s.sign == 0.0 && inward_m != 0.0) s.sign = inward_m > 0.0 ? 1.0 : -1.0;
  s.depth_m += inward_m;
  s.time_s += dt_s;
  const double beyond = s.depth_m - s.furthest_m;
  if (beyond * s.sign >= 0.0) {
    injected_ -= held_n * beyond;
    s.furthest_m = s.depth_m;
    s.doubtful_j = 0.0;
    credit_stroke();
    return;
  }
  s.doubtful_j -= held_n * inward_m;
  if (std::abs(beyond) <= kDoubtfulSteps * step_m_) return;
  injected_ += s.doubtful_j;
  stroke_ = {.sign = -s.sign,
             .depth_m = beyond,
             .furthest_m = beyond,
             .doubtful_j = 0.0,
             .time_s = dt_s,
             .credit_j = 0.0};
}

/// The arm's own damping takes at least b L^2 / t out of a way L in the time t (Cauchy, Schwarz),
/// and an encoder knows L to a step.
void EnergyObserver::credit_stroke() noexcept {
  const double way = std::max(0.0, std::abs(stroke_.furthest_m) - step_m_);
  const double credit = std::max(stroke_.credit_j, damping_ * way * way / stroke_.time_s);
  injected_ -= credit - stroke_.credit_j;
  stroke_.credit_j = credit;
}

void EnergyObserver::end_contact() noexcept {
  in_contact_ = false;
  injected_ += stroke_.doubtful_j;
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
