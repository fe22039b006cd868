// What the clay bears at every height, and what it would fall at.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/plot.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::studio {
namespace {

constexpr float kHeightEm = 9.0f;
constexpr double kNear = 0.8;  // of the limit: said in another colour

std::vector<CurvePoint> points_of(const StressCurve& curve) {
  std::vector<CurvePoint> points;
  points.reserve(curve.kpa.size());
  for (std::size_t ring = 0; ring < curve.kpa.size(); ++ring)
    points.push_back({(static_cast<double>(ring) + 0.5) * curve.ring_height_mm, curve.kpa[ring]});
  return points;
}

/// Of fewer rings than pixels every pixel has the value of the one below it.
void fill_gaps(std::vector<std::optional<MinMax>>& rows) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (!rows[i]) rows[i] = rows[i - 1];
  for (std::size_t i = rows.size(); i-- > 1;)
    if (!rows[i - 1]) rows[i - 1] = rows[i];
}

double right_edge_kpa(const StressCurve& curve) {
  return 1.08 * std::max(curve.most_kpa, curve.limit_kpa.value_or(0.0));
}
double height_mm(const StressCurve& curve) {
  return curve.ring_height_mm * static_cast<double>(curve.kpa.size());
}

void draw_curve(const StressCurve& curve, const Palette& colours) {
  const PlotArea area = begin_plot(kHeightEm);
  const double height = height_mm(curve);
  const double top = right_edge_kpa(curve);
  if (!(top > 0.0)) return;
  auto rows = min_max_of(points_of(curve), 0.0, height, whole_px(area.height()));
  fill_gaps(rows);
  plot_rows(area, rows, top, colours.accent);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (curve.limit_kpa) {
    const float x = area.low.x + area.width() * static_cast<float>(*curve.limit_kpa / top);
    draw->AddLine({x, area.low.y}, {x, area.high.y}, ImGui::GetColorU32(colours.fault),
                  0.12f * ImGui::GetFontSize());
    const std::string text = fmt::format("{:g} kPa", *curve.limit_kpa);
    const PlotArea left{area.low, {x, area.high.y}};
    plot_text(left, Corner::upper_right, text, colours.fault);
  }
}

}  // namespace

void draw_stress(AppState& shop) {
  const Palette& colours = shop.colours();
  if (shop.readings.stack() == nullptr) return faint_text(colours, "No clay on the wheel");
  if (shop.readings.fallen())
    return faint_text(colours, "The clay has fallen: nothing stands that could be measured.");
  const StressCurve& curve = shop.readings.stress();
  const auto part = curve.part();
  ImGui::PushStyleColor(ImGuiCol_Text, part && *part >= kNear
                                           ? colours.warning
                                           : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  ImGui::TextWrapped("%s", stress_text(curve, shop.settings.unit).c_str());
  ImGui::PopStyleColor();
  draw_curve(curve, colours);
  faint_text(colours,
             fmt::format("Upwards {}, to the right {:.3g} kPa{}",
                         length_text(height_mm(curve), shop.settings.unit), right_edge_kpa(curve),
                         curve.limit_kpa ? "; at the line the clay falls" : ""));
}

}  // namespace clay::studio
