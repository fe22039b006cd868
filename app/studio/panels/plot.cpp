#include "app/studio/panels/plot.hpp"

#include <algorithm>

namespace clay::studio {
namespace {

float part_of(double value, double top) {
  return static_cast<float>(std::clamp(value / top, 0.0, 1.0));
}

/// Extended to touch its neighbour, so that a curve has no gaps.
MinMax joined(const MinMax& part, const std::optional<MinMax>& before) {
  if (!before) return part;
  return {std::min(part.least, before->most), std::max(part.most, before->least)};
}

}  // namespace

PlotArea begin_plot(float height_em) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, height_em * ImGui::GetFontSize());
  const PlotArea area{at, {at.x + size.x, at.y + size.y}};
  ImGui::GetWindowDrawList()->AddRectFilled(area.low, area.high,
                                            ImGui::GetColorU32(ImGuiCol_FrameBg, 0.5f),
                                            ImGui::GetStyle().FrameRounding);
  ImGui::Dummy(size);
  return area;
}

void plot_columns(const PlotArea& area, std::span<const std::optional<MinMax>> columns, double top,
                  const ImVec4& colour) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float step = area.width() / static_cast<float>(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i]) continue;
    const MinMax part = joined(*columns[i], i > 0 ? columns[i - 1] : std::nullopt);
    const float x = area.low.x + step * static_cast<float>(i);
    const float low = area.high.y - area.height() * part_of(part.most, top);
    const float high = area.high.y - area.height() * part_of(part.least, top);
    draw->AddRectFilled({x, std::min(low, area.high.y - 1.0f)},
                        {x + step, std::max(high, low + 1.0f)}, ImGui::GetColorU32(colour));
  }
}

void plot_rows(const PlotArea& area, std::span<const std::optional<MinMax>> rows, double top,
               const ImVec4& colour) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float step = area.height() / static_cast<float>(rows.size());
  const float thick = 0.15f * ImGui::GetFontSize();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i]) continue;
    const MinMax part = joined(*rows[i], i > 0 ? rows[i - 1] : std::nullopt);
    const float y = area.high.y - step * static_cast<float>(i + 1);
    const float left = area.low.x + area.width() * part_of(part.least, top);
    const float right = area.low.x + area.width() * part_of(part.most, top);
    draw->AddRectFilled({std::max(area.low.x, std::min(left, right - thick)), y},
                        {std::max(right, area.low.x + thick), y + step},
                        ImGui::GetColorU32(colour));
  }
}

void plot_text(const PlotArea& area, Corner corner, const std::string& text, const ImVec4& colour) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float pad = 0.25f * ImGui::GetFontSize();
  const bool left = corner == Corner::upper_left || corner == Corner::lower_left;
  const bool upper = corner == Corner::upper_left || corner == Corner::upper_right;
  ImGui::GetWindowDrawList()->AddText({left ? area.low.x + pad : area.high.x - pad - size.x,
                                       upper ? area.low.y + pad : area.high.y - pad - size.y},
                                      ImGui::GetColorU32(colour), text.c_str());
}

}  // namespace clay::studio
