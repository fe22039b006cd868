#include "app/servo/hand_force.hpp"

#include <glm/geometric.hpp>

namespace clay::servo {
namespace {

constexpr double kMPerMm = 1e-3;

}  // namespace

HandForce::Wanted HandForce::answer(std::int64_t now_us, const glm::dvec3& device_mm,
                                    const Mapping& mapping, const StepReport& clay) noexcept {
  const falcon::PassiveForce passive =
      controller_.tick(now_us, kMPerMm * device_mm, mapping.force_to_device(clay.spring_n));
  spring_n_ = whole_n_ = {};
  if (passive.state == falcon::PassivityState::safe) return {{}, false};
  spring_n_ = passive.force_n;
  whole_n_ = spring_n_ + mapping.force_to_device(clay.friction_n);
  return {whole_n_, true};
}

void HandForce::displayed(const glm::dvec3& sent_n) noexcept {
  const double whole = glm::length(whole_n_);
  controller_.displayed(whole > 0.0 ? glm::length(sent_n) / whole * spring_n_ : glm::dvec3(0.0));
}

}  // namespace clay::servo
