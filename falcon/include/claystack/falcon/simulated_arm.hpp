#pragma once
// An arm that isn't there: a mass on three independent axes, with damping, friction, encoders that
// step, a force that comes late and is held for a period, and a hand. For tests and demos. Between
// two readings it moves by formula, so it is right at every rate.
//
//   m x'' = F_held - b x' - f sign(x') + hand,     hand = push + k_h (s - x) + b_h (s' - x')
//
// SI units throughout: m, s, kg, N, J.

#include "claystack/falcon/sampled_bound.hpp"

#include <glm/vec3.hpp>
#include <memory>
#include <tl/expected.hpp>

namespace clay::falcon {

struct ArmSpec {
  SampledLoop loop;         ///< rate, m, b and delay
  double friction_n = 0.0;  ///< f, Coulomb: of each axis
  double step_m = 0.0;      ///< of the encoders: readings are whole multiples; 0: they don't step
};

/// A hand pulls towards a point s that it means to be at, and pushes.
struct HandSpec {
  glm::dvec3 push_n{0.0};
  glm::dvec3 stiffness_n_per_m{0.0};  ///< k_h, of each axis
  glm::dvec3 damping_ns_per_m{0.0};   ///< b_h
};

/// Work since the start, summed over the axes [J]. It balances: the kinetic energy gained is
/// displayed + hand - damped - rubbed.
struct ArmEnergy {
  double displayed = 0.0;  ///< done on the arm by the force as it was held
  double hand = 0.0;       ///< done on the arm by the hand
  double damped = 0.0;     ///< lost in b: the integral of b v^2
  double rubbed = 0.0;     ///< lost in friction
};

class SimulatedArm {
 public:
  /// At rest at `start_m`. Refuses what `check` of the loop refuses, friction outside 0 to 100 N,
  /// steps outside 0 to 0.01 m, a hand stiffer than 1e6 N/m, damped more than 1e4 N s/m, pushing
  /// more than 100 N, or a start beyond 10 m.
  static tl::expected<SimulatedArm, OutOfRange> build(const ArmSpec& arm, const HandSpec& hand = {},
                                                      const glm::dvec3& start_m = {}) noexcept;

  /// What the encoders say now [m].
  [[nodiscard]] glm::dvec3 reading_m() const noexcept;

  /// Takes the force [N] that answers this reading, and lets one period pass. The hand's point goes
  /// to `intended_m` at constant speed meanwhile. A force that is not finite is taken as none.
  void advance(const glm::dvec3& force_n, const glm::dvec3& intended_m) noexcept;
  /// The same with the hand's point where it is.
  void advance(const glm::dvec3& force_n) noexcept { advance(force_n, intended_); }

  /// The same with a hand that can't be resisted: the arm goes to `position_m` at constant speed.
  void carry(const glm::dvec3& force_n, const glm::dvec3& position_m) noexcept;

  [[nodiscard]] const glm::dvec3& position_m() const noexcept { return position_; }
  [[nodiscard]] const glm::dvec3& velocity_m_s() const noexcept { return velocity_; }
  [[nodiscard]] double kinetic_energy_j() const noexcept;
  [[nodiscard]] const ArmEnergy& energy() const noexcept { return energy_; }
  [[nodiscard]] const ArmSpec& spec() const noexcept { return spec_; }

 private:
  struct Coefficients;
  static constexpr int kMostDelay = 8;

  SimulatedArm(const ArmSpec& arm, const HandSpec& hand, const glm::dvec3& start_m) noexcept;
  [[nodiscard]] glm::dvec3 late(const glm::dvec3& force_n) noexcept;

  ArmSpec spec_;
  HandSpec hand_;
  std::shared_ptr<const Coefficients> tick_;  // of a whole period, for each axis
  glm::dvec3 position_{0.0}, velocity_{0.0}, intended_{0.0};
  glm::dvec3 on_the_way_[kMostDelay]{};  // forces sent and not yet held, a ring
  int next_ = 0;
  ArmEnergy energy_;
};

}  // namespace clay::falcon
