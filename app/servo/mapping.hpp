#pragma once
// From the device's workspace to the wheel, and forces back.
//
//   p_clay = offset + scale D p_device,     F_device = force_gain D F_clay
//
// D inverts axes, so it is its own transpose. With force_gain = scale the hand does the same
// work as the tool; otherwise force_gain / scale times that work, in every motion, so a
// contact that returns no energy to the tool returns none to the hand. The hand feels the contact's
// stiffness times force_gain scale: by default, force_gain = 1 / scale, the stiffness that the
// scene states.

#include "claystack/core/result.hpp"
#include "claystack/engine/wheel.hpp"
#include "claystack/falcon/passivity.hpp"
#include "claystack/servo/servo.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>

namespace clay::servo {

/// Refuses NaN and values outside their range.
Result<void> check_range(const char* setting, double value, double low, double high);

class Mapping {
 public:
  /// Errors name the setting.
  static Result<Mapping> build(const MappingSettings& settings);

  [[nodiscard]] glm::dvec3 to_clay(const glm::dvec3& device_mm) const noexcept;
  /// Its inverse.
  [[nodiscard]] glm::dvec3 to_device(const glm::dvec3& clay_mm) const noexcept;
  [[nodiscard]] glm::dvec3 force_to_device(const glm::dvec3& clay_n) const noexcept;

  /// Moves the offset so that the hand's current position maps to the current position of the tool.
  /// Called when the clutch is released.
  void recentre(const glm::dvec3& device_mm, const glm::dvec3& clay_mm) noexcept;

  /// Stiffness at the hand divided by stiffness at the tool.
  [[nodiscard]] double stiffness_gain() const noexcept { return force_gain_ * scale_; }

 private:
  double scale_ = 1.0, force_gain_ = 1.0;
  glm::dvec3 turned_{1.0};  // the diagonal of D
  glm::dvec3 offset_mm_{0.0};
};

/// Converts the clay's force to the force for the hand: mapped, with a passive spring. Without a
/// motor it does nothing.
class HandForce {
 public:
  /// `controller`: from PassivityController::build.
  explicit HandForce(falcon::PassivityController controller) noexcept
      : controller_(std::move(controller)) {}

  struct Wanted {
    glm::dvec3 force_n{0.0};  ///< in the device's frame
    bool passive = true;
    double contact_n = 0.0;  ///< of the clay's force, before it was made passive
  };
  /// The force for a fresh sample of the hand, given the clay's force on the tool. Friction may do
  /// work on the hand, because the wheel drags it along; only the spring is made passive.
  [[nodiscard]] Wanted answer(std::int64_t now_us, const glm::dvec3& device_mm,
                              const Mapping& mapping, const StepReport& clay) noexcept;

  /// Call with the part of the last answer that the guard sent; the energy balance uses it. The
  /// spring's part is reduced in the same ratio as the whole.
  void displayed(const glm::dvec3& sent_n) noexcept;

  /// After a pause: energy from before the pause does not count.
  void reset() noexcept { controller_.reset(); }
  [[nodiscard]] falcon::PassivityState state() const noexcept { return controller_.state(); }
  [[nodiscard]] std::optional<double> slow_rate_hz() const noexcept {
    return controller_.slow_rate_hz();
  }

 private:
  falcon::PassivityController controller_;
  glm::dvec3 spring_n_{0.0}, whole_n_{0.0};  // the last answer, in the device's frame
};

}  // namespace clay::servo
