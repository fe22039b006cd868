#pragma once
// Controls that more than one panel or dialog uses.

#include "app/studio/action.hpp"
#include "app/studio/scene_view.hpp"
#include "app/studio/units.hpp"
#include "app/studio/view_model.hpp"

#include <span>
#include <string>

namespace clay::studio {

/// A row of buttons of equal width, one of which is chosen. Returns the one that was clicked, or
/// -1.
int choice_row(const char* id, std::span<const char* const> titles, int chosen,
               const Palette& colours);

/// A labelled slider for a length in mm, shown in `unit`; whether it has moved.
bool length_slider(const char* label, double& mm, double low_mm, double high_mm, LengthUnit unit);

/// The default button of a dialog.
bool main_button(const char* text, const Palette& colours);

void dialog_title(const ViewModel& model, const char* text);

/// A label at the left; the next control takes the rest of the line.
inline constexpr float kFormEm = 9.0f;
void form_row(const char* label);
/// A slider in such a line; `none`: text shown for 0.
bool form_length(const char* label, double& mm, double low_mm, double high_mm, LengthUnit unit,
                 const char* none = nullptr);

/// The pot from the side, its right half in section, in a square.
void draw_half_section(const render::PotView& pot, ImVec2 corner, float side,
                       const Palette& colours);

void faint_text(const Palette& colours, const std::string& text);
/// Name on the left, value at the right edge of the column.
void value_row(const Palette& colours, const char* name, const std::string& value);

/// Begins a window in the middle of the dimmed view, as high as its content; ImGui::End() ends it.
void begin_dialog(const char* id, const ViewRect& rect, float width_em);

/// A list to choose `process` from; whether it has changed. `none`: title of no process.
bool choose_process(const ViewModel& model, const char* none, std::string& process,
                    Actions& actions);

}  // namespace clay::studio
