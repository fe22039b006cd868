#pragma once
// Makes a pot from a half section: rings with the drawing's volume.

#include "app/import/half_section.hpp"

#include "claystack/engine/clay.hpp"

#include <optional>

namespace clay::importing {

struct DrawnPotSettings {
  double ring_height_mm = 0.75;   ///< approximate: the height is divided into whole rings
  std::optional<double> wall_mm;  ///< hollows a solid drawing: radial wall thickness, and floor
                                  ///< height
  double density_g_cm3 = 1.9;
};

/// Each ring's R^2 and r^2 are the means of the drawing's over the ring's height, so every ring
/// holds the clay drawn there, to the nearest quantum. The ledger begins with it. Refuses more than
/// 2^24 rings, and everything that ClayStack refuses.
Result<Pot> drawn_pot(const HalfSection& section, const DrawnPotSettings& settings,
                      const std::string& name);

}  // namespace clay::importing
