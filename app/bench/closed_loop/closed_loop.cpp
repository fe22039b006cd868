#include "app/bench/closed_loop/closed_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace clay::closed_loop {
namespace {

using falcon::ArmEnergy;
using falcon::PassivityController;
using falcon::SimulatedArm;

/// The injected energy so far, and its uncertainty.
struct Account {
  double injected_mj = 0.0;
  double tolerance_mj = 0.0;
  double rounding_mj = 0.0;  // of the sums so far
};

class EnergyBalance {
 public:
  EnergyBalance(const SimulatedArm& arm, const Surface& surface)
      : arm_(arm),
        surface_(surface),
        initial_mj_(total_mj()),
        // A reading is off by up to half a step, the force by K times that.
        force_error_n_(0.5 * surface.stiffness_n_per_mm() * arm.settings().step_mm),
        last_mm_(arm.position_mm()) {}

  void update() {
    const glm::dvec3 at = arm_.position_mm();
    if (surface_.stored_mj(at) > 0.0) tolerance_mj_ += force_error_n_ * std::abs(at.x - last_mm_.x);
    last_mm_ = at;
  }
  [[nodiscard]] Account account() const {
    const double gained = total_mj() - initial_mj_;
    return {gained - arm_.energy().hand, tolerance_mj_, kRounding * throughput_mj()};
  }

 private:
  // Rounding of a few additions per tick; the energies grow with the throughput.
  static constexpr double kRounding = 1e-13;
  [[nodiscard]] double total_mj() const {
    return arm_.kinetic_energy_mj() + surface_.stored_mj(arm_.position_mm());
  }
  [[nodiscard]] double throughput_mj() const {
    const ArmEnergy& e = arm_.energy();
    return std::abs(e.displayed) + std::abs(e.hand) + e.damped + e.rubbed;
  }
  const SimulatedArm& arm_;
  const Surface& surface_;
  double initial_mj_, force_error_n_, tolerance_mj_ = 0.0;
  glm::dvec3 last_mm_;
};

/// Finds the deepest points, where the arm reverses outward in contact.
class CycleWatch {
 public:
  void update(const SimulatedArm& arm, const Surface& surface, const Account& now,
              Outcome& outcome) {
    const double speed = arm.velocity_mm_s().x;
    const bool deepest =
        last_speed_ < 0.0 && speed >= 0.0 && surface.stored_mj(arm.position_mm()) > 0;
    last_speed_ = speed;
    if (!deepest) return;
    if (cycle_start_) {
      const double injected = now.injected_mj - cycle_start_->injected_mj;
      const double tolerance = now.tolerance_mj - cycle_start_->tolerance_mj + now.rounding_mj;
      outcome.worst_cycle_mj = outcome.cycles == 0
                                   ? injected - tolerance
                                   : std::max(outcome.worst_cycle_mj, injected - tolerance);
      ++outcome.cycles;
      sum_mj_ += injected - tolerance;
      outcome.mean_cycle_mj = sum_mj_ / outcome.cycles;
    }
    cycle_start_ = now;
  }

 private:
  double last_speed_ = 0.0, sum_mj_ = 0.0;
  std::optional<Account> cycle_start_;
};

/// Peak to peak about the regression line.
double swing_about_trend(const std::vector<double>& x) {
  if (x.size() < 2) return 0.0;
  const auto n = static_cast<double>(x.size());
  double sum = 0.0, moment = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    sum += x[k];
    moment += x[k] * (static_cast<double>(k) - 0.5 * (n - 1.0));
  }
  const double slope = 12.0 * moment / (n * (n * n - 1.0));
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double about = x[k] - sum / n - slope * (static_cast<double>(k) - 0.5 * (n - 1.0));
    low = std::min(low, about);
    high = std::max(high, about);
  }
  return high - low;
}

std::optional<PassivityController> controller_of(const Experiment& e) {
  if (!e.controlled) return std::nullopt;
  falcon::PassivitySettings settings;
  settings.loop = e.arm.loop;
  settings.step_mm = e.arm.step_mm;
  return PassivityController::build(settings).value();
}

}  // namespace

Outcome run(const Experiment& e, Surface& surface) {
  SimulatedArm arm = SimulatedArm::build(e.arm, e.hand, e.start_mm).value();
  auto controller = controller_of(e);
  EnergyBalance balance(arm, surface);
  CycleWatch cycles;
  Outcome outcome;
  const double rate = e.arm.loop.rate_hz;
  const auto ticks = static_cast<std::int64_t>(e.seconds * rate);
  const auto settled = static_cast<std::int64_t>((e.seconds - e.settled_s) * rate);
  Account then;
  std::vector<double> positions;
  positions.reserve(static_cast<std::size_t>(ticks - settled));
  for (std::int64_t k = 0; k < ticks; ++k) {
    const double time_s = static_cast<double>(k) / rate;
    const auto time_us = static_cast<std::int64_t>(std::llround(1e6 * time_s));
    glm::dvec3 force = surface.press(time_us, arm.reading_mm());
    if (controller) force = controller->tick(time_us, arm.reading_mm(), force).force_n;
    arm.advance(force, e.intended ? e.intended(time_s + 1.0 / rate) : e.start_mm);
    balance.update();
    const Account now = balance.account();
    cycles.update(arm, surface, now, outcome);
    if (k == settled) then = now;
    if (k >= settled) positions.push_back(arm.position_mm().x);
    outcome.final_force_n = force.x;
  }
  const Account now = balance.account();
  outcome.swing_mm = swing_about_trend(positions);
  outcome.injected_mj = now.injected_mj;
  outcome.tolerance_mj = now.tolerance_mj + now.rounding_mj;
  outcome.settled_mw = (now.injected_mj - then.injected_mj) / e.settled_s;
  outcome.settled_tolerance_mw =
      (now.tolerance_mj - then.tolerance_mj + now.rounding_mj) / e.settled_s;
  if (controller) outcome.state = controller->state();
  return outcome;
}

