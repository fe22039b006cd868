#include "force.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace clay {

template <Model model>
glm::dvec3 spring_force(const ForcePlan& plan, const Contact& contact) noexcept {
  double radial = 0.0, vertical = 0.0;
  const auto add = [&](const RingContact& touch) {
    if constexpr (model == Model::paper) {
      // The unit normal is (sin theta, cos theta) with theta = phi + 90 deg, tan phi = f'.
      const double depth = touch.depth_mm / std::sqrt(1.0 + touch.slope * touch.slope);
      radial += depth;
      vertical += depth * touch.slope;
    } else {
      const double depth = touch.depth_mm * touch.coverage;
      radial += depth * touch.facing.normal2;
      vertical += depth * (touch.facing.lean + 0.5 * touch.depth_mm * touch.facing.turn);
    }
  };
  for (const RingContact& touch : contact.rings) add(touch);
  for (std::size_t k = 0; k < contact.edge_count; ++k) add(contact.edges[k]);
  if (contact.has_front)
    for (const RingContact& piece : contact.front) add(piece);
  const double out = contact.side == Side::compressive ? radial : -radial;
  return plan.stiffness_n_per_mm *
         glm::dvec3(out * contact.radial_x, vertical, out * contact.radial_z);
}

glm::dvec3 friction_force(const ForcePlan& plan, const Contact& contact,
                          const glm::dvec3& spring) noexcept {
  // y cross radial: counterclockwise seen from above.
  const glm::dvec3 tangent(contact.radial_z, 0.0, -contact.radial_x);
  return plan.turn * plan.friction * glm::length(spring) * tangent;
}

glm::dvec3 limited(const glm::dvec3& force, double limit_n) noexcept {
  const double norm = glm::length(force);
  if (norm <= limit_n) return force;
  if (!std::isfinite(norm)) return glm::dvec3(0.0);
  // A few ulp of slack, so that the rounded norm does not pass the limit.
  return force * (limit_n / norm * (1.0 - 0x1p-50));
}

template glm::dvec3 spring_force<Model::paper>(const ForcePlan&, const Contact&) noexcept;
template glm::dvec3 spring_force<Model::conserving>(const ForcePlan&, const Contact&) noexcept;

}  // namespace clay
