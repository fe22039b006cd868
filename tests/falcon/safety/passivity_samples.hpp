#pragma once
#include "claystack/falcon/passivity.hpp"

namespace clay::falcon {

inline constexpr double kTickS = 1e-3;
inline const SampledLoop kLoop{1000, 0.1, 0.002, 0};

inline glm::dvec3 along(double x) { return {x, 0, 0}; }

}  // namespace clay::falcon
