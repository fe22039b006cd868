// Plots: stress of the clay, force and timing of the servo.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/plot.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::studio {
namespace {

constexpr float kStressHeightEm = 9.0f;
constexpr double kNear = 0.8;  // fraction of the limit above which the colour changes

std::vector<CurvePoint> points_of(const StressCurve& curve) {
  std::vector<CurvePoint> points;
  points.reserve(curve.kpa.size());
  for (std::size_t ring = 0; ring < curve.kpa.size(); ++ring)
    points.push_back({(static_cast<double>(ring) + 0.5) * curve.ring_height_mm, curve.kpa[ring]});
  return points;
}

/// If there are fewer rings than pixels, a pixel without a ring takes the value below it.
void fill_gaps(std::vector<std::optional<MinMax>>& rows) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (!rows[i]) rows[i] = rows[i - 1];
  for (std::size_t i = rows.size(); i-- > 1;)
    if (!rows[i - 1]) rows[i - 1] = rows[i];
}

double right_edge_kpa(const StressCurve& curve) {
  return 1.08 * std::max(curve.most_kpa, curve.limit_kpa.value_or(0.0));
}

/// `height_mm`: of the pot, with the crown above its rings.
void draw_curve(const StressCurve& curve, double height_mm, const Palette& colours) {
  const PlotArea area = begin_plot(kStressHeightEm);
  const double top = right_edge_kpa(curve);
  if (!(top > 0.0)) return;
  auto rows = min_max_of(points_of(curve), 0.0, height_mm, whole_px(area.height()));
  fill_gaps(rows);
  plot_rows(area, rows, top, colours.clay);
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

void draw_stress(const ViewModel& model, Actions&) {
  const Palette& colours = model.colours();
  if (model.readings.stack() == nullptr) return faint_text(colours, "No clay on the wheel");
  if (model.readings.fallen()) return faint_text(colours, "A fallen pot has no stress curve.");
  const StressCurve& curve = model.readings.stress();
  const auto part = curve.part();
  wrapped_text(stress_text(curve, model.settings.unit),
               part && *part >= kNear ? colours.warning : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  const double height_mm = model.readings.stack()->height_mm();
  draw_curve(curve, height_mm, colours);
  faint_text(colours,
             fmt::format("Vertical: height to {}. Horizontal: stress to {:.3g} kPa{}",
                         length_text(height_mm, model.settings.unit), right_edge_kpa(curve),
                         curve.limit_kpa ? ". Line: limit of the clay" : ""));
}

namespace {

constexpr float kHeightEm = 4.5f;
constexpr double kLeastForceN = 0.5, kLeastLateUs = 10.0;  // smallest axis ranges

std::string duration_text(double us) {
  if (us >= 1000.0) return fmt::format("{:.3g} ms", 1e-3 * us);
  return fmt::format("{:.{}f} \xc2\xb5s", us, us < 10.0 ? 1 : 0);
}

void draw_history(const TickHistory& ticks, float servo::TickSample::*value, double top,
                  const std::string& top_text, const ImVec4& colour, const Palette& colours) {
  const PlotArea area = begin_plot(kHeightEm);
  plot_columns(area, min_max_of(ticks.curve(value), -kHistoryS, 0.0, whole_px(area.width())), top,
               colour);
  plot_text(area, Corner::upper_left, top_text, colours.faint);
}

}  // namespace

void draw_servo(const ViewModel& model, Actions&) {
  const Palette& colours = model.colours();
  const TickHistory& ticks = model.readings.ticks();
  if (ticks.empty()) return faint_text(colours, "No ticks yet: the servo runs during a stroke.");
  const TickFigures figures = ticks.figures();
  value_row(colours, "Contact force", fmt::format("last {:g} s", kHistoryS));
  const double force_top = round_up(std::max(kLeastForceN, figures.force_most_n));
  draw_history(ticks, &servo::TickSample::clay_n, force_top, fmt::format("{:g} N", force_top),
               colours.faint, colours);
  value_row(colours, "Lateness", fmt::format("last {:g} s", kHistoryS));
  const double late_top = round_up(std::max(kLeastLateUs, figures.late_most_us));
  draw_history(ticks, &servo::TickSample::late_us, late_top, duration_text(late_top),
               colours.warning, colours);
  value_row(colours, "Lateness, median", duration_text(figures.late_p50_us));
  value_row(colours, "Lateness, 99 %", duration_text(figures.late_p99_us));
  value_row(colours, "Run time, median", duration_text(figures.work_p50_us));
  value_row(colours, "Ticks, missed", fmt::format("{}, {}", figures.ticks, figures.missed));
  if (const auto dropped = model.stroke.trace().dropped(); dropped > 0)
    faint_text(colours, fmt::format("{} ticks are missing: the window was too slow", dropped));
}

}  // namespace clay::studio
