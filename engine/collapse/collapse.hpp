#pragma once
#include "claystack/engine/clay.hpp"
#include "engine/tick/stability.hpp"

#include <glm/vec3.hpp>

namespace clay {

/// Section 7: the part above the failing ring falls as a rigid body. First the hand holds it: it
/// rotates about the HIP, to the side where its weight hangs, as long as the moment of the weight
/// exceeds that of the clay it presses into. Then the hand lets go, and the part moves by the
/// motion that gains most power, until no motion gains any. O(N) plus a bounded number of steps,
/// once per pot.
[[nodiscard]] Collapse settle(const ClayStack& stack, double density_g_cm3, const Failure& failure,
                              const glm::dvec3& hip_mm, double threshold_kpa);

}  // namespace clay
