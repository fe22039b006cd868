#pragma once
// The control law of PassivityController.

#include "claystack/falcon/passivity.hpp"
#include "falcon/safety/energy_observer.hpp"
#include "falcon/safety/reading_period.hpp"
#include "falcon/safety/swing_counter.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <tl/expected.hpp>

namespace clay::falcon::inline safety {

[[nodiscard]] tl::expected<void, OutOfRange> check(const PassivitySettings& settings) noexcept;

class PassivityLaw {
 public:
  /// `settings` must pass `check`.
  explicit PassivityLaw(const PassivitySettings& settings) noexcept;

  // As PassivityController.
  [[nodiscard]] PassiveForce tick(std::int64_t time_us, const glm::dvec3& reading_mm,
                                  const glm::dvec3& force_n) noexcept;
  void displayed(const glm::dvec3& force_n) noexcept;
  void reset() noexcept { *this = PassivityLaw(settings_); }

  [[nodiscard]] const EnergyObserver& observer() const noexcept { return observer_; }
  [[nodiscard]] PassivityState state() const noexcept { return state_; }
  [[nodiscard]] std::optional<double> slow_rate_hz() const noexcept;
  /// Maximum damping that the controller adds [N s/mm]: half of the stable maximum on top of the
  /// accepted stiffness, and small enough that one encoder step per period changes the force by at
  /// most a quarter of `reversal_force_n`.
  [[nodiscard]] double most_damping_ns_per_mm() const noexcept { return most_damping_; }

 private:
  void set_period(double period_s) noexcept;
  void judge(bool contact_ended, const glm::dvec3& asked_n) noexcept;
  void count_debt() noexcept;
  void escalate() noexcept;
  [[nodiscard]] glm::dvec3 answer(double dt_s, const glm::dvec3& way_mm,
                                  const glm::dvec3& asked_n) noexcept;
  [[nodiscard]] glm::dvec3 earned(const glm::dvec3& way_mm, const glm::dvec3& asked_n) noexcept;
  [[nodiscard]] glm::dvec3 damping(double dt_s, const glm::dvec3& way_mm) const noexcept;
  void send(const glm::dvec3& force_n) noexcept;

  PassivitySettings settings_;
  ReadingPeriod period_;
  double stiffness_, most_damping_;  // at this period
  EnergyObserver observer_;
  SwingCounter swings_;
  PassivityState state_ = PassivityState::watching;
  double earned_n_ = 0.0;          // maximum force permitted by the motion into the contact
  double last_requested_n_ = 0.0;  // in this contact
  int debts_ = 0;                  // since the last quiet interval
  double last_debt_s_ = 0.0;

  struct Reading {
    std::int64_t time_us;
    glm::dvec3 at_mm;
  };
  std::optional<Reading> last_;
  double now_s_ = 0.0;  // since the first reading
  // A ring of delay + 1: the oldest is held now.
  std::array<glm::dvec3, kMostDelayTicks + 1> sent_{};
  std::size_t oldest_ = 0, newest_ = 0;
  glm::dvec3 last_sent_{0.0};
};

}  // namespace clay::falcon::inline safety
