#include "app/import/mesh_warnings.hpp"

#include "core/text.hpp"

#include <fmt/format.h>

#include <glm/vec3.hpp>
#include <optional>

namespace clay::importing {
namespace {

std::string first_at(const glm::dvec3& p) {
  return fmt::format("the first at ({}, {}, {}) mm", nine_digit_text(p.x), nine_digit_text(p.y),
                     nine_digit_text(p.z));
}

void warn_about(const solid::MeshEnclosure& found, std::vector<std::string>& warnings) {
  if (found.open_edges > 0)
    warnings.push_back(
        fmt::format("expected a closed mesh, found {}, {}; an open mesh has no volume, and a "
                    "surface without thickness becomes solid clay: check --repair --thicken MM "
                    "gives it walls",
                    counted(found.open_edges, "open edge"), first_at(found.open_at)));
  if (found.flipped_edges > 0)
    warnings.push_back(
        fmt::format("expected triangles that all face outward, found {} between triangles of "
                    "opposite orientation, {}; the mesh has no volume",
                    counted(found.flipped_edges, "edge"), first_at(found.flipped_at)));
  if (found.open_edges == 0 && found.flipped_edges == 0 && !found.volume_mm3)
    warnings.emplace_back(
        "expected two triangles at each edge, found edges with more; the mesh has no volume: check "
        "--repair removes triangles that occur twice");
  if (found.inward())
    warnings.emplace_back(
        "expected triangles that face outward, found them facing inward: read as reversed");
}

}  // namespace

std::vector<std::string> mesh_warnings(const MeshPot& made, const solid::MeshEnclosure& enclosure,
                                       const DrawnPotSettings& rings) {
  std::vector<std::string> warnings;
  warn_about(enclosure, warnings);
  if (made.noise_mm > 0.0)
    warnings.push_back(fmt::format(
        "expected points on a surface of revolution, found noise of about {:.3f} mm (standard "
        "deviation): faces that rise by less are made level, and the rings may deviate by {:.3f} "
        "mm",
        made.noise_mm, made.aimed_mm));
  if (!rings.ring_height_mm && made.off_mm > made.aimed_mm)
    warnings.push_back(
        fmt::format("expected rings within {:.3f} mm of the section, found {:.3f} mm; rings "
                    "lower than {:.4g} mm are not closer: smooth the mesh, or set the height with "
                    "--ring-height",
                    made.aimed_mm, made.off_mm, made.pot.stack.ring_height_mm()));
  if (const auto gap = gap_warning(made.pot.stack)) warnings.push_back(*gap + " (--ring-height)");
  return warnings;
}

std::optional<std::string> low_pot_warning(const MeshPotSettings& settings) {
  constexpr double kUsualPotMm = 10.0;
  if (!settings.height_mm || *settings.height_mm >= kUsualPotMm) return std::nullopt;
  return fmt::format("the pot is only {:.3g} mm high", *settings.height_mm);
}

}  // namespace clay::importing
