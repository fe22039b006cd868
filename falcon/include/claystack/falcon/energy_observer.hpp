#pragma once
// The passivity observer: what the servo has given the hand beyond what it took. After B.
// Hannaford, J.-H. Ryu, "Time-domain passivity control of haptic interfaces", IEEE Trans. Robotics
// and Automation 18(1), 2002. Work is counted by positions: the force held over a period times the
// way gone in it is exact, but for the encoder's steps. A spring that an encoder reads seems to
// give K step^2 whenever a still hand makes it flicker, so that loops of up to two steps count
// nothing.

#include "claystack/falcon/sampled_bound.hpp"

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

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
  /// What `injected_j` may be off by for the encoder's steps: half a step times all that the force
  /// changed by, up and down, in one contact.
  [[nodiscard]] double tolerance_j() const noexcept { return step_m_ * peak_n_ + kRounding; }
  /// Of the contact that has just ended: what it added to the debt.
  [[nodiscard]] double last_contact_j() const noexcept { return last_contact_; }
  /// Added by the contacts of the last while, the present one included.
  [[nodiscard]] double recent_j() const noexcept;
  [[nodiscard]] bool in_contact() const noexcept { return in_contact_; }

  /// The debt is forgiven; what is going on goes on.
  void forgive() noexcept;

 private:
  static constexpr std::size_t kBuckets = 16;
  static constexpr double kRounding = 1e-9;

  /// A way in one direction, into the contact or out of it.
  struct Stroke {
    double sign = 0.0;        // of the way: +1 into the contact, -1 out of it
    double depth_m = 0.0;     // where the arm is, and the furthest it was in this stroke,
    double furthest_m = 0.0;  // from where the stroke began
    double doubtful_j = 0.0;  // work since it was there
    double time_s = 0.0;
    double credit_j = 0.0;  // dissipated for sure by the arm
  };

  void follow_stroke(double dt_s, double held_n, double inward_m) noexcept;
  void credit_stroke() noexcept;
  void end_contact() noexcept;
  void pass_time(double dt_s) noexcept;

  double damping_, step_m_, bucket_s_;
  int drain_ticks_;
  double injected_ = 0.0, before_contact_ = 0.0, last_contact_ = 0.0, peak_n_ = 0.0;
  bool in_contact_ = false;
  int quiet_ticks_ = 0;  // since the contact last asked for a force
  Stroke stroke_;
  std::array<double, kBuckets> buckets_{};  // a ring of equal parts of the window
  std::size_t bucket_ = 0;
  double in_bucket_s_ = 0.0;
};

}  // namespace clay::falcon
