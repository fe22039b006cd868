#pragma once
// The form of a pot, from its rings: figures for which a process sets no limit.

#include "claystack/engine/clay.hpp"
#include "claystack/export/job.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>

namespace clay::studio {

/// The least diameter of a mouth through which a hollow can be filled or drained [mm].
inline constexpr double kLeastMouthMm = solid::kLeastDrainMm;

struct PotForm {
  bool hollow = false;                ///< some ring has a bore
  bool floorless = false;             ///< every ring has a bore: the pot is open at both ends
  std::size_t parts = 1;              ///< that share no clay
  std::optional<double> parting_mm;   ///< the lowest level between two parts
  std::optional<double> floor_mm;     ///< height at which the bore above the floor begins
  std::optional<double> throttle_mm;  ///< a bore narrower than kLeastMouthMm, above a wider one
};
[[nodiscard]] PotForm form_of(const ClayStack& stack);

/// Whether the shortest way through a wall, between two points (rho, y) of the section, goes
/// through the floor.
[[nodiscard]] bool in_floor(const PotForm& form, glm::dvec2 from_mm, glm::dvec2 to_mm);

}  // namespace clay::studio
