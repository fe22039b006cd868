#pragma once
#include "claystack/engine/clay.hpp"

#include <cstddef>

namespace clay::bench {

inline constexpr std::size_t kBelliedRings = 200;

/// Rings of 0.75 mm: a bellied pot with throwing marks; solid if the wall is 0.
Pot bellied_pot(double wall_mm);

}  // namespace clay::bench
