#pragma once
// The parts of the window around the view. A panel is a function that draws itself into a column
// from a const view model and emits actions. To add a panel, write the function and add it to the
// table in panels.cpp.

#include "app/studio/action.hpp"
#include "app/studio/scene_view.hpp"
#include "app/studio/view_model.hpp"

#include <string>
#include <string_view>

namespace clay::studio {

/// Key of the drawer in Settings::open.
inline constexpr const char* kDiagnostics = "diagnostics";
[[nodiscard]] bool diagnostics_open(const Settings& settings);
/// Key in Settings::open: whether a window without room beside the view shows the context below it.
inline constexpr const char* kBelow = "below";
[[nodiscard]] bool below_open(const Settings& settings);
[[nodiscard]] bool in_diagnostics(std::string_view id);
/// Whether the panel is unfolded and in sight; false for an unknown id.
[[nodiscard]] bool panel_open(const Settings& settings, const UiState& ui, std::string_view id);
/// Data that the open panels need.
[[nodiscard]] Wanted wanted_of(const Settings& settings, const UiState& ui);

/// All panels of a column, in one window.
void draw_column(const ViewModel& model, Actions& actions, Column column, glm::vec2 corner_px,
                 glm::vec2 size_px);

/// The strip of tools and views at the left edge. `panels`: with a button that shows the context
/// below the view.
[[nodiscard]] float strip_width();
void draw_strip(const ViewModel& model, Actions& actions, glm::vec2 corner_px, glm::vec2 size_px,
                bool panels = false);

/// Returns its height [px].
float draw_menu(const ViewModel& model, Actions& actions);
[[nodiscard]] float status_height();
void draw_status_bar(const ViewModel& model, glm::vec2 corner_px, glm::vec2 size_px);
void draw_banners(const ViewModel& model, Actions& actions, const ViewRect& rect, float top_px);
void draw_hint(const ViewModel& model, Actions& actions, const ViewRect& rect);
/// Draws over the view: figures at the tool, above `bottom_px`, the pull of the hand, and the floor
/// to keep.
void draw_at_tool(const ViewModel& model, const ViewRect& rect, float bottom_px);
/// A veil over the view while the wheel is paused.
void draw_pause(const ViewModel& model, const ViewRect& rect);
/// The step of the lesson, and its instruction.
void draw_guide(const ViewModel& model, Actions& actions, const ViewRect& rect);
/// Of its card in the last frame, with the space below it [px]; 0: it was not shown.
[[nodiscard]] float guide_height();
/// Draws over the view: the path to follow in the present step.
void draw_path(const ViewModel& model, const ViewRect& rect);
/// "Ready to print", or the reason why the pot is not; empty: there is no pot, or no check yet.
[[nodiscard]] std::string verdict_text(const Document& document, const Readings& readings,
                                       LengthUnit unit);
/// The same at the top of the view. Returns its lower edge.
float draw_verdict(const ViewModel& model, const ViewRect& rect);
/// Draws over the view: results of the checks at their places on the pot, and, below `top_px`, the
/// scale of the wall map.
void draw_marks(const ViewModel& model, const ViewRect& rect, float top_px);
/// Draws over the view: the outline of the target.
void draw_target(const ViewModel& model, const ViewRect& rect);
/// Draws over the view, below `top_px`: problems of the last export at their places.
void draw_export_marks(const ViewModel& model, const ViewRect& rect, float top_px);

// The panels.
void draw_tool(const ViewModel& model, Actions& actions);
void draw_wheel(const ViewModel& model, Actions& actions);
void draw_force(const ViewModel& model, Actions& actions);
void draw_pot(const ViewModel& model, Actions& actions);
void draw_section(const ViewModel& model, Actions& actions);
void draw_goal(const ViewModel& model, Actions& actions);
void draw_walls(const ViewModel& model, Actions& actions);
void draw_certificate(const ViewModel& model, Actions& actions);
void draw_ledger(const ViewModel& model, Actions& actions);
void draw_stress(const ViewModel& model, Actions& actions);
void draw_servo(const ViewModel& model, Actions& actions);

/// Draws the open dialog, if there is one.
void draw_dialog(const ViewModel& model, Actions& actions, const ViewRect& rect);
// One function for each alternative of Dialog.
void draw(const NoDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect);
void draw(const GalleryDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect);
void draw(const ShortcutsDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect);
/// "22 Nov 14:05, bowl: 3 strokes, 20 s".
[[nodiscard]] std::string text_of(const history::Recoverable& work);
void draw(const ReplaceDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect);
void draw(const WorksDialog& dialog, const ViewModel& model, Actions& actions,
          const ViewRect& rect);
void draw(const DiscardDialog& dialog, const ViewModel& model, Actions& actions,
          const ViewRect& rect);
void draw(const UnsavedDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect);
void draw(const OpenDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect);
void draw(const SaveDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect);
void draw(const ExportDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect);
void draw(const ImportDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect);
void draw(const PictureDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect);
void draw(const SettingsDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect);

}  // namespace clay::studio
