#pragma once
// Rings that a tool stands beside, with or without touching them.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/tool.hpp"
#include "engine/tick/contact.hpp"

#include <cstddef>

namespace clay {

/// Most rings of one call.
inline constexpr std::size_t kMostBeside = 64;

/// f(t) of the tool at the middles of `count` rings from `first` on [mm]; below 0 where a middle is
/// beyond an end of the tool. Writes whole packs; those behind the last ring are below 0.
void radii_beside(const Tool& tool, double ring_height_mm, double hip_y, std::size_t first,
                  std::size_t count, double* radii) noexcept;

/// Whether no ring from `at` on goes into the tool of a contact when they all rise by one ring, nor
/// does the new ring below them.
[[nodiscard]] bool rise_clear(const Tool& tool, const ClayStack& stack, double hip_y,
                              const Contact& contact, const Ring& fresh, std::size_t at) noexcept;

}  // namespace clay
