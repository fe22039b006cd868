#pragma once
// Plots of a column's width: a frame, curves with nothing lost between pixels, words in corners.

#include "app/studio/readings/curves.hpp"
#include "app/studio/style.hpp"

#include <optional>
#include <span>
#include <string>

namespace clay::studio {

/// What is drawn on [px].
struct PlotArea {
  ImVec2 low, high;
  [[nodiscard]] float width() const { return high.x - low.x; }
  [[nodiscard]] float height() const { return high.y - low.y; }
};

/// A frame as wide as the column, and room taken for it.
PlotArea begin_plot(float height_em);

/// Values upwards from 0 to `top`; a column of pixels each, joined to the one before it.
void plot_columns(const PlotArea& area, std::span<const std::optional<MinMax>> columns, double top,
                  const ImVec4& colour);
/// The same lying: values to the right, a row of pixels each, from the bottom up.
void plot_rows(const PlotArea& area, std::span<const std::optional<MinMax>> rows, double top,
               const ImVec4& colour);

enum class Corner { upper_left, upper_right, lower_left, lower_right };
void plot_text(const PlotArea& area, Corner corner, const std::string& text, const ImVec4& colour);

[[nodiscard]] inline std::size_t whole_px(float px) {
  return px > 1.0f ? static_cast<std::size_t>(px) : 1;
}

}  // namespace clay::studio
