#pragma once
// The parts of the window around the view. A panel is a function that draws itself into a column
// from what the workshop holds; to add one, write it and name it in the table of panels.cpp.

#include "app/studio/app_state.hpp"

#include <span>
#include <string_view>

namespace clay::studio {

enum class Column { left, right };

struct Panel {
  const char* id;     ///< in the settings
  const char* title;  ///< of its header, by which it is folded
  Column column;
  bool open;  ///< as it comes
  void (*draw)(AppState& shop);
};
[[nodiscard]] std::span<const Panel> panels();
/// Unfolded or not; of one that is not there: no.
[[nodiscard]] bool panel_open(const AppState& shop, std::string_view id);
/// Unfolds it and brings it into view, or folds it.
void toggle_panel(AppState& shop, std::string_view id);
/// What the panels that are unfolded need.
[[nodiscard]] Wanted wanted_of(const AppState& shop);

/// A list to choose `process` from; `none`: what no process is called.
void choose_process(AppState& shop, const char* none, std::string& process);

/// All of a column, in a window of its own.
void draw_column(AppState& shop, Column column, glm::vec2 corner_px, glm::vec2 size_px);

/// Heights [px]: the menu's own, and that of the status bar.
float draw_menu(AppState& shop);
[[nodiscard]] float status_height();
void draw_status_bar(AppState& shop, glm::vec2 corner_px, glm::vec2 size_px);
/// Over the view: what the checks say of the pot, where it is, and what its colours mean.
void draw_marks(AppState& shop, const ViewRect& view);
/// What the last export found wrong, where it is.
[[nodiscard]] bool has_export_marks(const AppState& shop);
void draw_export_marks(AppState& shop, const ViewRect& view);
void draw_banner(AppState& shop, const ViewRect& view);
void draw_hint(AppState& shop, const ViewRect& view);
void draw_overlay(AppState& shop, const ViewRect& view);
/// Below the view; 0 where there is nothing to show or no room.
[[nodiscard]] float timeline_height(const AppState& shop, glm::vec2 room_px);
void draw_timeline(AppState& shop, glm::vec2 corner_px, glm::vec2 size_px);

// The panels.
void draw_tool(AppState& shop);
void draw_wheel(AppState& shop);
void draw_force(AppState& shop);
void draw_pot(AppState& shop);
void draw_section(AppState& shop);
void draw_walls(AppState& shop);
void draw_certificate(AppState& shop);
void draw_ledger(AppState& shop);
void draw_stress(AppState& shop);
void draw_servo(AppState& shop);

// The overlays.
void draw_gallery(AppState& shop, const ViewRect& view);
void draw_shortcuts(AppState& shop, const ViewRect& view);
void draw_quit_prompt(AppState& shop, const ViewRect& view);
void draw_file_box(AppState& shop, const ViewRect& view);
void draw_export_card(AppState& shop, const ViewRect& view);
void draw_import_card(AppState& shop, const ViewRect& view);
void draw_settings_card(AppState& shop, const ViewRect& view);

}  // namespace clay::studio
