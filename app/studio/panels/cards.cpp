// Overlays that ask: quitting, names of files.

#include "app/studio/actions.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <imgui_stdlib.h>

namespace clay::studio {
void draw_quit_prompt(AppState& shop, const ViewRect& view) {
  begin_card("##quit", view, 34.0f);
  card_title(shop, "Keep this pot?");
  ImGui::TextWrapped("It has changed since it was last saved.");
  ImGui::Spacing();
  const auto act = [&](const char* id) { run(*find_action(id), shop); };
  if (main_button("Save (Enter)", shop.colours())) act("quit.save");
  ImGui::SameLine();
  if (ImGui::Button("Do not save (Ctrl+D)")) act("quit.discard");
  ImGui::SameLine();
  if (ImGui::Button("Go on throwing (Esc)")) act("quit.cancel");
  ImGui::End();
}

void draw_file_box(AppState& shop, const ViewRect& view) {
  const bool saves = shop.overlay == Overlay::save_file;
  begin_card("##file", view, 40.0f);
  card_title(shop, saves ? "Save as" : "Open");
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1.0f);
  const bool entered =
      ImGui::InputText("##path", &shop.path_box, ImGuiInputTextFlags_EnterReturnsTrue);
  faint_text(shop.colours(),
             saves ? "NAME.work keeps every stroke; NAME.pot.json or NAME.pot.cbor the pot alone"
                   : "A scene, a pot, a work, or a drawing of a section (SVG, DXF, CSV)");
  if (main_button(saves ? "Save (Enter)" : "Open (Enter)", shop.colours()) || entered) {
    if (!shop.path_box.empty()) {
      if (saves)
        save_to(shop, shop.path_box);
      else
        open_file(shop, shop.path_box);
    }
  }
  ImGui::SameLine();
  if (ImGui::Button("Cancel (Esc)")) close_overlay(shop);
  ImGui::End();
}

}  // namespace clay::studio
