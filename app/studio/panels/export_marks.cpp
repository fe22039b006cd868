// What is wrong with the pot, shown where it is.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <algorithm>

namespace clay::studio {
namespace {

/// A ring about the place, a line from it, and the words at the line's end, within the view.
void draw_mark(const AppState& shop, const ViewRect& view, const Mark& mark, glm::vec2 at,
               float top) {
  const float em = ImGui::GetFontSize();
  const float wrap = std::min(16.0f * em, 0.45f * view.size_px.x);
  // What is wrong; whose figure it is, and where else, the card says.
  const std::string words =
      mark.text.substr(0, std::min(mark.text.find(';'), mark.text.find(" (")));
  const ImVec2 size = ImGui::CalcTextSize(words.c_str(), nullptr, false, wrap);
  const float right = view.corner_px.x + view.size_px.x;
  const ImVec2 corner(std::max(view.corner_px.x + em, right - size.x - 1.5f * em), top);
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const ImU32 colour = ImGui::GetColorU32(shop.colours().warning);
  const ImVec2 low(corner.x - 0.5f * em, corner.y - 0.4f * em);
  const ImVec2 high(corner.x + size.x + 0.5f * em, corner.y + size.y + 0.4f * em);
  draw->AddLine({at.x, at.y}, {0.5f * (low.x + high.x), high.y}, colour, 0.12f * em);
  draw->AddCircle({at.x, at.y}, 0.7f * em, colour, 0, 0.16f * em);
  draw->AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_PopupBg), 0.3f * em);
  draw->AddRect(low, high, colour, 0.3f * em);
  draw->AddText(ImGui::GetFont(), em, corner, ImGui::GetColorU32(ImGuiCol_Text), words.c_str(),
                nullptr, wrap);
}

}  // namespace

bool has_export_marks(const AppState& shop) {
  return !shop.potter.throwing() && !shop.potter.scrubbing() && !shop.marks.empty() &&
         shop.marked == shop.potter.shared_pot();
}

void draw_export_marks(AppState& shop, const ViewRect& view) {
  if (shop.overlay != Overlay::none || !has_export_marks(shop)) return;
  const float em = ImGui::GetFontSize();
  float top = view.corner_px.y + 1.2f * em;
  for (const Mark& mark : shop.marks) {
    const auto at = shop.view.pixel_of(mark.place_mm);
    if (!at || !view.holds(*at)) continue;
    draw_mark(shop, view, mark, *at, top);
    top += 6.0f * em;
  }
}

}  // namespace clay::studio
