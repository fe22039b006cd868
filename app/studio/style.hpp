#pragma once
// Appearance of the window: two themes, one font, one scale.

#include "app/render/picture.hpp"

#include <imgui.h>

namespace clay::studio {

using render::Theme;

/// Colours with a meaning, for elements that the panels draw themselves.
struct Palette {
  ImVec4 accent;   ///< selected items
  ImVec4 faint;    ///< explanations
  ImVec4 good;     ///< success
  ImVec4 warning;  ///< thin walls, missed ticks
  ImVec4 fault;    ///< lost device, file not written
  ImVec4 clay;     ///< cut face of the section
};
[[nodiscard]] const Palette& palette(Theme theme);
/// The colour, black or white, that is easier to read on `face`; if `face` is translucent, on the
/// background of the theme below it.
[[nodiscard]] ImVec4 ink_on(const ImVec4& face);

inline constexpr float kSmallestScale = 0.5f, kLargestScale = 3.0f;

struct Fonts {
  ImFont* text = nullptr;   ///< Inter, 16 px at a scale of 1
  ImFont* title = nullptr;  ///< semi-bold, 22 px
  ImFont* small = nullptr;  ///< 12 px, for the labels of icons
};

/// Sets colours, sizes and fonts of the current ImGui context; the font texture must be rebuilt
/// afterwards. Without Inter and DejaVu it uses the default font of ImGui. `fingers`: controls are
/// at least 40 px high at a scale of 1.
Fonts apply_style(Theme theme, float scale, bool fingers = false);

}  // namespace clay::studio
