// Overlays that ask or tell: shortcuts, quitting, names of files.

#include "studio/actions.hpp"
#include "studio/panels/panels.hpp"
#include "studio/panels/widgets.hpp"

#include <imgui_stdlib.h>

#include <array>

namespace clay::studio {
namespace {

struct MouseHelp {
  const char* how;
  const char* what;
};
constexpr std::array kMouseHelp = {
    MouseHelp{"Left", "shape the clay"},
    MouseHelp{"Ctrl+Left", "trim (or press, when trimming)"},
    MouseHelp{"Middle, Right", "turn the view"},
    MouseHelp{"Shift+Middle, Shift+Right", "shift the view"},
    MouseHelp{"Wheel", "nearer, farther"},
};

void title(Workshop& shop, const char* text) {
  ImGui::PushFont(shop.fonts.title);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
  ImGui::Spacing();
}

void help_row(const Palette& colours, const std::string& how, const char* what) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextColored(colours.accent, "%s", how.c_str());
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(what);
}

}  // namespace

void draw_shortcuts(Workshop& shop, const ViewRect& view) {
  const float em = ImGui::GetFontSize();
  begin_card("##shortcuts", view, {46.0f * em, 36.0f * em});
  title(shop, "Keys and mouse");
  if (ImGui::BeginTable("##keys", 4, ImGuiTableFlags_SizingFixedFit, {0.0f, -2.4f * em})) {
    for (const MouseHelp& help : kMouseHelp) help_row(shop.colours(), help.how, help.what);
    for (const Action& action : actions())
      if (action.chord.key != 0) help_row(shop.colours(), text_of(action.chord), action.title);
    ImGui::EndTable();
  }
  if (ImGui::Button("Close")) shop.overlay = Overlay::none;
  ImGui::End();
}

void draw_quit_prompt(Workshop& shop, const ViewRect& view) {
  const float em = ImGui::GetFontSize();
  begin_card("##quit", view, {30.0f * em, 10.5f * em});
  title(shop, "Keep this pot?");
  ImGui::TextWrapped("It has changed since it was last saved.");
  ImGui::Spacing();
  const auto act = [&](const char* id) { run(*find_action(id), shop); };
  if (ImGui::Button("Save")) act("quit.save");
  ImGui::SameLine();
  if (ImGui::Button("Quit without saving")) act("quit.discard");
  ImGui::SameLine();
  if (ImGui::Button("Go on throwing")) act("quit.cancel");
  ImGui::End();
}

void draw_file_box(Workshop& shop, const ViewRect& view) {
  const float em = ImGui::GetFontSize();
  const bool saves = shop.overlay == Overlay::save_file;
  begin_card("##file", view, {40.0f * em, 11.5f * em});
  title(shop, saves ? "Save as" : "Open");
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1.0f);
  const bool entered =
      ImGui::InputText("##path", &shop.path_box, ImGuiInputTextFlags_EnterReturnsTrue);
  faint_text(shop.colours(),
             saves ? "NAME.work keeps every stroke; NAME.pot.json or NAME.pot.cbor the pot alone"
                   : "A scene, a pot or a work");
  if (ImGui::Button(saves ? "Save" : "Open") || entered) {
    if (!shop.path_box.empty()) {
      if (saves)
        save_to(shop, shop.path_box);
      else
        open_file(shop, shop.path_box);
    }
  }
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) close_overlay(shop);
  ImGui::End();
}

}  // namespace clay::studio
