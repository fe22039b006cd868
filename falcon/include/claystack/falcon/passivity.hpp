#pragma once
// Keeps a servo from feeding the hand energy: the passivity controller of Hannaford and Ryu (see
// energy_observer.hpp) adds damping that takes back what the observer saw given. Before it stands a
// bound, after J.-P. Kim, J. Ryu, "Robustly stable haptic interaction control using an
// energy-bounding algorithm", Int. J. Robotics Research 29(6), 2010: force has to be earned by the
// way into the contact, at accepted_stiffness at most. A contact as soft as that passes unchanged.
// Behind it, for what no damping saves (a force later than was said), the
// bound is halved, and then there is no force.
//
//   watching <-> damping     earned at accepted_stiffness; damping while there is a debt
//       +-----+-----+
//          yielding          earned at half of it, until reset
//             |
//            safe            no force, until reset
//
// It knows no clock: time comes with the readings. The turning wheel's friction drags the hand
// along and does work on it by right: pass the contact's spring force, and add friction after.

#include "claystack/falcon/energy_observer.hpp"
#include "claystack/falcon/sampled_bound.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <tl/expected.hpp>

namespace clay::falcon {

struct PassivitySpec {
  SampledLoop loop;     ///< mass: the least, damping: what the arm has for sure
  double step_m = 0.0;  ///< of the encoders
  double energy_limit_j = 5e-3;
  double energy_window_s = 0.1;     ///< no patience when more than the limit was given in this time
  int reversal_limit = 8;           ///< 2 to 16
  double reversal_window_s = 0.05;  ///< nor when the force swung so often in this time
  double reversal_force_n = 1.0;    ///< least swing that counts, from one turn to the next
};

/// Counts how often a force turns back, whatever its direction.
class SwingCounter {
 public:
  SwingCounter(int limit, double window_s, double least_n) noexcept;
  /// The force at a time [s] that rises; true when `limit` swings ended within the window.
  bool swings_too_often(double time_s, const glm::dvec3& force_n) noexcept;

 private:
  static constexpr std::size_t kMost = 16;
  std::size_t limit_, count_ = 0;
  double window_s_, least_n_;
  glm::dvec3 extreme_{0.0}, direction_{0.0};
  std::array<double, kMost> times_s_{};  // of the last swings, a ring
};

enum class PassivityState { watching, damping, yielding, safe };

struct PassiveForce {
  glm::dvec3 force_n{0.0};
  PassivityState state = PassivityState::watching;
};

class PassivityController {
 public:
  /// Refuses what `check` of the loop refuses; a step outside 0 to 0.01 m; limits that are not
  /// above 0, or windows above 10 s.
  static tl::expected<PassivityController, OutOfRange> build(const PassivitySpec& spec) noexcept;

  /// The force [N] to send for the one that the contact asks for at this reading. Zero, and the
  /// tick is not counted, when an argument is not finite or time does not advance.
  [[nodiscard]] PassiveForce tick(std::int64_t time_us, const glm::dvec3& reading_m,
                                  const glm::dvec3& force_n) noexcept;

  /// What is displayed [N] in place of the force that the last tick returned, where a guard behind
  /// it lets through less: the account is of this one. Not counted when it is not finite.
  void displayed(const glm::dvec3& force_n) noexcept;

  /// As new: the next reading is the first.
  void reset() noexcept { *this = PassivityController(spec_); }

  [[nodiscard]] const EnergyObserver& observer() const noexcept { return observer_; }
  [[nodiscard]] PassivityState state() const noexcept { return state_; }
  /// Most damping that the controller adds [N s/m]: half of what the loop bears on top of the
  /// accepted stiffness, and so little that one encoder step in a period moves the force by a
  /// quarter of `reversal_force_n` at most.
  [[nodiscard]] double most_damping_ns_per_m() const noexcept { return most_damping_; }

 private:
  static constexpr std::size_t kMostSent = 9;

  explicit PassivityController(const PassivitySpec& spec) noexcept;
  void judge(bool contact_ended, const glm::dvec3& asked_n) noexcept;
  void count_debt() noexcept;
  void escalate() noexcept;
  [[nodiscard]] glm::dvec3 answer(double dt_s, const glm::dvec3& way_m,
                                  const glm::dvec3& asked_n) noexcept;
  [[nodiscard]] glm::dvec3 earned(const glm::dvec3& way_m, const glm::dvec3& asked_n) noexcept;
  [[nodiscard]] glm::dvec3 damping(double dt_s, const glm::dvec3& way_m) const noexcept;
  void send(const glm::dvec3& force_n) noexcept;

  PassivitySpec spec_;
  double stiffness_, most_damping_;
  EnergyObserver observer_;
  SwingCounter swings_;
  PassivityState state_ = PassivityState::watching;
  double earned_n_ = 0.0;      // most force that the way into the contact allows
  double last_asked_n_ = 0.0;  // in this contact
  int debts_ = 0;              // since the last good while
  double last_debt_s_ = 0.0;

  struct Reading {
    std::int64_t time_us;
    glm::dvec3 at_m;
  };
  std::optional<Reading> last_;
  double now_s_ = 0.0;                        // since the first reading
  std::array<glm::dvec3, kMostSent> sent_{};  // a ring of delay + 1: the oldest is held now
  std::size_t oldest_ = 0, newest_ = 0;
  glm::dvec3 last_sent_{0.0};
};

}  // namespace clay::falcon
