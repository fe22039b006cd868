#pragma once
// Small things that more than one panel draws.

#include "app/studio/app_state.hpp"
#include "app/studio/units.hpp"
#include "app/studio/settings.hpp"

#include <span>
#include <string>

namespace clay::studio {

/// A row of buttons of equal width, one of which is chosen. The one that was clicked, or -1.
int choice_row(const char* id, std::span<const char* const> titles, int chosen,
               const Palette& colours);

/// A labelled slider for a length that is kept in mm and shown in `unit`.
bool length_slider(const char* label, double& mm, double low_mm, double high_mm, LengthUnit unit);

/// What Enter, or its like, does in a card.
bool main_button(const char* text, const Palette& colours);

/// The head of a card.
void card_title(const AppState& shop, const char* text);

/// Label on the left; the next control takes the rest of the line.
inline constexpr float kFormEm = 9.0f;
void form_row(const char* label);
/// A slider in such a line; `none`: what is shown for 0.
bool form_length(const char* label, double& mm, double low_mm, double high_mm, LengthUnit unit,
                 const char* none = nullptr);

/// The pot as seen from the side, and its wall in section on the right half; in a square.
void draw_section(const render::PotView& pot, ImVec2 corner, float side, const Palette& colours);

void faint_text(const Palette& colours, const std::string& text);
/// Name on the left, value at the right edge of the column.
void value_row(const Palette& colours, const char* name, const std::string& value);

/// Begins a window in the middle of the view, over a dimmed one, as high as it needs to be;
/// ImGui::End() ends it.
void begin_card(const char* id, const ViewRect& view, float width_em);

}  // namespace clay::studio
