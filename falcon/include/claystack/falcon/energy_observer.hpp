#pragma once
// The passivity observer: what the servo has given the hand beyond what it took. After B.
// Hannaford, J.-H. Ryu, "Time-domain passivity control of haptic interfaces", IEEE Trans. Robotics
// and Automation 18(1), 2002. Work is counted by positions: the force held over a period times the
// way gone in it is exact, but for the encoder's steps. A spring that an encoder reads seems to
// give K step^2 whenever a still hand makes it flicker, so that loops of up to two steps count
// nothing.

#include "claystack/falcon/sampled_bound.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

namespace clay::falcon {

/// Energy of one contact after the other, and of the last while.
class EnergyObserver {
 public:
  /// `loop` as `check` lets it through; its damping is what the arm has for sure. `step_m`: of the
  /// encoders. `window_s` > 0: the last while.
  EnergyObserver(const SampledLoop& loop, double step_m, double window_s) noexcept;

  /// A period of `dt_s` in which `held_n` was displayed and the reading moved by `way_m`; at its
  /// end the contact asks for `asked_n`. True when a contact has ended with it.
  bool observe(double dt_s, const glm::dvec3& held_n, const glm::dvec3& way_m,
               const glm::dvec3& asked_n) noexcept;

  /// Work displayed [J] less what the arm's own damping has dissipated for sure in contact.
  /// Negative while a contact has credit. Credit ends with its contact, a debt stays.
  [[nodiscard]] double injected_j() const noexcept { return injected_; }
  /// The same for oscillations within a contact, which may have the credit of a long press: the
  /// sum over the loops from one deepest point to the next, closed by any spring whose force grows
  /// with depth; from zero again when it would fall below.
  [[nodiscard]] double looped_j() const noexcept { return looped_; }
  [[nodiscard]] double debt_j() const noexcept { return std::max(injected_, looped_); }
  /// What these may be off by for the encoder's steps: half a step times all that the force
  /// changed by, up and down, in this contact or the last.
  [[nodiscard]] double tolerance_j() const noexcept {
    return step_m_ * std::max(peak_n_, last_peak_n_) + kRounding;
  }
  /// Of the contact that has just ended: what it added to the debt.
  [[nodiscard]] double last_contact_j() const noexcept { return last_contact_; }
  /// Given in the last while: by contacts that ended with a gain, and by the present one as far as
  /// it is above zero.
  [[nodiscard]] double recent_j() const noexcept;
  [[nodiscard]] bool in_contact() const noexcept { return in_contact_; }

  /// The debt is forgiven; what is going on goes on.
  void forgive() noexcept;

 private:
  static constexpr std::size_t kBuckets = 16;
  static constexpr double kRounding = 1e-9;

  /// A way in one direction, into the contact or out of it. Depths count from where it began.
  struct Stroke {
    double sign = 0.0;  // +1 into the contact, -1 out of it
    double from_m = 0.0;
    double depth_m = 0.0;     // where the arm is,
    double furthest_m = 0.0;  // the furthest it was,
    double force_n = 0.0;     // the force there
    double doubtful_j = 0.0;  // and the work and time since
    double doubtful_s = 0.0;
    double time_s = 0.0;
    double credit_j = 0.0;  // dissipated for sure by the arm
  };
  /// A deepest point of the contact, where the arm turned back.
  struct Turn {
    double injected_j, depth_m, force_n;
  };

  void begin_contact(double dt_s, const glm::dvec3& way_m) noexcept;
  void follow_stroke(double dt_s, double held_n, double inward_m) noexcept;
  void credit_stroke() noexcept;
  void close_loop() noexcept;
  void end_contact() noexcept;
  [[nodiscard]] double given() const noexcept;
  void pass_time(double dt_s) noexcept;

  double damping_, step_m_, mark_s_;
  int drain_ticks_;
  double injected_ = 0.0, before_contact_ = 0.0, last_contact_ = 0.0;
  double peak_n_ = 0.0, last_peak_n_ = 0.0;
  double gains_ = 0.0;  // of all contacts that ended
  bool in_contact_ = false;
  int quiet_ticks_ = 0;  // since the contact last asked for a force
  Stroke stroke_;
  std::optional<Turn> last_turn_;
  double looped_ = 0.0;
  std::array<double, kBuckets> given_before_{};  // given() at equal parts of the window, a ring
  std::size_t oldest_ = 0;
  double since_mark_s_ = 0.0;
};

}  // namespace clay::falcon
