// Overlays that ask or tell: shortcuts, quitting, names of files.

#include "studio/actions.hpp"
#include "studio/panels/panels.hpp"
#include "studio/panels/widgets.hpp"

#include <imgui_stdlib.h>

#include <array>
#include <string>
#include <vector>

namespace clay::studio {
namespace {

struct MouseHelp {
  const char* how;
  const char* what;
};
constexpr std::array kMouseHelp = {
    MouseHelp{"Left", "shape the clay"},
    MouseHelp{"Ctrl+Left", "trim, or press when trimming"},
    MouseHelp{"Middle or Right", "turn the view"},
    MouseHelp{"Shift+the same", "shift the view"},
    MouseHelp{"Wheel", "nearer, farther"},
};

struct HelpRow {
  std::string how;
  const char* what;
};

std::vector<HelpRow> help_rows() {
  std::vector<HelpRow> rows;
  for (const MouseHelp& help : kMouseHelp) rows.push_back({help.how, help.what});
  for (const Action& action : actions())
    if (action.chord.key != 0) rows.push_back({text_of(action.chord), action.title});
  return rows;
}

}  // namespace

void draw_shortcuts(Workshop& shop, const ViewRect& view) {
  const std::vector<HelpRow> rows = help_rows();
  const std::size_t half = (rows.size() + 1) / 2;
  begin_card("##shortcuts", view, 50.0f);
  card_title(shop, "Keys and mouse");
  // Down the left half, then down the right one.
  if (ImGui::BeginTable("##keys", 4, ImGuiTableFlags_SizingStretchProp)) {
    for (std::size_t i = 0; i < half; ++i) {
      ImGui::TableNextRow();
      for (std::size_t at = i; at < rows.size(); at += half) {
        ImGui::TableNextColumn();
        ImGui::TextColored(shop.colours().accent, "%s", rows[at].how.c_str());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(rows[at].what);
      }
    }
    ImGui::EndTable();
  }
  ImGui::Spacing();
  if (ImGui::Button("Close")) close_overlay(shop);
  ImGui::End();
}

void draw_quit_prompt(Workshop& shop, const ViewRect& view) {
  begin_card("##quit", view, 30.0f);
  card_title(shop, "Keep this pot?");
  ImGui::TextWrapped("It has changed since it was last saved.");
  ImGui::Spacing();
  const auto act = [&](const char* id) { run(*find_action(id), shop); };
  if (ImGui::Button("Save (Enter)")) act("quit.save");
  ImGui::SameLine();
  if (ImGui::Button("Do not save (Ctrl+D)")) act("quit.discard");
  ImGui::SameLine();
  if (ImGui::Button("Go on (Esc)")) act("quit.cancel");
  ImGui::End();
}

void draw_file_box(Workshop& shop, const ViewRect& view) {
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
