#include "app/import/drawing_warnings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

namespace clay::importing {
namespace {

/// Slope of the outside at the rim, from the vertical [degrees], if the corner there is so narrow
/// that the check measures a thinner wall.
std::optional<double> sharp_rim(const HalfSection& section) {
  constexpr double kMostDeg = 50.0;  // at 45 the check finds the whole wall, at 55 a tenth of a mm
  const Slab& top = section.slabs.back();
  const double lean_deg = std::atan2(top.outer_to_mm - top.outer_from_mm, top.to_mm - top.from_mm) *
                          180.0 / std::numbers::pi;
  return lean_deg > kMostDeg ? std::optional(lean_deg) : std::nullopt;
}

}  // namespace

std::vector<std::string> drawing_warnings(const HalfSection& section, const DrawnPot& drawn,
                                          const DrawnPotSettings& settings,
                                          const std::string& name) {
  constexpr double kLowestMm = 5.0, kHighestMm = 1000.0;
  std::vector<std::string> warnings;
  if (section.height_mm < kLowestMm || section.height_mm > kHighestMm)
    warnings.push_back(
        fmt::format("{}: the pot is {:.3g} mm high; if the drawing has another unit, --height MM "
                    "sets the height",
                    name, section.height_mm));
  if (!settings.ring_height_mm && drawn.deviation.mm > kDrawnDeviationMm)
    warnings.push_back(fmt::format(
        "{}: expected rings within {:g} mm of the drawing, found {:.3f} mm; rings lower than {:g} "
        "mm are not closer, because details of the drawing are lower still",
        name, kDrawnDeviationMm, drawn.deviation.mm, drawn.pot.stack.ring_height_mm()));
  if (const auto lean_deg = sharp_rim(section); lean_deg && settings.wall_mm)
    warnings.push_back(fmt::format(
        "{}: the wall leans outward by {:.0f} degrees at the rim, which is cut level, so its edge "
        "is sharp; draw the rim steeper, or draw the inside too",
        name, *lean_deg));
  if (const auto gap = gap_warning(drawn.pot.stack))
    warnings.push_back(name + ": " + *gap + " (--ring-height)");
  return warnings;
}

}  // namespace clay::importing
