#pragma once
#include "claystack/engine/clay_stack.hpp"
#include "claystack/engine/pot.hpp"
#include "stability.hpp"

#include <glm/vec3.hpp>

namespace clay {

/// Section 7: what stands above the failing ring turns as a rigid body about the HIP, toward the
/// side where its weight hangs, until its lowest point rests on the wheel or its centre of mass
/// can fall no further. O(N), once in the life of a pot; uses libm.
Collapse settle(const ClayStack& stack, const Failure& failure, const glm::dvec3& hip_mm) noexcept;

}  // namespace clay
