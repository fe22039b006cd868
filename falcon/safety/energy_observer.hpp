#pragma once
// The passivity observer: the net energy that the servo has given to the hand. After B.
// Hannaford, J.-H. Ryu, "Time-domain passivity control of haptic interfaces", IEEE Trans. Robotics
// and Automation 18(1), 2002. Work is the force held over a period
// times the displacement, which is exact except for encoder steps. A spring read by an encoder
// seems to release K step^2 whenever the reading of a resting hand flickers, so loops of up to
// four steps do not count.

#include "claystack/falcon/passivity.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

namespace clay::falcon::inline safety {

/// Energy of each contact, and of a recent window of time.
class EnergyObserver {
 public:
  /// `loop` must pass `check`; its damping is the guaranteed minimum of the arm. `step_mm`: of the
  /// encoders. `window_s` > 0: the window of recent_mj().
  EnergyObserver(const SampledLoop& loop, double step_mm, double window_s) noexcept;

  /// A period of `dt_s` in which `held_n` was displayed and the reading moved by `way_mm`; at its
  /// end the contact requests `asked_n`. True if a contact has ended with it.
  bool observe(double dt_s, const glm::dvec3& held_n, const glm::dvec3& way_mm,
               const glm::dvec3& asked_n) noexcept;

  /// Work displayed [mJ] minus the guaranteed dissipation by the arm's damping in contact. Negative
  /// while a contact has credit. Credit ends with its contact; a debt remains.
  [[nodiscard]] double injected_mj() const noexcept { return injected_; }
  /// The larger of injected_mj() and the same for oscillations within a contact, which a long press
  /// would hide by its credit: the sum over the loops from one deepest point to the next, closed by
  /// any spring whose force grows with depth. It never falls below zero.
  [[nodiscard]] double debt_mj() const noexcept { return std::max(injected_, looped_); }
  /// Error bound of these values due to encoder steps: half a step times the total variation of the
  /// force in this contact or the last.
  [[nodiscard]] double tolerance_mj() const noexcept {
    return step_mm_ * std::max(peak_n_, last_peak_n_) + kRounding;
  }
  /// Energy that the last contact added to the debt.
  [[nodiscard]] double last_contact_mj() const noexcept { return last_contact_; }
  /// Energy given within the window: by contacts that ended with a gain, and by the current one if
  /// positive.
  [[nodiscard]] double recent_mj() const noexcept;
  [[nodiscard]] bool in_contact() const noexcept { return in_contact_; }

  /// Clears the debt; the current contact continues.
  void forgive() noexcept;

 private:
  static constexpr std::size_t kBuckets = 16;
  static constexpr double kRounding = 1e-6;  // mJ

  /// A motion in one direction, into the contact or out of it. Depths count from its start.
  struct Stroke {
    double sign = 0.0;  // +1 into the contact, -1 out of it
    double from_mm = 0.0;
    double depth_mm = 0.0;     // of the arm now
    double furthest_mm = 0.0;  // maximum
    double force_n = 0.0;      // at the maximum
    double doubtful_mj = 0.0;  // work and time since the maximum
    double doubtful_s = 0.0;
    double time_s = 0.0;
    double credit_mj = 0.0;  // guaranteed dissipation by the arm
  };
  /// A deepest point of the contact, where the arm turned back.
  struct Turn {
    double injected_mj, depth_mm, force_n;
  };

  void begin_contact(double dt_s, const glm::dvec3& way_mm) noexcept;
  void follow_stroke(double dt_s, double held_n, double inward_mm) noexcept;
  void credit_stroke() noexcept;
  void close_loop() noexcept;
  void end_contact() noexcept;
  [[nodiscard]] double given() const noexcept;
  void pass_time(double dt_s) noexcept;

  double damping_, step_mm_, mark_s_;
  int drain_ticks_;
  double injected_ = 0.0, before_contact_ = 0.0, last_contact_ = 0.0;
  double peak_n_ = 0.0, last_peak_n_ = 0.0;
  double gains_ = 0.0;  // of all contacts that ended
  bool in_contact_ = false;
  int quiet_ticks_ = 0;  // since the contact last requested a force
  Stroke stroke_;
  std::optional<Turn> last_turn_;
  double looped_ = 0.0;
  std::array<double, kBuckets> given_before_{};  // given() at equal parts of the window, a ring
  std::size_t oldest_ = 0;
  double since_mark_s_ = 0.0;
};

}  // namespace clay::falcon::inline safety
