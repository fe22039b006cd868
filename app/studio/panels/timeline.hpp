#pragma once
// The timeline over the foot of the view: one row of cards, one for each stroke, with the pot after
// that stroke. A click selects the end of a stroke; a drag shows the pot at a moment within it; a
// menu leads to the other branches.

#include "app/history/work.hpp"
#include "app/studio/action.hpp"
#include "app/studio/view_model.hpp"

#include <vector>

namespace clay::studio {

/// A stroke on the path of undo and redo.
struct TimelineCard {
  history::NodeId node = 0;
  bool done = false;                    ///< part of the current pot
  std::vector<history::NodeId> others;  ///< further strokes on the same pot: the other branches
};

/// The path from the first stroke to the last that redo reaches.
[[nodiscard]] std::vector<TimelineCard> timeline_of(const history::Work& work);

/// Its height [px], which depends on the font only; 0 without a work, or in a low view. The view
/// keeps the space free before the first stroke too, so that the pot does not move with it.
[[nodiscard]] float timeline_height(const ViewModel& model, glm::vec2 room_px);
void draw_timeline(const ViewModel& model, Actions& actions, glm::vec2 corner_px,
                   glm::vec2 size_px);

}  // namespace clay::studio
