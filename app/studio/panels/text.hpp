#pragma once
// Text in panels and dialogs: its line breaks, and its shortening.

#include "app/studio/style.hpp"

#include <imgui.h>

#include <chrono>
#include <string>
#include <string_view>

namespace clay::studio {

/// A problem that the export found. Its tooltip has the parts in brackets, such as the source of a
/// limit.
void problem_text(const std::string& problem, const ImVec4& colour);

/// Lines of at most `width_px`, broken at blanks, but not between a number and its unit. A longer
/// word stays whole.
[[nodiscard]] std::string wrapped(std::string_view text, float width_px);
/// At most this wide: the middle of a longer text is left out, because the end of a file name shows
/// the kind of file.
[[nodiscard]] std::string shortened(const std::string& text, float width_px);
/// To the right edge of the window.
void wrapped_text(std::string_view text, const ImVec4& colour);
void wrapped_text(std::string_view text);
void faint_text(const Palette& colours, const std::string& text);
/// Name at the left, value at the right edge of the column, below the name if it does not fit
/// beside.
void value_row(const Palette& colours, const char* name, const std::string& value);

/// "22 Nov 14:05", local time.
[[nodiscard]] std::string time_text(std::chrono::system_clock::time_point when);

/// Opacity of the ground of texts over the view.
inline constexpr float kOverView = 0.82f;
/// Text on its own background, readable over the view.
void shaded_text(ImDrawList* draw, ImVec2 at, const std::string& text, const ImVec4& colour);

}  // namespace clay::studio
