#include "engine/tick/force.hpp"

#include "core/limit_norm.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace clay {

template <Model model>
glm::dvec3 spring_force(const ForcePlan& plan, const Contact& contact) noexcept {
  double radial = 0.0, vertical = 0.0;
  const auto add = [&](double depth, double coverage, double normal2, double lean, double turn) {
    const double covered = depth * coverage;
    radial += covered * normal2;
    vertical += covered * (lean + 0.5 * depth * turn);
  };
  const auto add_part = [&](const RingContact& part) {
    const Facing& facing = part.facing;
    add(part.depth_mm, part.coverage, facing.normal2, facing.lean, facing.turn);
  };
  contact.rings.each_slice([&](const auto& slice) {
    const auto& rows = slice.rows;
    for (std::size_t k = slice.begin; k < slice.end; ++k) {
      if constexpr (model == Model::paper) {
        // The unit normal is (sin theta, cos theta) with theta = phi + 90 deg, tan phi = f'.
        const double slope = rows.slope[k], depth = rows.depth[k] / std::sqrt(1.0 + slope * slope);
        radial += depth;
        vertical += depth * slope;
      } else {
        add(rows.depth[k], rows.coverage[k], rows.normal2[k], rows.lean[k], rows.turn[k]);
      }
    }
  });
  for (std::size_t k = 0; k < contact.edge_count; ++k) add_part(contact.edges[k]);
  if (contact.has_front)
    for (const RingContact& piece : contact.front) add_part(piece);
  if constexpr (model == Model::conserving)
    vertical += 0.5 * plan.per_ring_mm * (contact.end_depth2[0] - contact.end_depth2[1]);
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

void limit_sum(glm::dvec3& spring, glm::dvec3& friction, double limit_n) noexcept {
  const glm::dvec3 sum = spring + friction, kept = limit_norm(sum, limit_n);
  if (kept == sum) return;
  const double part = is_finite(sum) ? norm(kept) / norm(sum) : 0.0;
  spring = part > 0.0 ? part * spring : glm::dvec3(0.0);
  friction = part > 0.0 ? part * friction : glm::dvec3(0.0);
}

template glm::dvec3 spring_force<Model::paper>(const ForcePlan&, const Contact&) noexcept;
template glm::dvec3 spring_force<Model::conserving>(const ForcePlan&, const Contact&) noexcept;

}  // namespace clay
