#include "claystack/falcon/passivity.hpp"

#include "falcon/device/setting_ranges.hpp"
#include "falcon/safety/arm_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace clay::falcon::inline safety {
namespace {

constexpr int kBisections = 60;

/// Coefficients from the constant term up.
struct Polynomial {
  std::array<double, kMostDelayTicks + 4> a{};
  std::size_t degree = 0;
};

/// Transfer function from held force to position: (c1 z + c0) / ((z - 1)(z - p)).
struct HeldArm {
  double p, c1, c0;
};

HeldArm held_arm(const SampledLoop& loop) noexcept {
  // In a period a velocity v becomes p v and covers s v; a force from rest gives the velocity u
  // and covers d. Then c1 = d and c0 = u s - p d, which is free of cancellation as b -> 0.
  const double inertia = loop.inertia_ns2_per_mm(), decay = loop.damping_ns_per_mm / inertia;
  const ArmResponse r = arm_response(decay, 0.0, loop.period_s());
  const double p = r.velocity.x - decay * r.velocity.y, s = r.path.x - decay * r.path.y;
  const double u = r.velocity.y / inertia, d = r.path.y / inertia;
  return {p, d, u * s - p * d};
}

Polynomial characteristic(const SampledLoop& loop, const VirtualWall& wall) noexcept {
  const HeldArm arm = held_arm(loop);
  const double slope = wall.damping_ns_per_mm * loop.rate_hz;
  const auto n = static_cast<std::size_t>(loop.delay_ticks);
  Polynomial q;
  q.degree = n + 3;
  q.a[n + 3] = 1.0;
  q.a[n + 2] = -(1.0 + arm.p);
  q.a[n + 1] = arm.p;
  const double now = wall.stiffness_n_per_mm + slope, before = -slope;
  q.a[2] += now * arm.c1;
  q.a[1] += now * arm.c0 + before * arm.c1;
  q.a[0] += before * arm.c0;
  return q;
}

/// All roots within the unit circle: Jury's test, in the normalised form of Schur and Cohn.
bool all_within(Polynomial q) noexcept {
  for (std::size_t n = q.degree; n > 0; --n) {
    const double k = q.a[0] / q.a[n];
    if (!(std::abs(k) < 1.0)) return false;
    Polynomial lower;
    for (std::size_t i = 0; i < n; ++i) lower.a[i] = q.a[i + 1] - k * q.a[n - 1 - i];
    q.a = lower.a;
  }
  return true;
}

/// The upper border of the interval from 0 in which a condition holds, by doubling and bisection; 0
/// if it never holds.
template <class Holds>
double border_of(double first, Holds holds) noexcept {
  double inside = first;
  for (int n = 0; n < kBisections && !holds(inside); ++n) inside *= 0.5;
  if (!holds(inside)) return 0.0;
  double outside = 2.0 * inside;
  while (holds(outside) && outside < 1e300) {
    inside = outside;
    outside *= 2.0;
  }
  for (int n = 0; n < kBisections && outside - inside > 1e-12 * outside; ++n) {
    const double middle = 0.5 * (inside + outside);
    (holds(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

tl::expected<void, OutOfRange> check(const SampledLoop& loop) noexcept {
  const OutOfRange settings[] = {
      {"rate_hz", 10.0, 1e5, loop.rate_hz},
      {"mass_kg", 1e-3, 100.0, loop.mass_kg},
      {"damping_ns_per_mm", 0.0, 1.0, loop.damping_ns_per_mm},
      {"delay_ticks", 0.0, kMostDelayTicks, static_cast<double>(loop.delay_ticks)},
  };
  return check_ranges(settings);
}

double passive_damping_at(const SampledLoop& loop, const VirtualWall& wall,
                          double angle_rad) noexcept {
  double cosines = 1.0;
  for (int k = 1; k <= loop.delay_ticks; ++k) cosines += 2.0 * std::cos(k * angle_rad);
  return 0.5 * wall.stiffness_n_per_mm * loop.period_s() * cosines -
         wall.damping_ns_per_mm * std::cos((loop.delay_ticks + 1) * angle_rad);
}

double passive_damping(const SampledLoop& loop, const VirtualWall& wall) noexcept {
  // The grid spacing is less than 1/100 of the fastest cosine's wavelength, so the maximum is
  // beside the best grid point: refined by ternary search.
  const int points = 200 * (loop.delay_ticks + 1);
  const double step = std::numbers::pi / points;
  const auto at = [&](double angle) { return passive_damping_at(loop, wall, angle); };
  int best = 0;
  for (int k = 1; k <= points; ++k)
    if (at(k * step) > at(best * step)) best = k;
  double low = std::max(0, best - 1) * step, high = std::min(points, best + 1) * step;
  double most = at(best * step);
  for (int n = 0; n < kBisections; ++n) {
    const double third = (high - low) / 3.0, left = at(low + third), right = at(high - third);
    most = std::max({most, left, right});
    (left < right ? low : high) = left < right ? low + third : high - third;
  }
  return most;
}

double passive_stiffness(const SampledLoop& loop) noexcept {
  return 2.0 * loop.damping_ns_per_mm * loop.rate_hz / (2 * loop.delay_ticks + 1);
}

bool is_stable(const SampledLoop& loop, const VirtualWall& wall) noexcept {
  return all_within(characteristic(loop, wall));
}

double stable_stiffness(const SampledLoop& loop, double wall_damping_ns_per_mm) noexcept {
  return border_of(loop.inertia_ns2_per_mm() * loop.rate_hz * loop.rate_hz, [&](double stiffness) {
    return is_stable(loop, {stiffness, wall_damping_ns_per_mm});
  });
}

double stable_damping(const SampledLoop& loop, double stiffness_n_per_mm) noexcept {
  return border_of(loop.inertia_ns2_per_mm() * loop.rate_hz, [&](double damping) {
    return is_stable(loop, {stiffness_n_per_mm, damping});
  });
}

double accepted_stiffness(const SampledLoop& loop) noexcept {
  return 0.5 * passive_stiffness(loop);
}

tl::expected<void, StiffnessTooHigh> check_stiffness(const SampledLoop& loop,
                                                     double stiffness_n_per_mm) noexcept {
  const double highest = accepted_stiffness(loop);
  // A stiffness that is the limit but for rounding is accepted.
  constexpr double kRounding = 1e-12;
  if (stiffness_n_per_mm >= 0.0 && stiffness_n_per_mm <= highest * (1.0 + kRounding)) return {};
  const double per_hertz = highest / loop.rate_hz;
  const double rate =
      per_hertz > 0.0 ? stiffness_n_per_mm / per_hertz : std::numeric_limits<double>::infinity();
  return tl::make_unexpected(StiffnessTooHigh{stiffness_n_per_mm, highest, rate});
}

}  // namespace clay::falcon::inline safety
