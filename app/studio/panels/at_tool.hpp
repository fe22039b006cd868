#pragma once
// The place of the figures at the tool.

#include <algorithm>

namespace clay::studio {

/// From left to right [px].
struct Span {
  float low = 0.0f, high = 0.0f;
};

/// The left edge of a box of this width at the height of the tool: beside the pot and the tool, at
/// the right if there is room; in a narrow view beside the tool alone.
[[nodiscard]] inline float place_beside(const Span& tool, const Span& pot, const Span& view,
                                        float width, float gap) {
  const float left_of_both = std::min(tool.low, pot.low) - gap - width;
  const float right_of_both = std::max(tool.high, pot.high) + gap;
  const bool room_left = left_of_both >= view.low + gap;
  const bool room_right = right_of_both + width + gap <= view.high;
  if (room_left && (!room_right || tool.high < pot.low)) return left_of_both;
  if (room_right) return right_of_both;
  const float right_of_tool = tool.high + gap;
  return right_of_tool + width + gap <= view.high ? right_of_tool : tool.low - gap - width;
}

}  // namespace clay::studio
