// What would be proved of the pot if it were exported now.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clay::studio {
namespace {

constexpr std::size_t kMostRemarks = 4;

std::string volume_text(double mm3) { return fmt::format("{:.3f} ml", 1e-3 * mm3); }

void headline(const PotCheck& check, bool again, const Palette& colours) {
  ImGui::TextColored(check.proved ? colours.good : colours.fault, "%s",
                     check.proved ? "Proved: one closed solid" : "Not proved");
  faint_text(colours, again          ? "Checking the clay as it is now..."
                      : check.live   ? "Of the outline, in mid-stroke"
                      : check.fallen ? "Fallen: by the exact test of its triangles"
                                     : "Of the pot, to the quantum");
}

void figures(const PotCheck& check, const Palette& colours, LengthUnit unit) {
  value_row(colours, "Triangles", fmt::format("{}", check.triangles));
  value_row(colours, "Tolerance", fmt::format("{:g} mm", check.tolerance_mm));
  if (!check.fallen) value_row(colours, "Nowhere thinner", length_text(check.least_wall_mm, unit));
  value_row(colours, "Clay counted", volume_text(check.counted_mm3));
  value_row(colours, "Clay in the solid", volume_text(check.proved_mm3));
  // Where the fallen part lies in the standing one the union has the clay once.
  if (check.fallen)
    value_row(colours, "Lies within", volume_text(check.counted_mm3 - check.proved_mm3));
  value_row(colours, "Relative error", fmt::format("{:.1g}", check.volume_error_relative));
}

void remarks(const PotCheck& check, const Palette& colours, LengthUnit unit) {
  for (std::size_t i = 0; i < std::min(check.remarks.size(), kMostRemarks); ++i) {
    const PotRemark& remark = check.remarks[i];
    const std::string at = remark.to_mm > remark.from_mm
                               ? fmt::format("{} to {}", length_text(remark.from_mm, unit),
                                             length_text(remark.to_mm, unit))
                               : length_text(remark.from_mm, unit);
    faint_text(colours, fmt::format("{}: {}", at, remark.text));
  }
  if (check.remarks.size() > kMostRemarks)
    faint_text(colours, fmt::format("and {} more", check.remarks.size() - kMostRemarks));
}

}  // namespace

void draw_certificate(AppState& shop) {
  const Palette& colours = shop.colours();
  const auto& check = shop.readings.check();
  if (shop.readings.stack() == nullptr || !check)
    return faint_text(colours, "No clay on the wheel");
  headline(*check, shop.readings.checking() && !shop.readings.live(), colours);
  if (check->proved) {
    figures(*check, colours, shop.settings.unit);
  } else {
    ImGui::TextWrapped("%s", check->why_not.c_str());
    if (check->fault_mm)
      ImGui::TextWrapped(
          "%s",
          fmt::format("It parts at {}", length_text(*check->fault_mm, shop.settings.unit)).c_str());
  }
  remarks(*check, colours, shop.settings.unit);
  // On a script's clock nothing takes time, and pictures are the same every time.
  if (shop.host.real_time())
    value_row(colours, "Took", fmt::format("{:.1f} ms", 1e3 * check->seconds));
}

}  // namespace clay::studio
