#pragma once
// The timeline below the view: the tree of strokes as blocks. A click selects the end of a stroke;
// a drag shows the pot at a moment within it.

#include "app/history/work.hpp"
#include "app/studio/action.hpp"
#include "app/studio/view_model.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace clay::studio {

/// One stroke, between two times since the start. A stroke shorter than kShortestBlockS is drawn
/// with that length, so that it can be clicked.
struct TimelineBlock {
  history::NodeId node = 0;
  double from_s = 0.0, to_s = 0.0;
  std::size_t row = 0;         ///< 0: the path of undo and redo
  std::size_t parent_row = 0;  ///< row of the parent stroke
  bool done = false;           ///< part of the current pot
};

inline constexpr double kShortestBlockS = 0.4;

struct Timeline {
  std::vector<TimelineBlock> blocks;  ///< one per stroke, sorted by node
  std::size_t rows = 1;
  double seconds = 0.0;  ///< length of the longest branch
};

/// Each further branch gets its own row until it branches again.
[[nodiscard]] Timeline timeline_of(const history::Work& work);

/// The block at this time in this row.
[[nodiscard]] std::optional<TimelineBlock> block_at(const Timeline& timeline, double seconds,
                                                    std::size_t row);

/// Height of the timeline below a view of this size; 0 if there is no work or no space.
[[nodiscard]] float timeline_height(const ViewModel& model, glm::vec2 room_px);
void draw_timeline(const ViewModel& model, Actions& actions, glm::vec2 corner_px,
                   glm::vec2 size_px);

}  // namespace clay::studio
