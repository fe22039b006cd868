#pragma once
// One axis of a mass with a damper and a spring, w'' + g w' + k w = 0 for its velocity w: its exact
// state after a time. No case distinction between under- and overdamped, and only + - * /, so that
// every platform gives the same bits.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace clay::falcon::inline safety {

/// The later velocity and acceleration as linear functions of (w, a): pairs of factors.
struct ArmResponse {
  glm::dvec2 path{0.0, 0.0};
  glm::dvec2 velocity{1.0, 0.0};
  glm::dvec2 acceleration{0.0, 1.0};
  glm::dvec3 square{0.0};  ///< integral of the velocity's square: factors of w^2, w a, a^2
};

/// `decay_per_s` is g = damping / mass, `spring_per_s2` is k = stiffness / mass, both >= 0.
ArmResponse arm_response(double decay_per_s, double spring_per_s2, double time_s) noexcept;

}  // namespace clay::falcon::inline safety
