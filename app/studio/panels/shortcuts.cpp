// The list of keys, mouse buttons and gamepad buttons, from the tables of commands.

#include "app/studio/commands.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <algorithm>
#include <functional>
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
           {"Ctrl+Left", "Trim, or press if the tool trims"},
           {"Middle or right", "Turn the view"},
           {"Shift+middle or right", "Move the view"},
           {"Wheel", "Zoom"},
           {"Left on a value", "Type it"}}};
}

Section touch_section() {
  return {"Touch screen",
          {{"One finger", "Shape the clay"},
           {"Two fingers", "Turn the view"},
           {"Spread, pinch", "Zoom"}}};
}

/// Buttons have the names of an Xbox controller.
Section gamepad_section() {
  Section section{"Gamepad",
                  {{"Left stick", "Move the tool"},
                   {"RT", "Press: further is firmer"},
                   {"LT, then RT", "Pinch: LT closes the fingers"},
                   {"Right stick", "Turn the view"}}};
  for (const PadBinding& binding : pad_bindings())
    section.rows.push_back({std::string(binding.name), find_command(binding.command)->title});
  section.rows.push_back({"Arrows, A, B", "In menus: move, choose, close"});
  return section;
}

/// Both keys of a command that has two.
std::string keys_of(const Command& command) {
  std::string keys = text_of(command.chord);
  if (command.second_chord.key != 0) keys += ", " + text_of(command.second_chord);
  return keys;
}

/// Commands that are in no menu belong to a dialog.
Section section_of(const Menu* menu) {
  Section section{menu != nullptr ? menu->title : "Dialogs", {}};
  for (const Command& command : commands()) {
    const Menu* its = nullptr;
    for (const Menu& other : menus())
      if (command.id.starts_with(other.prefix)) its = &other;
    if (its == menu && command.chord.key != 0)
      section.rows.push_back({keys_of(command), command.title});
  }
  return section;
}

std::vector<Section> all_sections(bool fingers) {
  std::vector<Section> sections{mouse_section(), gamepad_section()};
  if (fingers) sections.insert(sections.begin(), touch_section());
  for (const Menu& menu : menus()) sections.push_back(section_of(&menu));
  sections.push_back(section_of(nullptr));
  return sections;
}

using Columns = std::vector<std::vector<Section>>;

/// Columns of nearly equal height: each section, the longest first, goes to the shortest column.
Columns columns_of(const std::vector<Section>& sections, std::size_t count) {
  std::vector<const Section*> by_length;
  for (const Section& section : sections) by_length.push_back(&section);
  std::ranges::stable_sort(by_length, std::greater(),
                           [](const Section* section) { return section->rows.size(); });
  std::vector<std::vector<const Section*>> parts(count);
  std::vector<std::size_t> lines(count);
  for (const Section* section : by_length) {
    const auto shortest = static_cast<std::size_t>(std::ranges::min_element(lines) - lines.begin());
    parts[shortest].push_back(section);
    lines[shortest] += section->rows.size() + 2;  // its title, and the gap below
  }
  // In the order of the menus.
  for (auto& part : parts) std::ranges::sort(part);
  std::ranges::sort(parts);
  Columns columns;
  for (const auto& part : parts)
    for (columns.emplace_back(); const Section* section : part) columns.back().push_back(*section);
  return columns;
}

void draw_section_of_keys(const Section& section, const Palette& colours, float keys_px) {
  ImGui::TextUnformatted(section.title.c_str());
  const float left = ImGui::GetCursorPosX();
  for (const HelpRow& row : section.rows) {
    ImGui::TextColored(colours.faint, "%s", row.how.c_str());
    ImGui::SameLine();
    ImGui::SetCursorPosX(left + keys_px);
    ImGui::TextUnformatted(row.what.c_str());
  }
  ImGui::Dummy({0.0f, 0.4f * ImGui::GetFontSize()});
}

/// Width of the keys of a column, or of their descriptions [px].
float widest_of(const std::vector<Section>& column, std::string HelpRow::*part) {
  float widest = 0.0f;
  for (const Section& section : column)
    for (const HelpRow& row : section.rows)
      widest = std::max(widest, ImGui::CalcTextSize((row.*part).c_str()).x);
  return widest + 0.8f * ImGui::GetFontSize();
}

/// As many columns, up to three, as have room.
Columns columns_for(float room_px, bool fingers) {
  const std::vector<Section> sections = all_sections(fingers);
  for (std::size_t count = 3; count > 1; --count) {
    Columns columns = columns_of(sections, count);
    float width = 0.0f;
    for (const std::vector<Section>& column : columns)
      width += widest_of(column, &HelpRow::how) + widest_of(column, &HelpRow::what);
    if (width + 2.0f * ImGui::GetFontSize() < room_px) return columns;
  }
  return columns_of(sections, 1);
}

}  // namespace

void draw(const ShortcutsDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect) {
  constexpr float kWideEm = 68.0f;
  begin_dialog("##shortcuts", rect, kWideEm);
  dialog_title(model, "Controls");
  begin_body(rect);
  const Columns columns = columns_for(ImGui::GetContentRegionAvail().x, model.fingers);
  const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(spacing.x, 0.3f * spacing.y));
  if (ImGui::BeginTable("##keys", static_cast<int>(columns.size()),
                        ImGuiTableFlags_SizingStretchProp)) {
    for (const std::vector<Section>& column : columns) {
      ImGui::TableNextColumn();
      for (const Section& section : column)
        draw_section_of_keys(section, model.colours(), widest_of(column, &HelpRow::how));
    }
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  end_body();
  if (ImGui::Button("Close (Esc)")) actions.emplace_back(CloseDialog{});
  ImGui::End();
}

}  // namespace clay::studio
