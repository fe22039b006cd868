#pragma once
// Controls that several panels or dialogs use.

#include "app/studio/action.hpp"
#include "app/studio/page.hpp"
#include "app/studio/panels/text.hpp"
#include "app/studio/scene_view.hpp"
#include "app/studio/units.hpp"
#include "app/studio/view_model.hpp"

#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace clay::studio {

/// A width: up to the right edge of the window's content.
inline constexpr float kToEdge = -std::numeric_limits<float>::min();

/// Buttons of equal width, one of which is selected: in one row, or in several if their titles have
/// no room. Returns the index of a clicked button, or -1.
int choice_row(const char* id, std::span<const char* const> titles, int chosen);

/// The next button or text, with this text, stands beside the last item if the window has room.
/// `beside_px`: width of other controls that belong to it.
void same_line_if_room(const char* text, float beside_px = 0.0f);
/// A checkbox beside the last one, or below it at `left_px` if the window has no room.
bool next_box(const char* title, bool& on, float left_px);

/// A line across the content of a dialog.
void rule();

/// The default button of a dialog.
bool main_button(const char* text, const Palette& colours, bool enabled = true);

void dialog_title(const ViewModel& model, const char* text);

/// A label at the left; the next control fills the rest of the line. In a narrow dialog the label
/// is above it.
inline constexpr float kFormEm = 10.5f;
void form_row(const char* label);
/// Whether the label is above.
[[nodiscard]] bool narrow_form();
/// A tooltip for the line of the last control.
void tip(const char* text);

/// Lines for the name and the folder of files; a page has downloads only.
void form_place(std::string& name, std::string& folder, Actions& actions);
/// A list of clays and glazes; the one that was chosen now, or null.
[[nodiscard]] const Material* choose_material(const Material& shown);

/// For a distance from the target [mm].
[[nodiscard]] const ImVec4& match_colour(double mm, const Palette& colours);

/// The pot from the side in a square; the right half is cut open.
void draw_half_section(const render::PotView& pot, ImVec2 corner, float side,
                       const Palette& colours);

/// ImGui::Begin for a part of the window. On the page screen readers get its texts (app/web).
void begin_window(const char* id, int flags);
/// For screen readers: the name of the last control, and whether it is the chosen one.
void mark_chosen(const char* name, bool chosen);
/// ImGui::BeginCombo with a name for screen readers.
bool begin_list(const char* name, const char* shown, int flags = 0);

/// Begins a window in the middle of the dimmed view, as high as its content. Call ImGui::End() to
/// end it. `steady_em`: where more or less content must not move its top, its usual height.
void begin_dialog(const char* id, const ViewRect& rect, float width_em, float steady_em = 0.0f);

/// The part of a dialog between its title and its buttons. Where the view is too low for all of it,
/// it scrolls, so that the buttons stay in sight. Arrow keys go through its controls. `width_px` 0:
/// that of the dialog.
void begin_body(const ViewRect& rect, float width_px = 0.0f);
void end_body();

/// A list for choosing `process`. Returns true if it has changed. `none`: label for no process.
bool choose_process(const ViewModel& model, const char* none, std::string& process,
                    Actions& actions);

}  // namespace clay::studio
