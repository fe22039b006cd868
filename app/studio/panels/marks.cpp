// What the checks say, where it is on the pot; and what the colours on it mean.

#include "app/render/legend.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clay::studio {
namespace {

constexpr float kLeastViewEm = 18.0f;  // of height, for the scale
constexpr int kSteps = 5;

void shaded_text(ImDrawList* draw, ImVec2 at, const std::string& text, const ImVec4& colour) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float pad = 0.2f * ImGui::GetFontSize();
  draw->AddRectFilled({at.x - pad, at.y - 0.5f * pad}, {at.x + size.x + pad, at.y + size.y + pad},
                      ImGui::GetColorU32(ImGuiCol_WindowBg, 0.75f), pad);
  draw->AddText(at, ImGui::GetColorU32(colour), text.c_str());
}

/// The same range for every pot, with the limit.
void draw_scale(const PotCheck& check, const ViewRect& view, LengthUnit unit) {
  const float em = ImGui::GetFontSize();
  if (view.size_px.y < kLeastViewEm * em) return;
  const render::WallMap map = wall_map_of(check);
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const ImVec4 ink = ImGui::GetStyleColorVec4(ImGuiCol_Text);
  const float height = std::min(11.0f * em, 0.45f * view.size_px.y), width = 0.7f * em;
  const ImVec2 low(view.corner_px.x + 1.2f * em, view.corner_px.y + 3.2f * em);
  shaded_text(draw, {low.x, low.y - 1.8f * em}, "Wall", ink);
  for (int px = 0; px < static_cast<int>(height); ++px) {
    const double wall = map.top_mm * (1.0 - (px + 0.5) / static_cast<double>(height));
    const render::Swatch swatch = render::wall_swatch(map, wall);
    const float y = low.y + static_cast<float>(px);
    draw->AddRectFilled({low.x, y}, {low.x + width, y + 1.0f},
                        IM_COL32(swatch.red, swatch.green, swatch.blue, 255));
  }
  for (int step = 0; step <= kSteps; ++step) {
    const double wall = map.top_mm * step / kSteps;
    const float y = low.y + height * (1.0f - static_cast<float>(step) / kSteps);
    draw->AddLine({low.x, y}, {low.x + width + 0.3f * em, y}, ImGui::GetColorU32(ink));
    const std::string more = step == kSteps ? " and more" : "";
    shaded_text(draw, {low.x + width + 0.6f * em, y - 0.55f * em}, length_text(wall, unit) + more,
                ink);
  }
  if (check.limit)
    shaded_text(draw, {low.x, low.y + height + 0.9f * em},
                fmt::format("Hatched red: below {}, {}",
                            length_text(check.limit->min_wall_mm, unit), check.limit->process),
                ink);
}

/// A ring about the place, and its thickness beside it.
void mark_thinnest(const AppState& shop, const PotCheck& check, ImDrawList* draw) {
  const float em = ImGui::GetFontSize();
  const glm::dvec2 middle = 0.5 * (glm::abs(check.thinnest_from) + glm::abs(check.thinnest_to));
  const auto at = shop.view.pixel_of(middle);
  if (!at || !shop.view.rect().holds(*at)) return;
  const ImVec4 colour =
      check.thin() ? shop.colours().warning : ImGui::GetStyleColorVec4(ImGuiCol_Text);
  draw->AddCircle({at->x, at->y}, 0.6f * em, ImGui::GetColorU32(colour), 0, 0.15f * em);
  shaded_text(draw, {at->x + em, at->y - 0.5f * em},
              length_text(check.thinnest_mm, shop.settings.unit), colour);
}

/// The level where the pot parts.
void mark_fault(const AppState& shop, double y_mm, ImDrawList* draw) {
  const ImVec4 colour = shop.colours().fault;
  float widest = 0.0f;
  for (const render::Row& row : shop.potter.view().rows) widest = std::max(widest, row.outer_mm);
  const auto left = shop.view.pixel_of({-1.2 * static_cast<double>(widest), y_mm});
  const auto right = shop.view.pixel_of({1.2 * static_cast<double>(widest), y_mm});
  if (!left || !right) return;
  draw->AddLine({left->x, left->y}, {right->x, right->y}, ImGui::GetColorU32(colour),
                0.15f * ImGui::GetFontSize());
  shaded_text(draw,
              {right->x + 0.3f * ImGui::GetFontSize(), right->y - 0.5f * ImGui::GetFontSize()},
              "not proved here", colour);
}

}  // namespace

void draw_marks(AppState& shop, const ViewRect& view) {
  const auto& check = shop.readings.check();
  if (!check || shop.overlay != Overlay::none || shop.readings.fallen()) return;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({view.corner_px.x, view.corner_px.y},
                     {view.corner_px.x + view.size_px.x, view.corner_px.y + view.size_px.y});
  if (check->fault_mm && panel_open(shop, "certificate")) mark_fault(shop, *check->fault_mm, draw);
  const bool open = shop.settings.wall_map && shop.view.cut != render::Cut::none;
  if (check->proved && (open || check->thin()) && !has_export_marks(shop))
    mark_thinnest(shop, *check, draw);
  if (check->proved && shop.settings.wall_map) draw_scale(*check, view, shop.settings.unit);
  draw->PopClipRect();
}

}  // namespace clay::studio
