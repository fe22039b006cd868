#include "claystack/falcon/sim.hpp"

#include "core/limit_norm.hpp"
#include "falcon/sim/arm_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

namespace clay::falcon::inline sim {

struct SimulatedArm::Coefficients {
  std::array<ArmAxis, 3> axes;
};

namespace {

constexpr double kFarthestMm = 10'000.0;

/// The first component out of range, by the name of the setting. Not (x < low): NaN must fail.
std::optional<OutOfRange> outside(const char* setting, double low, double high,
                                  const glm::dvec3& found) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(found[axis] >= low && found[axis] <= high))
      return OutOfRange{setting, low, high, found[axis]};
  return std::nullopt;
}

}  // namespace

tl::expected<SimulatedArm, OutOfRange> SimulatedArm::build(const ArmSettings& arm,
                                                           const HandSettings& hand,
                                                           const glm::dvec3& start_mm) noexcept {
  if (auto checked = check(arm.loop); !checked) return tl::make_unexpected(checked.error());
  const std::optional<OutOfRange> faults[] = {
      outside("friction_n", 0.0, 100.0, glm::dvec3(arm.friction_n)),
      outside("step_mm", 0.0, 10.0, glm::dvec3(arm.step_mm)),
      outside("push_n", -100.0, 100.0, hand.push_n),
      outside("stiffness_n_per_mm", 0.0, 1e3, hand.stiffness_n_per_mm),
      outside("damping_ns_per_mm", 0.0, 10.0, hand.damping_ns_per_mm),
      outside("start_mm", -kFarthestMm, kFarthestMm, start_mm),
  };
  for (const auto& fault : faults)
    if (fault) return tl::make_unexpected(*fault);
  return SimulatedArm(arm, hand, start_mm);
}

SimulatedArm::SimulatedArm(const ArmSettings& arm, const HandSettings& hand,
                           const glm::dvec3& start_mm) noexcept
    : settings_(arm), hand_(hand), position_(start_mm), intended_(start_mm) {
  Coefficients tick;
  for (int axis = 0; axis < 3; ++axis) {
    ArmAxis& a = tick.axes[static_cast<std::size_t>(axis)];
    a.inertia_ns2_per_mm = arm.loop.inertia_ns2_per_mm();
    a.damping_ns_per_mm = arm.loop.damping_ns_per_mm;
    a.friction_n = arm.friction_n;
    a.hand_stiffness_n_per_mm = hand.stiffness_n_per_mm[axis];
    a.hand_damping_ns_per_mm = hand.damping_ns_per_mm[axis];
    a.period_s = arm.loop.period_s();
    a.response = a.response_over(a.period_s);
  }
  tick_ = std::make_shared<const Coefficients>(tick);
}

glm::dvec3 SimulatedArm::reading_mm() const noexcept {
  return settings_.step_mm > 0.0 ? glm::round(position_ / settings_.step_mm) * settings_.step_mm
                                 : position_;
}

glm::dvec3 SimulatedArm::late(const glm::dvec3& force_n) noexcept {
  const glm::dvec3 sent = is_finite(force_n) ? force_n : glm::dvec3(0.0);
  if (settings_.loop.delay_ticks == 0) return sent;
  const glm::dvec3 held = std::exchange(on_the_way_[next_], sent);
  next_ = (next_ + 1) % settings_.loop.delay_ticks;
  return held;
}

void SimulatedArm::advance(const glm::dvec3& force_n, const glm::dvec3& intended_mm) noexcept {
  const glm::dvec3 held = late(force_n), from = position_;
  const glm::dvec3 speed = (intended_mm - intended_) * settings_.loop.rate_hz;
  const double kinetic = kinetic_energy_mj();
  double damped = 0.0, rubbed = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    AxisState state{position_[axis], velocity_[axis], intended_[axis], 0.0, 0.0};
    move(tick_->axes[static_cast<std::size_t>(axis)], held[axis] + hand_.push_n[axis], speed[axis],
         state);
    position_[axis] = state.position_mm;
    velocity_[axis] = state.velocity_mm_s;
    damped += state.damped_mj;
    rubbed += state.rubbed_mj;
  }
  intended_ = intended_mm;
  const double displayed = glm::dot(held, position_ - from);
  energy_.displayed += displayed;
  energy_.damped += damped;
  energy_.rubbed += rubbed;
  energy_.hand += kinetic_energy_mj() - kinetic - displayed + damped + rubbed;
}

void SimulatedArm::carry(const glm::dvec3& force_n, const glm::dvec3& position_mm) noexcept {
  const glm::dvec3 held = late(force_n), way = position_mm - position_;
  const double kinetic = kinetic_energy_mj();
  velocity_ = way * settings_.loop.rate_hz;
  position_ = intended_ = position_mm;
  const double displayed = glm::dot(held, way);
  const double damped = settings_.loop.damping_ns_per_mm * glm::dot(velocity_, way);
  const double rubbed =
      settings_.friction_n * (std::abs(way.x) + std::abs(way.y) + std::abs(way.z));
  energy_.displayed += displayed;
  energy_.damped += damped;
  energy_.rubbed += rubbed;
  energy_.hand += kinetic_energy_mj() - kinetic - displayed + damped + rubbed;
}

double SimulatedArm::kinetic_energy_mj() const noexcept {
  return 0.5 * settings_.loop.inertia_ns2_per_mm() * glm::dot(velocity_, velocity_);
}

}  // namespace clay::falcon::inline sim
