#pragma once
// How the window looks: two themes, one font, one scale.

#include "app/render/picture.hpp"

#include <imgui.h>

namespace clay::studio {

using render::Theme;

/// Colours with a meaning, for what panels draw themselves.
struct Palette {
  ImVec4 accent;   ///< what is chosen
  ImVec4 faint;    ///< words that explain
  ImVec4 good;     ///< all is well
  ImVec4 warning;  ///< thin walls, lost ticks
  ImVec4 fault;    ///< a device is gone, a file was not written
  ImVec4 clay;     ///< a section's face
};
[[nodiscard]] const Palette& palette(Theme theme);
/// Black or white, whichever is easier to read on `face`; where that is not opaque, on the theme's
/// own ground below it.
[[nodiscard]] ImVec4 ink_on(const ImVec4& face);

inline constexpr float kSmallestScale = 0.5f, kLargestScale = 3.0f;

struct Fonts {
  ImFont* text = nullptr;   ///< DejaVu Sans, 15 px at a scale of 1
  ImFont* title = nullptr;  ///< bold, 21 px
};

/// Sets colours, sizes and fonts of the current ImGui context anew. The font texture is stale
/// after it. Without DejaVu on the machine it falls back on ImGui's own font.
Fonts apply_style(Theme theme, float scale);

}  // namespace clay::studio
