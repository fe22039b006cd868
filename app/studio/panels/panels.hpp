#pragma once
// The parts of the window around the view. A panel is a function that draws itself into a column
// from what the workshop holds; to add one, write it and name it in the table of panels.cpp.

#include "app/studio/workshop.hpp"

#include <span>
#include <string_view>

namespace clay::studio {

enum class Column { left, right };

struct Panel {
  const char* id;     ///< in the settings
  const char* title;  ///< of its header, by which it is folded
  Column column;
  bool open;  ///< as it comes
  void (*draw)(Workshop& shop);
};
[[nodiscard]] std::span<const Panel> panels();
/// Unfolded or not; of one that is not there: no.
[[nodiscard]] bool panel_open(const Workshop& shop, std::string_view id);
/// Unfolds it and brings it into view, or folds it.
void toggle_panel(Workshop& shop, std::string_view id);
/// What the panels that are unfolded need.
[[nodiscard]] Wanted wanted_of(const Workshop& shop);

/// A list to choose `process` from; `none`: what no process is called.
void choose_process(Workshop& shop, const char* none, std::string& process);

/// All of a column, in a window of its own.
void draw_column(Workshop& shop, Column column, glm::vec2 corner_px, glm::vec2 size_px);

/// Heights [px]: the menu's own, and that of the status bar.
float draw_menu(Workshop& shop);
[[nodiscard]] float status_height();
void draw_status_bar(Workshop& shop, glm::vec2 corner_px, glm::vec2 size_px);
/// Over the view: what the checks say of the pot, where it is, and what its colours mean.
void draw_marks(Workshop& shop, const ViewRect& view);
/// What the last export found wrong, where it is.
[[nodiscard]] bool has_export_marks(const Workshop& shop);
void draw_export_marks(Workshop& shop, const ViewRect& view);
void draw_banner(Workshop& shop, const ViewRect& view);
void draw_hint(Workshop& shop, const ViewRect& view);
void draw_overlay(Workshop& shop, const ViewRect& view);
/// Below the view; 0 where there is nothing to show or no room.
[[nodiscard]] float timeline_height(const Workshop& shop, glm::vec2 room_px);
void draw_timeline(Workshop& shop, glm::vec2 corner_px, glm::vec2 size_px);

// The panels.
void draw_tool(Workshop& shop);
void draw_wheel(Workshop& shop);
void draw_force(Workshop& shop);
void draw_pot(Workshop& shop);
void draw_section(Workshop& shop);
void draw_walls(Workshop& shop);
void draw_certificate(Workshop& shop);
void draw_ledger(Workshop& shop);
void draw_stress(Workshop& shop);
void draw_servo(Workshop& shop);

// The overlays.
void draw_gallery(Workshop& shop, const ViewRect& view);
void draw_shortcuts(Workshop& shop, const ViewRect& view);
void draw_quit_prompt(Workshop& shop, const ViewRect& view);
void draw_file_box(Workshop& shop, const ViewRect& view);
void draw_export_card(Workshop& shop, const ViewRect& view);
void draw_import_card(Workshop& shop, const ViewRect& view);
void draw_settings_card(Workshop& shop, const ViewRect& view);

}  // namespace clay::studio
