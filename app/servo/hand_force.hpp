#pragma once
// From the force of the clay to the one that the hand may be asked to bear: split, mapped, made
// passive. Without a motor none of it is done.

#include "app/servo/mapping.hpp"
#include "claystack/engine/wheel.hpp"
#include "claystack/falcon/passivity.hpp"

#include <cstdint>
#include <glm/vec3.hpp>

namespace clay::servo {

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
