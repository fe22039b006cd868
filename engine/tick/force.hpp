#pragma once
#include "claystack/engine/plan.hpp"
#include "engine/tick/contact.hpp"

#include <glm/vec3.hpp>

namespace clay {

/// Section 6.1, the force on the hand [N]. `conserving`: minus the gradient of the overlap energy
/// E = sum K' h (depth cos theta)^2 / 2, tan theta = f', with the depth left after yielding; at the
/// tool's end with the part of a ring that it covers, and behind the leading end with the pieces of
/// `Contact::front`. `paper`: K sum of depth times the unit normal n_i. In both the radial part
/// pushes the hand out of the clay; the paper's formulae, as printed, pull it in.
template <Model model>
glm::dvec3 spring_force(const ForcePlan& plan, const Contact& contact) noexcept;

/// Section 6.2: mu |F_d| along the tangent in the direction of the wheel's turn; zero on the axis.
glm::dvec3 friction_force(const ForcePlan& plan, const Contact& contact,
                          const glm::dvec3& spring) noexcept;

/// Scales both parts of a force alike, so that their sum is at most `limit_n`; both are zero where
/// the sum is not finite.
void limit_sum(glm::dvec3& spring, glm::dvec3& friction, double limit_n) noexcept;

}  // namespace clay
