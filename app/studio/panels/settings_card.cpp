// What the window remembers.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <imgui_stdlib.h>

#include <array>
#include <string>

namespace clay::studio {
namespace {

void draw_look(AppState& shop) {
  Settings& settings = shop.settings;
  constexpr std::array kThemes = {"Dark", "Light"};
  form_row("Theme");
  if (const int chosen =
          choice_row("##theme", kThemes, settings.theme == Theme::dark ? 0 : 1, shop.colours());
      chosen >= 0) {
    settings.theme = chosen == 0 ? Theme::dark : Theme::light;
    shop.restyle = true;
  }
  form_row("Size of text");
  // Taken when it is let go: the slider would move away under the mouse.
  static float scale = 0.0f;
  if (!ImGui::IsAnyItemActive()) scale = settings.scale;
  ImGui::SliderFloat("##scale", &scale, kSmallestScale, kLargestScale, "%.2f",
                     ImGuiSliderFlags_AlwaysClamp);
  if (ImGui::IsItemDeactivatedAfterEdit()) {
    settings.scale = scale;
    shop.restyle = true;
  }
  constexpr std::array kUnits = {"mm", "cm", "in"};
  form_row("Lengths in");
  if (const int chosen =
          choice_row("##unit", kUnits, static_cast<int>(settings.unit), shop.colours());
      chosen >= 0)
    settings.unit = static_cast<LengthUnit>(chosen);
}

void draw_work(AppState& shop) {
  Settings& settings = shop.settings;
  form_row("Hand in the clay");
  float speed = static_cast<float>(settings.pressing_mm_s);
  if (ImGui::SliderFloat("##speed", &speed, static_cast<float>(kSlowestHandMmPerS),
                         static_cast<float>(kFastestHandMmPerS), "%.0f mm/s at most",
                         ImGuiSliderFlags_AlwaysClamp))
    settings.pressing_mm_s = static_cast<double>(speed);
  form_row("Process");
  choose_process(shop, "Not said", settings.process);
  form_row("Folder");
  ImGui::InputText("##folder", &settings.folder);
  form_row("First steps");
  ImGui::Checkbox("Show the hint below the pot", &settings.hints);
}

}  // namespace

void draw_settings_card(AppState& shop, const ViewRect& view) {
  begin_card("##settings", view, 34.0f);
  card_title(shop, "Settings");
  draw_look(shop);
  draw_work(shop);
  ImGui::Spacing();
  const std::string path = settings_path().string();
  faint_text(shop.colours(),
             path.empty() ? "Not kept: there is no home folder" : "Kept in " + path);
  if (ImGui::Button("Close (Esc)")) close_overlay(shop);
  ImGui::End();
}

}  // namespace clay::studio
