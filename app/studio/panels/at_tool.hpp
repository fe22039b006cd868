#pragma once
// The figures at the tool, and their place.

#include "app/render/picture.hpp"
#include "app/studio/view_model.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace clay::studio {

/// One line for each figure: of a pot upside down the floor, the radius and the way from the foot.
[[nodiscard]] std::vector<std::string> figures_at(const ViewModel& model,
                                                  const render::ToolView& tool);

/// From left to right, or from top to bottom [px].
struct Span {
  float low = 0.0f, high = 0.0f;
};

/// The left edge of a box of this width at the height of the tool: beside the tool and the pot, at
/// the right if there is room; in a narrow view beside the tool alone.
[[nodiscard]] inline float place_beside(const Span& tool, const Span& pot, const Span& view,
                                        float width, float gap) {
  const auto fits = [&](float left) {
    return left >= view.low + gap && left + width + gap <= view.high;
  };
  const float left_of_tool = tool.low - gap - width, right_of_tool = tool.high + gap;
  const float left_of_both = std::min(left_of_tool, pot.low - gap - width);
  const float right_of_both = std::max(right_of_tool, pot.high + gap);
  if (tool.high < pot.low && fits(left_of_tool)) return left_of_tool;
  if (fits(right_of_both)) return right_of_both;
  if (tool.low <= pot.high && fits(left_of_both)) return left_of_both;
  return fits(right_of_tool) ? right_of_tool : left_of_tool;
}

/// The upper edge of a box of this height: as wanted, but within the view as far as it fits.
[[nodiscard]] inline float place_within(float wanted, const Span& view, float height, float gap) {
  return std::max(view.low + gap, std::min(wanted, view.high - gap - height));
}

}  // namespace clay::studio
