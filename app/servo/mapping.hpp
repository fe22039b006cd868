#pragma once
// From the device's workspace to the wheel, and forces back.
//
//   p_clay = offset + scale D p_device,     F_device = force_gain D F_clay
//
// D turns axes over, so it is its own transpose. With force_gain = scale the hand does just the
// work that the tool does; with any other it does force_gain / scale of it, at every motion, so a
// contact that gives no energy to the tool gives none to the hand. The hand feels the contact's
// stiffness times force_gain scale: by default, force_gain = 1 / scale, the stiffness that the
// scene states.

#include "claystack/core/result.hpp"
#include "claystack/engine/wheel.hpp"
#include "claystack/falcon/passivity.hpp"
#include "claystack/servo/servo.hpp"

#include <cstdint>
#include <glm/vec3.hpp>

namespace clay::servo {

/// Refuses a value outside its range, and one that is not a number.
Result<void> check_range(const char* setting, double value, double low, double high);

class Mapping {
 public:
  /// Errors name the setting.
  static Result<Mapping> build(const MappingSettings& settings);

  [[nodiscard]] glm::dvec3 to_clay(const glm::dvec3& device_mm) const noexcept;
  /// Its inverse.
  [[nodiscard]] glm::dvec3 to_device(const glm::dvec3& clay_mm) const noexcept;
  [[nodiscard]] glm::dvec3 force_to_device(const glm::dvec3& clay_n) const noexcept;

  /// The clutch is let go with the hand here: from now on this is where the tool is.
  void recentre(const glm::dvec3& device_mm, const glm::dvec3& clay_mm) noexcept;

  /// Stiffness at the hand divided by stiffness at the tool.
  [[nodiscard]] double stiffness_gain() const noexcept { return force_gain_ * scale_; }

 private:
  double scale_ = 1.0, force_gain_ = 1.0;
  glm::dvec3 turned_{1.0};  // the diagonal of D
  glm::dvec3 offset_mm_{0.0};
};

/// From the force of the clay to the one that the hand may be asked to bear: mapped, and its spring
/// made passive. Without a motor none of it is done.
class HandForce {
 public:
  /// `spec` as PassivityController::build lets it through.
  explicit HandForce(const falcon::PassivityController& controller) noexcept
      : controller_(controller) {}

  struct Wanted {
    glm::dvec3 force_n{0.0};  ///< in the device's frame
    bool passive = true;
  };
  /// The answer to a fresh sample of the hand, with the clay's force on the tool. Friction drags
  /// the hand along the wheel's turn and works on it by right; only the spring is held to be
  /// passive.
  [[nodiscard]] Wanted answer(std::int64_t now_us, const glm::dvec3& device_mm,
                              const Mapping& mapping, const StepReport& clay) noexcept;

  /// What the guard let through of the last answer: energy is counted with this. Of the spring's
  /// part, which is let through as the whole is.
  void displayed(const glm::dvec3& sent_n) noexcept;

  /// After a pause: what was given before is no debt of what comes now.
  void reset() noexcept { controller_.reset(); }
  [[nodiscard]] falcon::PassivityState state() const noexcept { return controller_.state(); }

 private:
  falcon::PassivityController controller_;
  glm::dvec3 spring_n_{0.0}, whole_n_{0.0};  // the last answer, in the device's frame
};

}  // namespace clay::servo
