#pragma once
// From a half section to clay on the wheel: rings with the drawing's own volume.

#include "app/import/half_section.hpp"

#include "claystack/engine/clay.hpp"

#include <optional>

namespace clay::importing {

struct DrawnPotSettings {
  double ring_height_mm = 0.75;   ///< about: a whole number of rings makes the height
  std::optional<double> wall_mm;  ///< a solid drawing is hollowed: a wall this thick in the radius,
                                  ///< above a floor as high
  double density_g_cm3 = 1.9;
};

/// Each ring's R^2 and r^2 are the means of the drawing's over the ring's height, so every ring
/// holds the clay that is drawn there, to the nearest quantum. The ledger begins with it. Refuses
/// more than 2^24 rings, and whatever ClayStack does.
Result<Pot> drawn_pot(const HalfSection& section, const DrawnPotSettings& settings,
                      const std::string& name);

}  // namespace clay::importing
