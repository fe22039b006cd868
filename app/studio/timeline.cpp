#include "app/studio/timeline.hpp"

#include <algorithm>

namespace clay::studio {
namespace {

/// Nodes on the way that undo and redo take: up from where the work is, and on to the last branch
/// that was taken.
std::vector<char> main_line(const history::Work& work) {
  std::vector<char> on(work.size(), 0);
  const auto& nodes = work.record().nodes;
  for (history::NodeId node = work.at(); node != 0; node = nodes[node].parent) on[node] = 1;
  for (history::NodeId node = nodes[work.at()].taken; node != 0; node = nodes[node].taken)
    on[node] = 1;
  return on;
}

}  // namespace

Timeline timeline_of(const history::Work& work) {
  const std::vector<char> line = main_line(work);
  std::vector<char> done(work.size(), 0);
  for (history::NodeId node = work.at(); node != 0; node = work.record().nodes[node].parent)
    done[node] = 1;
  Timeline timeline;
  std::vector<TimelineBlock> of(work.size());
  std::vector<char> row_goes_on(work.size(), 0);  // a child has its row already
  row_goes_on[0] = 1;
  for (history::NodeId node = 1; node < work.size(); ++node) {  // parents come first
    const history::NodeView view = work.view(node);
    TimelineBlock& block = of[node];
    block.node = node;
    block.from_s = of[view.parent].to_s;
    block.to_s = block.from_s + std::max(view.seconds, kShortestBlockS);
    block.parent_row = of[view.parent].row;
    block.done = done[node] != 0;
    if (line[node] != 0) {
      block.row = 0;
    } else if (block.parent_row > 0 && row_goes_on[view.parent] == 0) {
      block.row = block.parent_row;
      row_goes_on[view.parent] = 1;
    } else {
      block.row = timeline.rows++;
    }
    timeline.seconds = std::max(timeline.seconds, block.to_s);
    timeline.blocks.push_back(block);
  }
  return timeline;
}

std::optional<TimelineBlock> block_at(const Timeline& timeline, double seconds, std::size_t row) {
  const auto found = std::ranges::find_if(timeline.blocks, [&](const TimelineBlock& block) {
    return block.row == row && seconds >= block.from_s && seconds < block.to_s;
  });
  if (found == timeline.blocks.end()) return std::nullopt;
  return *found;
}

}  // namespace clay::studio
