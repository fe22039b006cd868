#pragma once
// The tree of strokes as blocks along a time line: what the panel draws and is clicked on.

#include "app/history/work.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace clay::studio {

/// One stroke, between two moments of the time that was thrown up to it. A stroke shorter than
/// kShortestBlockS is drawn as if it had lasted that long, so that it can be hit.
struct TimelineBlock {
  history::NodeId node = 0;
  double from_s = 0.0, to_s = 0.0;
  std::size_t row = 0;         ///< 0: the line that undo and redo go along
  std::size_t parent_row = 0;  ///< where it branches off
  bool done = false;           ///< it has made the present pot what it is
};

inline constexpr double kShortestBlockS = 0.4;

struct Timeline {
  std::vector<TimelineBlock> blocks;  ///< one for each stroke, by rising node
  std::size_t rows = 1;
  double seconds = 0.0;  ///< of the longest way
};

/// Every other branch has a row of its own as far as it goes without branching again.
[[nodiscard]] Timeline timeline_of(const history::Work& work);

/// The block at a moment of a row.
[[nodiscard]] std::optional<TimelineBlock> block_at(const Timeline& timeline, double seconds,
                                                    std::size_t row);

}  // namespace clay::studio
