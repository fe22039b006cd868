#include "app/servo/hand_force.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace clay::servo {
namespace {

constexpr double kMPerMm = 1e-3;

}  // namespace

SplitForce split(const glm::dvec3& tool_mm, const glm::dvec3& force_n) noexcept {
  const double radius = std::sqrt(tool_mm.x * tool_mm.x + tool_mm.z * tool_mm.z);
  if (!(radius > 0.0)) return {force_n, {}};
  const glm::dvec3 along(tool_mm.z / radius, 0.0, -tool_mm.x / radius);
  const glm::dvec3 friction = glm::dot(force_n, along) * along;
  return {force_n - friction, friction};
}

HandForce::Wanted HandForce::answer(std::int64_t now_us, const glm::dvec3& device_mm,
                                    const Mapping& mapping, const glm::dvec3& tool_mm,
                                    const glm::dvec3& clay_n) noexcept {
  const SplitForce parts = split(tool_mm, clay_n);
  const falcon::PassiveForce passive =
      controller_.tick(now_us, kMPerMm * device_mm, mapping.force_to_device(parts.spring_n));
  spring_n_ = whole_n_ = {};
  if (passive.state == falcon::PassivityState::safe) return {{}, false};
  spring_n_ = passive.force_n;
  whole_n_ = spring_n_ + mapping.force_to_device(parts.friction_n);
  return {whole_n_, true};
}

void HandForce::displayed(const glm::dvec3& sent_n) noexcept {
  const double whole = glm::length(whole_n_);
  controller_.displayed(whole > 0.0 ? glm::length(sent_n) / whole * spring_n_ : glm::dvec3(0.0));
}

}  // namespace clay::servo
