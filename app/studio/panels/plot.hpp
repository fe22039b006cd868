#pragma once
// Plots as wide as a column: a frame, curves that show every peak, labels in the corners.

#include "app/studio/readings/curves.hpp"
#include "app/studio/style.hpp"

#include <optional>
#include <span>
#include <string>

namespace clay::studio {

/// Drawing area [px].
struct PlotArea {
  ImVec2 low, high;
  [[nodiscard]] float width() const { return high.x - low.x; }
  [[nodiscard]] float height() const { return high.y - low.y; }
};

/// Draws a frame as wide as the column and reserves its space.
PlotArea begin_plot(float height_em);

/// Values upwards from 0 to `top`, one pixel column each, connected to the previous one.
void plot_columns(const PlotArea& area, std::span<const std::optional<MinMax>> columns, double top,
                  const ImVec4& colour);
/// The same with horizontal values: to the right, one pixel row each, from the bottom up.
void plot_rows(const PlotArea& area, std::span<const std::optional<MinMax>> rows, double top,
               const ImVec4& colour);

enum class Corner { upper_left, upper_right, lower_left, lower_right };
void plot_text(const PlotArea& area, Corner corner, const std::string& text, const ImVec4& colour);

[[nodiscard]] inline std::size_t whole_px(float px) {
  return px > 1.0f ? static_cast<std::size_t>(px) : 1;
}

}  // namespace clay::studio
