// The sheet of keys and of what the mouse does, from the table of actions.

#include "app/studio/actions.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace clay::studio {
namespace {

struct HelpRow {
  std::string how, what;
};
struct Section {
  std::string title;
  std::vector<HelpRow> rows;
};

Section mouse_section() {
  return {"Mouse",
          {{"Left", "Shape the clay"},
           {"Ctrl+Left", "Trim, or press when trimming"},
           {"Middle or right", "Turn the view"},
           {"Shift+the same", "Shift the view"},
           {"Wheel", "Nearer, farther"}}};
}

/// An action in no menu is one of a card that is open.
Section section_of(const MenuTitle* menu) {
  Section section{menu != nullptr ? menu->title : "In cards", {}};
  for (const Action& action : actions()) {
    const MenuTitle* its = nullptr;
    for (const MenuTitle& other : menus())
      if (action.id.starts_with(other.prefix)) its = &other;
    if (its == menu && action.chord.key != 0)
      section.rows.push_back({text_of(action.chord), action.title});
  }
  return section;
}

std::vector<Section> all_sections() {
  std::vector<Section> sections{mouse_section()};
  for (const MenuTitle& menu : menus()) sections.push_back(section_of(&menu));
  sections.push_back(section_of(nullptr));
  return sections;
}

/// Into columns, in order, none much longer than another.
std::array<std::vector<Section>, 3> columns_of(std::vector<Section> sections) {
  const auto lines = [](const Section& section) { return section.rows.size() + 2; };
  std::size_t all = 0;
  for (const Section& section : sections) all += lines(section);
  std::array<std::vector<Section>, 3> columns;
  std::size_t before = 0;
  for (Section& section : sections) {
    const std::size_t middle = before + lines(section) / 2;
    before += lines(section);
    columns[std::min(columns.size() - 1, middle * columns.size() / all)].push_back(
        std::move(section));
  }
  return columns;
}

void draw_section_of_keys(const Section& section, const Palette& colours, float keys_px) {
  ImGui::TextColored(colours.faint, "%s", section.title.c_str());
  const float left = ImGui::GetCursorPosX();
  for (const HelpRow& row : section.rows) {
    ImGui::TextColored(colours.accent, "%s", row.how.c_str());
    ImGui::SameLine();
    ImGui::SetCursorPosX(left + keys_px);
    ImGui::TextUnformatted(row.what.c_str());
  }
  ImGui::Dummy({0.0f, 0.4f * ImGui::GetFontSize()});
}

float widest_of(const std::vector<Section>& column) {
  float widest = 0.0f;
  for (const Section& section : column)
    for (const HelpRow& row : section.rows)
      widest = std::max(widest, ImGui::CalcTextSize(row.how.c_str()).x);
  return widest + 0.8f * ImGui::GetFontSize();
}

}  // namespace

void draw_shortcuts(AppState& shop, const ViewRect& view) {
  static const auto kColumns = columns_of(all_sections());
  begin_card("##shortcuts", view, 68.0f);
  card_title(shop, "Keys and mouse");
  const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(spacing.x, 0.3f * spacing.y));
  if (ImGui::BeginTable("##keys", static_cast<int>(kColumns.size()),
                        ImGuiTableFlags_SizingStretchProp)) {
    for (const std::vector<Section>& column : kColumns) {
      ImGui::TableNextColumn();
      for (const Section& section : column)
        draw_section_of_keys(section, shop.colours(), widest_of(column));
    }
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  if (ImGui::Button("Close (Esc)")) close_overlay(shop);
  ImGui::End();
}

}  // namespace clay::studio
