#include "falcon/sim/arm_axis.hpp"

#include <algorithm>
#include <cmath>

namespace clay::falcon::inline sim {
namespace {

// A tick has a few reversals at most; after this many the axis sticks.
constexpr int kMostPhases = 32;
constexpr int kBisections = 60;

/// Initial state of a slide, relative to the hand's point, which is then at rest.
struct Start {
  double velocity, acceleration;
};

Start start_of(const ArmAxis& axis, double force_n, double intended_mm_s,
               const AxisState& s) noexcept {
  const double w = s.velocity_mm_s - intended_mm_s;
  const double resistance = axis.damping_ns_per_mm * s.velocity_mm_s +
                            axis.hand_damping_ns_per_mm * w +
                            axis.hand_stiffness_n_per_mm * (s.position_mm - s.intended_mm);
  return {w, (force_n - resistance) / axis.inertia_ns2_per_mm};
}

/// `force_n` includes friction: its sign is constant during a slide.
void slide(const ArmAxis& axis, const ArmResponse& r, double force_n, double intended_mm_s,
           double time_s, AxisState& s) noexcept {
  const auto [w, a] = start_of(axis, force_n, intended_mm_s, s);
  const double path = r.path.x * w + r.path.y * a, way = intended_mm_s * time_s;
  const double square = r.square.x * w * w + r.square.y * w * a + r.square.z * a * a;
  s.damped_mj += axis.damping_ns_per_mm * (square + intended_mm_s * (2.0 * path + way));
  s.rubbed_mj += axis.friction_n * std::abs(path + way);
  s.position_mm += path + way;
  s.velocity_mm_s = intended_mm_s + (r.velocity.x * w + r.velocity.y * a);
  s.intended_mm += way;
}

double velocity_after(const ArmAxis& axis, const Start& start, double intended_mm_s,
                      double time_s) noexcept {
  const ArmResponse r = axis.response_over(time_s);
  return intended_mm_s + r.velocity.x * start.velocity + r.velocity.y * start.acceleration;
}

/// Slides with friction against `sign` until the time ends or the velocity reverses; returns the
/// duration.
double slide_until_turn(const ArmAxis& axis, double force_n, double intended_mm_s, double sign,
                        double time_s, AxisState& s) noexcept {
  const double net = force_n - sign * axis.friction_n;
  const Start start = start_of(axis, net, intended_mm_s, s);
  const auto turned = [&](double t) {
    return sign * velocity_after(axis, start, intended_mm_s, t) < 0.0;
  };
  double before = 0.0, after = time_s;
  const bool turns = turned(time_s);
  for (int n = 0; turns && n < kBisections; ++n) {
    const double middle = 0.5 * (before + after);
    (turned(middle) ? after : before) = middle;
  }
  slide(axis, axis.response_over(after), net, intended_mm_s, after, s);
  if (turns) s.velocity_mm_s = 0.0;
  return after;
}

struct Rest {
  double time_s;  ///< until the pull exceeds static friction
  double sign;    ///< of the motion that then begins; 0: none within the given time
};

Rest rest_of(const ArmAxis& axis, double force_n, double intended_mm_s, double time_s,
             const AxisState& s) noexcept {
  const double pull = force_n + axis.hand_stiffness_n_per_mm * (s.intended_mm - s.position_mm) +
                      axis.hand_damping_ns_per_mm * intended_mm_s;
  if (std::abs(pull) > axis.friction_n) return {0.0, pull > 0.0 ? 1.0 : -1.0};
  const double growth = axis.hand_stiffness_n_per_mm * intended_mm_s;
  if (growth == 0.0) return {time_s, 0.0};
  const double sign = growth > 0.0 ? 1.0 : -1.0;
  const double wait = (sign * axis.friction_n - pull) / growth;
  return wait < time_s ? Rest{wait, sign} : Rest{time_s, 0.0};
}

void move_with_friction(const ArmAxis& axis, double force_n, double intended_mm_s,
                        AxisState& s) noexcept {
  // Short enough that the velocity reverses at most once in a slide.
  const double swing_s = 0.5 * std::sqrt(axis.inertia_ns2_per_mm / axis.hand_stiffness_n_per_mm);
  double left_s = axis.period_s;
  for (int phase = 0; phase < kMostPhases && left_s > 0.0; ++phase) {
    double sign = s.velocity_mm_s > 0.0 ? 1.0 : -1.0;
    if (s.velocity_mm_s == 0.0) {
      const Rest rest = rest_of(axis, force_n, intended_mm_s, left_s, s);
      s.intended_mm += intended_mm_s * rest.time_s;
      left_s -= rest.time_s;
      if (rest.sign == 0.0) return;
      sign = rest.sign;
    }
    left_s -= slide_until_turn(axis, force_n, intended_mm_s, sign, std::min(left_s, swing_s), s);
  }
  s.intended_mm += intended_mm_s * left_s;
}

}  // namespace

void move(const ArmAxis& axis, double force_n, double intended_mm_s, AxisState& state) noexcept {
  if (!axis.guided()) intended_mm_s = 0.0;
  if (axis.friction_n > 0.0)
    move_with_friction(axis, force_n, intended_mm_s, state);
  else
    slide(axis, axis.response, force_n, intended_mm_s, axis.period_s, state);
}

}  // namespace clay::falcon::inline sim