namespace {

/// Whether a free swing in a linear wall grows: compares the largest |x| of a later interval with
/// an earlier one.
bool grows(const falcon::SampledLoop& loop, double stiffness) {
  SimulatedArm arm = SimulatedArm::build({loop, 0.0, 0.0}, {}, {1.0, 0.0, 0.0}).value();
  const double swing_s = 2.0 * std::numbers::pi * std::sqrt(loop.inertia_ns2_per_mm() / stiffness);
  // First some swings for the transient, then intervals of many swings.
  const auto interval_ticks =
      static_cast<int>(20.0 * std::max(swing_s, 4.0 / loop.rate_hz) * loop.rate_hz);
  double largest[4] = {};
  for (int part = 0; part < 4; ++part)
    for (int k = 0; k < interval_ticks; ++k) {
      arm.advance({-stiffness * arm.reading_mm().x, 0.0, 0.0});
      largest[part] = std::max(largest[part], std::abs(arm.position_mm().x));
    }
  return largest[3] > largest[1];
}

}  // namespace

double measured_stable_stiffness(const falcon::SampledLoop& loop, double tolerance) {
  // Starts at a stiffness whose swing takes at least a thousand periods; all these arms are stable
  // there.
  double low = 2e-5 * loop.inertia_ns2_per_mm() * loop.rate_hz * loop.rate_hz, high = low;
  while (!grows(loop, high)) high *= 2.0;
  low = 0.5 * high;
  while (high - low > tolerance * high) {
    const double middle = 0.5 * (low + high);
    (grows(loop, middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

double measured_passive_damping(const falcon::SampledLoop& loop, const falcon::VirtualWall& wall,
                                int waves, int samples) {
  SimulatedArm arm = SimulatedArm::build({loop, 0.0, 0.0}).value();
  const double angle = 2.0 * std::numbers::pi * waves / samples;
  const auto position_at = [&](int k) { return std::sin(angle * k + 0.3); };
  double before = position_at(-2), squared_steps = 0.0;
  const auto tick = [&](int k) {
    const double x = arm.reading_mm().x;
    const double speed = (x - before) * loop.rate_hz;
    before = x;
    squared_steps += (position_at(k) - x) * (position_at(k) - x);
    arm.carry({-wall.stiffness_n_per_mm * x - wall.damping_ns_per_mm * speed, 0.0, 0.0},
              {position_at(k), 0.0, 0.0});
  };
  // Fills the delay line with forces of the motion.
  for (int k = 0; k < samples; ++k) tick(k);
  const ArmEnergy initial = arm.energy();
  squared_steps = 0.0;
  for (int k = samples; k < 2 * samples; ++k) tick(k);
  return (arm.energy().displayed - initial.displayed) / (squared_steps * loop.rate_hz);
}

Experiment wall_experiment(const falcon::SampledLoop& loop, double stiffness_n_per_mm,
                           double step_mm) {
  Experiment e;
  e.arm = {loop, 0.0, step_mm};
  e.hand.push_n = {-0.5, 0.0, 0.0};
  e.start_mm = {1.0, 0.0, 0.0};
  // The damping left by the wall sets the decay time of a swing: at most half of it under the
  // controller; infinite at the border.
  const double left = std::abs(1.0 - stiffness_n_per_mm / falcon::stable_stiffness(loop));
  const double decay_s =
      2.0 * loop.inertia_ns2_per_mm() / loop.damping_ns_per_mm / std::clamp(left, 0.02, 0.25);
  e.seconds = 1.0 + 8.0 * decay_s;
  return e;
}

Experiment energy_experiment(const falcon::SampledLoop& loop, double stiffness_n_per_mm) {
  Experiment e;
  e.arm.loop = loop;
  e.hand.push_n = {-0.5, 0.0, 0.0};
  e.start_mm = {-1.1 * 0.5 / stiffness_n_per_mm, 0.0, 0.0};
  const double swing_s =
      2.0 * std::numbers::pi * std::sqrt(loop.inertia_ns2_per_mm() / stiffness_n_per_mm);
  e.seconds = 20.0 * std::max(swing_s, 8.0 / loop.rate_hz);
  e.settled_s = 0.5 * e.seconds;
  return e;
}

Experiment clay_experiment(const falcon::SampledLoop& loop, double step_mm) {
  Experiment e;
  e.arm = {loop, 0.0, step_mm};
  e.hand.stiffness_n_per_mm = {0.2, 0.0, 0.0};
  e.start_mm = {1.0, 0.0, 0.0};
  e.seconds = 5.0;
  e.settled_s = 2.0;
  e.intended = [](double time_s) { return glm::dvec3(1.0 - 3.0 * time_s, 0.0, 0.0); };
  return e;
}

}  // namespace clay::closed_loop
