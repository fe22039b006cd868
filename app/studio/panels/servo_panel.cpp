// The last seconds of force and of the servo's time, every tick of them.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/plot.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::studio {
namespace {

constexpr float kHeightEm = 4.5f;
constexpr double kLeastForceN = 0.5, kLeastLateUs = 10.0;  // tops of axes with little on them

std::string time_text(double us) {
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

void draw_servo(AppState& shop) {
  const Palette& colours = shop.colours();
  const TickHistory& ticks = shop.readings.ticks();
  if (ticks.empty())
    return faint_text(colours, "No tick seen yet: the servo runs while a tool is in the clay.");
  const TickFigures figures = ticks.figures();
  value_row(colours, "Force of the clay", fmt::format("last {:g} s", kHistoryS));
  const double force_top = round_up(std::max(kLeastForceN, figures.force_most_n));
  draw_history(ticks, &servo::TickSample::clay_n, force_top, fmt::format("{:g} N", force_top),
               colours.accent, colours);
  value_row(colours, "Woken late by", fmt::format("last {:g} s", kHistoryS));
  const double late_top = round_up(std::max(kLeastLateUs, figures.late_most_us));
  draw_history(ticks, &servo::TickSample::late_us, late_top, time_text(late_top), colours.warning,
               colours);
  value_row(colours, "Late, median", time_text(figures.late_p50_us));
  value_row(colours, "Late, 99 % within", time_text(figures.late_p99_us));
  value_row(colours, "Work, median", time_text(figures.work_p50_us));
  value_row(colours, "Ticks, missed", fmt::format("{}, {}", figures.ticks, figures.missed));
  if (const auto dropped = shop.potter.trace().dropped(); dropped > 0)
    faint_text(colours, fmt::format("{} ticks are not shown: the window was too slow", dropped));
}

}  // namespace clay::studio
