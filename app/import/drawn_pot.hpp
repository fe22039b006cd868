#pragma once
// Makes a pot from a half section: rings that hold the clay of the drawing, whose levels
// are first moved to the bounds of rings.

#include "app/import/deviation.hpp"
#include "app/import/half_section.hpp"
#include "app/import/hollowing.hpp"

#include "claystack/engine/clay.hpp"

#include <optional>
#include <string>

namespace clay::importing {

inline constexpr double kDrawnDeviationMm = 0.02;
inline constexpr double kHighestRingMm = 0.75;
/// The usual tolerance of an export: its facets take less than this from a wall, so that a pot with
/// the wall of a limit passes it.
inline constexpr double kFacetsMm = 0.02;
/// Steps of rings this low are within kDrawnDeviationMm of any smooth outline. If they are not, the
/// outline has noise, or details that are lower than these rings.
inline constexpr double kFineRingMm = 0.02;

struct DrawnPotSettings {
  /// At most; empty: as low as `deviation_mm` needs, up to kHighestRingMm.
  std::optional<double> ring_height_mm;
  /// Hollows a solid drawing: thickness of wall and floor.
  std::optional<double> wall_mm;
  double density_g_cm3 = 1.9;
  double deviation_mm = kDrawnDeviationMm;  ///< aimed at
  double facets_mm = kFacetsMm;             ///< is added to the wall, not to the floor
};

struct DrawnPot {
  Pot pot;
  Deviation deviation;  ///< of the rings from the drawing; from the hollowed drawing with a wall
  std::optional<ThinnestWall> thinnest;  ///< of the hollowed drawing
};

/// A warning where the pot is in pieces: its lowest ring that does not touch the one above. Rings
/// may be too high for a flat wall.
[[nodiscard]] std::optional<std::string> gap_warning(const ClayStack& stack);

/// The clay of a stack as slabs of constant radii.
[[nodiscard]] std::vector<Slab> slabs_of(const ClayStack& stack);

/// The height is divided into whole rings whose bounds meet the level lines of the drawing, which
/// move to them by less than half a ring where they do not. Each ring's R^2 and r^2 are the means
/// of the drawing's over the ring's height, so every ring holds the clay drawn there, to the
/// nearest quantum. The ledger begins with it. Without a ring height, rings become lower until none
/// deviates by more than `deviation_mm`, or there are 30,000. Below kFineRingMm they do so only as
/// long as that lowers the deviation; if it does not, the highest rings are used that deviate by
/// little more than the best. Refuses walls that do not fit, more than 2^24 rings, and everything
/// that ClayStack refuses.
Result<DrawnPot> drawn_pot(const HalfSection& section, const DrawnPotSettings& settings,
                           const std::string& name);

}  // namespace clay::importing
