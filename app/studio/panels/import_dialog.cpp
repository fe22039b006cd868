// The import dialog: settings and preview of a drawing.

#include "app/studio/commands.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/value_slider.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace clay::studio {
namespace {

constexpr double kLowestPotMm = 0.0, kHighestPotMm = 600.0, kThickestWallMm = 40.0;
constexpr double kFarthestAxisMm = 1000.0;

ImportSettings draw_choices(const ImportDialog& dialog, const ViewModel& model) {
  ImportSettings settings = dialog.settings;
  constexpr std::array kTitles = {"Automatic", "Left end", "Middle", "Right end", "At"};
  form_row("Axis");
  if (const int chosen = choice_row("##axis", kTitles, static_cast<int>(settings.axis));
      chosen >= 0) {
    settings.axis = static_cast<ImportAxis>(chosen);
    if (settings.axis == ImportAxis::at && dialog.made) settings.axis_mm = dialog.made->axis_mm;
  }
  if (settings.axis == ImportAxis::at) {
    form_row("Axis position");
    float mm = static_cast<float>(settings.axis_mm);
    const auto farthest = static_cast<float>(kFarthestAxisMm);
    if (ImGui::DragFloat("##axis_mm", &mm, 0.1f, -farthest, farthest, "%.2f mm"))
      settings.axis_mm = static_cast<double>(mm);
  }
  const LengthUnit unit = model.settings.unit;
  form_length("Height", settings.height_mm, kLowestPotMm, kHighestPotMm, unit, "as drawn");
  form_length("Wall", settings.wall_mm, 0.0, kThickestWallMm, unit, "as drawn");
  return settings;
}

void draw_result(const ImportDialog& dialog, const ViewModel& model) {
  const Palette& colours = model.colours();
  const float side =
      std::min(14.0f * ImGui::GetFontSize(), 0.5f * ImGui::GetContentRegionAvail().x);
  ImGui::BeginChild("##made", {0.0f, side + 2.2f * ImGui::GetFontSize()}, true);
  if (!dialog.made) {
    ImGui::PushStyleColor(ImGuiCol_Text, colours.warning);
    wrapped_text(dialog.problem);
    ImGui::PopStyleColor();
    ImGui::EndChild();
    return;
  }
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_half_section(dialog.view, at, side, colours);
  ImGui::Dummy({side, side});
  ImGui::SameLine();
  ImGui::BeginGroup();
  const Pot& pot = dialog.made->pot;
  const auto line = [&](const std::string& text) { ImGui::TextUnformatted(text.c_str()); };
  line(fmt::format("{} high", length_text(pot.stack.height_mm(), model.settings.unit)));
  line(fmt::format("{} rings", pot.stack.size()));
  line(fmt::format("{:.1f} ml of clay", 1e-3 * pot.stack.volume_mm3()));
  faint_text(colours, fmt::format("{:.1f} ml in the drawing", 1e-3 * dialog.made->drawn_mm3));
  faint_text(colours, fmt::format("Axis at {:.2f} mm in the drawing", dialog.made->axis_mm));
  ImGui::EndGroup();
  ImGui::EndChild();
  ImGui::PushStyleColor(ImGuiCol_Text, colours.warning);
  for (const std::string& note : dialog.made->notes) wrapped_text(note);
  ImGui::PopStyleColor();
}

}  // namespace

void draw(const ImportDialog& dialog, const ViewModel& model, Actions& actions,
          const ViewRect& rect) {
  begin_dialog("##import", rect, 36.0f);
  dialog_title(model, "Import a drawing");
  faint_text(model.colours(), dialog.path.filename().string());
  const ImportSettings settings = draw_choices(dialog, model);
  if (!(settings == dialog.settings)) actions.emplace_back(EditImport{settings});
  ImGui::Spacing();
  draw_result(dialog, model);
  if (dialog.made) {
    if (main_button("Place on the wheel (Ctrl+Shift+Enter)", model.colours()))
      actions.emplace_back(RunCommand{"import.take"});
    same_line_if_room("Close (Esc)");
  }
  if (ImGui::Button("Close (Esc)")) actions.emplace_back(CloseDialog{});
  ImGui::End();
}

}  // namespace clay::studio
