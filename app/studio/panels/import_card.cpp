// A drawing of a section, before it becomes clay.

#include "app/studio/actions.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <array>

namespace clay::studio {
namespace {

constexpr double kLowestPotMm = 0.0, kHighestPotMm = 600.0, kThickestWallMm = 40.0;
constexpr double kFarthestAxisMm = 1000.0;

/// Whether anything has changed.
bool draw_settings(AppState& shop, ImportSettings& settings) {
  const ImportSettings before = settings;
  constexpr std::array kTitles = {"By itself", "Left end", "Middle", "At"};
  form_row("Axis");
  if (const int chosen =
          choice_row("##axis", kTitles, static_cast<int>(settings.axis), shop.colours());
      chosen >= 0) {
    settings.axis = static_cast<ImportAxis>(chosen);
    if (settings.axis == ImportAxis::at && shop.importing.made)
      settings.axis_mm = shop.importing.made->axis_mm;
  }
  if (settings.axis == ImportAxis::at) {
    form_row("Place of the axis");
    float mm = static_cast<float>(settings.axis_mm);
    const auto farthest = static_cast<float>(kFarthestAxisMm);
    if (ImGui::DragFloat("##axis_mm", &mm, 0.1f, -farthest, farthest, "%.2f mm"))
      settings.axis_mm = static_cast<double>(mm);
  }
  const LengthUnit unit = shop.settings.unit;
  form_length("Height", settings.height_mm, kLowestPotMm, kHighestPotMm, unit, "as drawn");
  form_length("Wall", settings.wall_mm, 0.0, kThickestWallMm, unit, "as drawn");
  return !(settings == before);
}

void draw_made(AppState& shop) {
  const ImportCard& card = shop.importing;
  const Palette& colours = shop.colours();
  const float side = 14.0f * ImGui::GetFontSize();
  ImGui::BeginChild("##made", {0.0f, side + 2.2f * ImGui::GetFontSize()}, true);
  if (!card.made) {
    ImGui::PushStyleColor(ImGuiCol_Text, colours.warning);
    ImGui::TextWrapped("%s", card.problem.c_str());
    ImGui::PopStyleColor();
    ImGui::EndChild();
    return;
  }
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_section(card.view, at, side, colours);
  ImGui::Dummy({side, side});
  ImGui::SameLine();
  ImGui::BeginGroup();
  const Pot& pot = card.made->pot;
  const auto line = [&](const std::string& text) { ImGui::TextUnformatted(text.c_str()); };
  line(fmt::format("{} high", length_text(pot.stack.height_mm(), shop.settings.unit)));
  line(fmt::format("{} rings", pot.stack.size()));
  line(fmt::format("{:.1f} ml of clay", 1e-3 * pot.stack.volume_mm3()));
  faint_text(colours, fmt::format("{:.1f} ml drawn", 1e-3 * card.made->drawn_mm3));
  faint_text(colours, fmt::format("Axis at {:.2f} mm of the drawing", card.made->axis_mm));
  ImGui::EndGroup();
  ImGui::EndChild();
}

}  // namespace

void draw_import_card(AppState& shop, const ViewRect& view) {
  ImportCard& card = shop.importing;
  begin_card("##import", view, 36.0f);
  card_title(shop, "From a drawing");
  faint_text(shop.colours(), card.path.filename().string());
  if (draw_settings(shop, card.settings)) read_again(card);
  ImGui::Spacing();
  draw_made(shop);
  const auto act = [&](const char* id) { run(*find_action(id), shop); };
  if (card.made) {
    if (main_button("Put it on the wheel (Ctrl+Shift+Enter)", shop.colours())) act("import.take");
    ImGui::SameLine();
  }
  if (ImGui::Button("Close (Esc)")) close_overlay(shop);
  ImGui::End();
}

}  // namespace clay::studio
