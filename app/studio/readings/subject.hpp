#pragma once
// The clay that panels tell of: the pot at rest, to the quantum, or its outline in mid-stroke.

#include "app/history/work.hpp"
#include "app/render/picture.hpp"
#include "claystack/engine/clay.hpp"

#include <optional>

namespace clay::studio {

struct Subject {
  history::SharedPot pot;   ///< at rest; nothing in mid-stroke
  render::PotView outline;  ///< as it is on the screen, either way
  double density_g_cm3 = 1.9;
  double crown_mm = 0.0;  ///< of the outline's height, above its rows
  [[nodiscard]] bool live() const noexcept { return pot == nullptr; }
};

/// The stack behind an outline: its rows for rings, their radii as near as float holds them, and
/// the crown. Nothing where the rows are no clay.
[[nodiscard]] std::optional<ClayStack> stack_of(const render::PotView& outline, double crown_mm);

}  // namespace clay::studio
