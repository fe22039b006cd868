#include "app/studio/panels/panels.hpp"

#include "app/studio/actions.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace clay::studio {
namespace {

const std::array kPanels = {
    Panel{"tool", "Tool", Column::left, true, &draw_tool},
    Panel{"wheel", "Wheel and clay", Column::left, true, &draw_wheel},
    Panel{"section", "Section", Column::left, true, &draw_section},
    Panel{"force", "Force", Column::right, true, &draw_force},
    Panel{"pot", "Pot", Column::right, true, &draw_pot},
    Panel{"walls", "Walls", Column::right, true, &draw_walls},
    Panel{"certificate", "Certificate", Column::right, true, &draw_certificate},
    Panel{"ledger", "Ledger", Column::right, false, &draw_ledger},
    Panel{"stress", "Stress", Column::right, false, &draw_stress},
    Panel{"servo", "Servo", Column::right, false, &draw_servo},
};

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                    ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

bool is_open(const AppState& shop, const Panel& panel) {
  const auto remembered = shop.settings.open.find(panel.id);
  return remembered == shop.settings.open.end() ? panel.open : remembered->second;
}

void draw_recent(AppState& shop) {
  if (!ImGui::BeginMenu("Recent", !shop.settings.recent.empty())) return;
  std::string chosen;
  for (const std::string& path : shop.settings.recent)
    if (ImGui::MenuItem(path.c_str())) chosen = path;
  ImGui::EndMenu();
  if (!chosen.empty()) open_file(shop, chosen);
}

}  // namespace

std::span<const Panel> panels() { return kPanels; }

bool panel_open(const AppState& shop, std::string_view id) {
  const auto panel = std::ranges::find(kPanels, id, &Panel::id);
  return panel != kPanels.end() && is_open(shop, *panel);
}

void toggle_panel(AppState& shop, std::string_view id) {
  const std::string name(id);
  const bool open = !panel_open(shop, id);
  shop.settings.open[name] = open;
  shop.reveal = open ? name : std::string();
}

Wanted wanted_of(const AppState& shop) {
  return {shop.settings.wall_map || panel_open(shop, "walls") || panel_open(shop, "certificate"),
          panel_open(shop, "servo"), shop.settings.process};
}

void draw_column(AppState& shop, Column column, glm::vec2 corner_px, glm::vec2 size_px) {
  ImGui::SetNextWindowPos({corner_px.x, corner_px.y});
  ImGui::SetNextWindowSize({size_px.x, size_px.y});
  ImGui::Begin(column == Column::left ? "##left" : "##right", nullptr, kFixed);
  for (const Panel& panel : kPanels) {
    if (panel.column != column) continue;
    const bool open = is_open(shop, panel);
    ImGui::SetNextItemOpen(open);
    const bool shown = ImGui::CollapsingHeader(panel.title);
    if (shown != open) shop.settings.open[panel.id] = shown;
    if (!shown) continue;
    ImGui::PushID(panel.id);
    panel.draw(shop);
    ImGui::Spacing();
    ImGui::PopID();
    if (shop.reveal != panel.id) continue;
    ImGui::SetScrollHereY(1.0f);
    shop.reveal.clear();
  }
  ImGui::End();
}

float draw_menu(AppState& shop) {
  if (!ImGui::BeginMainMenuBar()) return 0.0f;
  for (const MenuTitle& menu : menus()) {
    if (!ImGui::BeginMenu(menu.title)) continue;
    // Room between what an action is called and its keys.
    const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(2.5f * spacing.x, spacing.y));
    for (const Action& action : actions()) {
      if (!action.id.starts_with(menu.prefix)) continue;
      const bool on = action.checked != nullptr && action.checked(shop);
      if (ImGui::MenuItem(action.title, text_of(action.chord).c_str(), on, action.enabled(shop)))
        run(action, shop);
      if (action.id == "file.open") draw_recent(shop);
    }
    ImGui::PopStyleVar();
    ImGui::EndMenu();
  }
  const float height = ImGui::GetWindowSize().y;
  ImGui::EndMainMenuBar();
  return height;
}

void draw_overlay(AppState& shop, const ViewRect& view) {
  switch (shop.overlay) {
    case Overlay::none:
      return;
    case Overlay::gallery:
      return draw_gallery(shop, view);
    case Overlay::shortcuts:
      return draw_shortcuts(shop, view);
    case Overlay::quit_prompt:
      return draw_quit_prompt(shop, view);
    case Overlay::open_file:
    case Overlay::save_file:
      return draw_file_box(shop, view);
    case Overlay::export_files:
      return draw_export_card(shop, view);
    case Overlay::import_drawing:
      return draw_import_card(shop, view);
    case Overlay::settings:
      return draw_settings_card(shop, view);
  }
}

}  // namespace clay::studio
