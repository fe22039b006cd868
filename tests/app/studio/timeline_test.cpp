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

TEST(Timeline, UndoneStrokesStayUntilABranch) {
  std::vector<TimelineCard> cards = timeline_of(work_of({1, 1, -1}));
  ASSERT_EQ(cards.size(), 2u);
  EXPECT_TRUE(cards[0].done);
  EXPECT_FALSE(cards[1].done);
  EXPECT_TRUE(cards[1].others.empty());
  cards = timeline_of(work_of({1, 1, -1, 1}));
  ASSERT_EQ(cards.size(), 2u);
  EXPECT_EQ(cards[1].node, 3u) << "the new branch takes the row";
  EXPECT_EQ(cards[1].others, std::vector<history::NodeId>{2}) << "the old one is in its menu";
  EXPECT_TRUE(cards[0].others.empty());
}

RC_GTEST_PROP(Timeline, IsThePathOfUndoAndRedoAndLeadsToEveryBranch, ()) {
  const auto moves = *rc::gen::container<std::vector<int>>(12, rc::gen::element(1, 1, -1));
  const history::Work work = work_of(moves);
  const std::vector<TimelineCard> cards = timeline_of(work);
  history::NodeId before = 0;
  std::set<history::NodeId> done;
  for (const TimelineCard& card : cards) {
    RC_ASSERT(work.view(card.node).parent == before);
    RC_ASSERT(card.others.size() + 1 == work.view(before).children.size());
    if (card.done) done.insert(card.node);
    before = card.node;
  }
  RC_ASSERT(work.view(before).children.empty());
  std::set<history::NodeId> expected;
  for (history::NodeId node = work.at(); node != 0; node = work.view(node).parent)
    expected.insert(node);
  RC_ASSERT(done == expected);
}

}  // namespace
}  // namespace clay::studio
