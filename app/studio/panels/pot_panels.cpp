// The pot on the wheel: dimensions, walls, certificate, ledger.

#include "app/render/legend.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace clay::studio {

void draw_pot(const ViewModel& model, Actions& actions) {
  const Readings& readings = model.readings;
  if (readings.stack() == nullptr) return faint_text(model.colours(), "No clay on the wheel");
  const LengthUnit unit = model.settings.unit;
  const Palette& colours = model.colours();
  if (readings.fallen()) faint_text(colours, "As it stood before the fall:");
  value_row(colours, "Height", length_text(model.stroke.view().height_mm, unit));
  value_row(colours, "Largest diameter", length_text(readings.diameter_mm(), unit));
  value_row(colours, "Weight", short_mass_text(readings.account().in_stack_g));
  ImGui::SetNextItemWidth(kToEdge);
  if (const Material* chosen = choose_material(model.settings.material))
    actions.emplace_back(SetMaterial{*chosen});
}

namespace {

constexpr std::size_t kMostStretches = 3;
constexpr float kSourceEm = 22.0f;

void draw_thin_places(const PotCheck& check, const Palette& colours, LengthUnit unit) {
  const std::vector<Stretch> stretches = thin_stretches(check);
  for (std::size_t i = 0; i < std::min(stretches.size(), kMostStretches); ++i)
    faint_text(colours, fmt::format("Too thin at heights from {} to {}",
                                    length_text(stretches[i].from_mm, unit),
                                    length_text(stretches[i].to_mm, unit)));
  if (stretches.size() > kMostStretches)
    faint_text(colours, fmt::format("and at {} more heights", stretches.size() - kMostStretches));
}

}  // namespace

void draw_walls(const ViewModel& model, Actions& actions) {
  const Palette& colours = model.colours();
  bool map = model.settings.wall_map;
  if (ImGui::Checkbox("Wall thickness map", &map)) actions.emplace_back(SetWallMap{map});
  ImGui::SetNextItemWidth(kToEdge);
  std::string process = model.settings.process;
  if (choose_process(model, "No process", process, actions))
    actions.emplace_back(SetProcess{process});
  const auto& check = model.readings.check();
  if (model.readings.stack() == nullptr || !check)
    return faint_text(colours, "No clay on the wheel");
  const bool known = check->proved && !check->fallen;
  wrapped_text(wall_text(*check, model.settings.unit),
               check->thin()           ? colours.fault
               : known && check->limit ? colours.good
                                       : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  if (check->limit && ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "%s", wrapped("Source: " + check->limit->source, kSourceEm * ImGui::GetFontSize()).c_str());
  draw_thin_places(*check, colours, model.settings.unit);
}

namespace {

constexpr std::size_t kMostRemarks = 4;

std::string volume_text(double mm3) { return fmt::format("{:.3f} ml", 1e-3 * mm3); }

void headline(const PotCheck& check, bool again, const Palette& colours) {
  ImGui::TextColored(check.proved ? colours.good : colours.fault, "%s",
                     check.proved ? "Proved: one closed solid" : "Not proved");
  faint_text(colours, again           ? "Checking the current pot..."
                      : check.stopped ? "Not checked"
                      : check.live    ? "Checked: the outline during the stroke"
                      : check.fallen  ? "Checked: the triangles of the fallen pot"
                                      : "Checked: the exact pot");
}

void figures(const PotCheck& check, const Palette& colours, LengthUnit unit) {
  value_row(colours, "Triangles", fmt::format("{}", check.triangles));
  value_row(colours, "Tolerance", tolerance_text(check.tolerance_mm, unit));
  if (!check.fallen)
    value_row(colours, "Proved minimum wall", thickness_text(check.least_wall_mm, unit));
  value_row(colours, "Clay volume", volume_text(check.counted_mm3));
  value_row(colours, "Volume of the solid", volume_text(check.proved_mm3));
  // Where the fallen part overlaps the standing one, the union contains the clay once.
  if (check.fallen)
    value_row(colours, "Overlap", volume_text(check.counted_mm3 - check.proved_mm3));
  value_row(colours, "Relative volume error", fmt::format("{:.1g}", check.volume_error_relative));
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

void draw_certificate(const ViewModel& model, Actions&) {
  const Palette& colours = model.colours();
  const auto& check = model.readings.check();
  if (model.readings.stack() == nullptr || !check)
    return faint_text(colours, "No clay on the wheel");
  headline(*check, model.readings.checking() && !model.readings.live(), colours);
  if (check->proved) {
    figures(*check, colours, model.settings.unit);
  } else {
    wrapped_text(check->why_not);
    if (check->fault_mm) wrapped_text("The pot is " + parts_text(check->form, model.settings.unit));
  }
  remarks(*check, colours, model.settings.unit);
  // Omitted in scripts, because their pictures must be reproducible.
  if (model.real_time)
    value_row(colours, "Run time", fmt::format("{:.1f} ms", 1e3 * check->seconds));
}

void draw_ledger(const ViewModel& model, Actions&) {
  const Palette& colours = model.colours();
  const Readings& readings = model.readings;
  if (readings.stack() == nullptr) return faint_text(colours, "No clay on the wheel");
  const ClayAccount& account = readings.account();
  value_row(colours, "At the start", mass_text(account.initial_g));
  if (account.added_g != 0.0) value_row(colours, "Added", mass_text(account.added_g));
  value_row(colours, "In the pot", mass_text(account.in_stack_g));
  value_row(colours, "Trimmed", mass_text(account.trimmed_g));
  if (account.outside_g != 0.0) value_row(colours, "Above the rim", mass_text(account.outside_g));
  const bool sound = account.unaccounted == "0";
  ImGui::TextColored(sound ? colours.good : colours.fault, "%s",
                     fmt::format("Clay unaccounted for: {}", account.unaccounted).c_str());
  if (!sound) faint_text(colours, fmt::format("{:g} g", account.unaccounted_g));
  if (readings.fallen()) return faint_text(colours, "A fallen pot has no capacity.");
  value_row(colours, "Capacity to the brim", capacity_text(readings.capacity_mm3()));
}

}  // namespace clay::studio
