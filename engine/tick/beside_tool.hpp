#pragma once
// Rings that a tool stands beside, with or without touching them.

#include "claystack/engine/tool.hpp"

#include <cstddef>

namespace clay {

/// Most rings of one call.
inline constexpr std::size_t kMostBeside = 64;

/// f(t) of the tool at the middles of `count` rings from `first` on [mm]; below 0 where a middle is
/// beyond an end of the tool. Writes whole packs; those behind the last ring are below 0.
void radii_beside(const Tool& tool, double ring_height_mm, double hip_y, std::size_t first,
                  std::size_t count, double* radii) noexcept;

}  // namespace clay
