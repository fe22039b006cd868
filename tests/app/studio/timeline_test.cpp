#include "app/studio/panels/timeline.hpp"

#include "tests/app/history/strokes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

namespace clay::studio {
namespace {

using test::press_stroke;
using test::small_scene;

history::Work work_of(const std::vector<int>& moves) {
  history::Work work = history::Work::begin(small_scene()).value();
  std::uint64_t seed = 1;
  for (const int move : moves) {
    if (move > 0)
      EXPECT_TRUE(work.add(small_scene(), press_stroke(seed++)));
    else if (move < 0)
      work.undo();
  }
  return work;
}

TEST(Timeline, ConsecutiveStrokesShareARow) {
  const history::Work work = work_of({1, 1, 1});
  const Timeline timeline = timeline_of(work);
  ASSERT_EQ(timeline.blocks.size(), 3u);
  EXPECT_EQ(timeline.rows, 1u);
  double end_s = 0.0;
  for (const TimelineBlock& block : timeline.blocks) {
    EXPECT_EQ(block.from_s, end_s);
    EXPECT_DOUBLE_EQ(block.to_s - block.from_s,
                     std::max(kShortestBlockS, work.view(block.node).seconds));
    EXPECT_TRUE(block.done);
    end_s = block.to_s;
  }
  EXPECT_EQ(timeline.seconds, end_s);
}

TEST(Timeline, UndoneStrokesKeepTheirRowUntilABranch) {
  Timeline timeline = timeline_of(work_of({1, 1, -1}));
  EXPECT_EQ(timeline.rows, 1u);
  EXPECT_TRUE(timeline.blocks[0].done);
  EXPECT_FALSE(timeline.blocks[1].done);
  timeline = timeline_of(work_of({1, 1, -1, 1}));
  EXPECT_EQ(timeline.rows, 2u);
  EXPECT_EQ(timeline.blocks[1].row, 1u);
  EXPECT_EQ(timeline.blocks[1].parent_row, 0u);
  EXPECT_EQ(timeline.blocks[2].row, 0u);
  EXPECT_EQ(timeline.blocks[1].from_s, timeline.blocks[2].from_s);
}

RC_GTEST_PROP(Timeline, BlocksDoNotOverlapAndEachIsFoundAtItsPlace, ()) {
  const auto moves = *rc::gen::container<std::vector<int>>(12, rc::gen::element(1, 1, -1));
  const history::Work work = work_of(moves);
  const Timeline timeline = timeline_of(work);
  RC_ASSERT(timeline.blocks.size() + 1 == work.size());
  for (const TimelineBlock& block : timeline.blocks) {
    RC_ASSERT(block.row < timeline.rows);
    const auto found = block_at(timeline, 0.5 * (block.from_s + block.to_s), block.row);
    RC_ASSERT(found.has_value());
    RC_ASSERT(found->node == block.node);
  }
  std::set<history::NodeId> before;
  for (history::NodeId node = work.at(); node != 0; node = work.view(node).parent)
    before.insert(node);
  for (const TimelineBlock& block : timeline.blocks)
    RC_ASSERT(block.done == before.contains(block.node));
}

}  // namespace
}  // namespace clay::studio
