#include "app/history/work.hpp"

#include "app/history/split.hpp"
#include "claystack/engine/files.hpp"
#include "tests/app/history/strokes.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace clay::history {
namespace {

using test::arbitrary_work;
using test::plainly_thrown;
using test::press_stroke;
using test::small_scene;

/// Presses, separated by this time in free air.
std::vector<Pose> recording(int presses, double air_s, bool level = false) {
  std::vector<Pose> poses;
  std::int64_t time_us = 5000;
  for (int press = 0; press < presses; ++press) {
    for (Pose pose : press_stroke(static_cast<std::uint64_t>(10 + press))) {
      if (level) pose.position_mm.y = 15.0;
      pose.time_us = time_us += 1000;
      poses.push_back(pose);
    }
    for (int i = 0; i < static_cast<int>(1000.0 * air_s); ++i) {
      Pose pose = poses.back();
      pose.time_us = time_us += 1000;
      if (!level) pose.position_mm.y += 1.0 / 1024.0;
      poses.push_back(pose);
    }
  }
  return poses;
}

RC_GTEST_PROP(Work, EveryPotEqualsTheReplayOfItsStrokes, ()) {
  Work work = arbitrary_work(*rc::gen::inRange(1, 20));
  if (*rc::gen::arbitrary<bool>())
    work = Work::open(WorkRecord(work.record()), 1).value();  // keeps one pot only
  RC_ASSERT(**work.pot() == plainly_thrown(work.record(), work.at()));
  const auto node = *rc::gen::inRange<std::size_t>(0, work.size());
  RC_ASSERT(**work.pot(node) == plainly_thrown(work.record(), node));
}

TEST(Work, RefusesMorePosesThanAFileHolds) {
  WorkRecord record;
  record.scenes = {small_scene()};
  record.nodes.resize(1);
  record.nodes.push_back({0, 0, std::vector<Pose>(kMaxPoses - 50), 0});
  Work work = Work::open(std::move(record)).value();
  const auto refused = [](const Error& error) {
    EXPECT_EQ(error.message,
              "expected at most 10000000 poses in one work, found more: begin a new work with its "
              "pot");
  };
  const auto poses = press_stroke(1);
  const auto added = work.add(small_scene(), poses);
  ASSERT_FALSE(added);
  refused(added.error());
  EXPECT_EQ(work.size(), 2u);

  PoseSink& sink = *work.begin_stroke(small_scene()).value().sink;
  std::array<bool, 50> contact{};
  contact.fill(true);
  EXPECT_TRUE(sink.append({std::span(poses).first(50), contact}));
  const auto more = sink.append({std::span(poses).subspan(50, 1), std::span(contact).first(1)});
  ASSERT_FALSE(more);
  refused(more.error());
  EXPECT_EQ(work.end_stroke().value().strokes, 1u);
  EXPECT_EQ(work.record().nodes.back().poses.size(), 50u);

  const auto full = work.begin_stroke(small_scene());
  ASSERT_FALSE(full);
  refused(full.error());
}

RC_GTEST_PROP(Work, RedoFollowsTheBranchLastTaken, ()) {
  Work work = arbitrary_work(*rc::gen::inRange(1, 20));
  const NodeId left = work.at();
  const auto way = way_to(work.record().nodes, left);
  for (std::size_t i = way.size(); i-- > 1;) {
    RC_ASSERT(work.undo());
    RC_ASSERT(work.at() == way[i - 1]);
  }
  RC_ASSERT(!work.undo());
  for (std::size_t i = 1; i < way.size(); ++i) {
    RC_ASSERT(work.redo());
    RC_ASSERT(work.at() == way[i]);
  }
}

RC_GTEST_PROP(Work, RestoresAnyMomentOfAStroke, ()) {
  Work work = Work::begin(small_scene()).value();
  (void)work.add(small_scene(), press_stroke(1)).value();
  const auto poses = press_stroke(2);
  (void)work.add(small_scene(5.0), poses).value();
  for (int i = 0; i < 4; ++i) {
    const auto count = *rc::gen::inRange<std::size_t>(1, poses.size() + 1);
    const auto part =
        std::vector(poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(count));
    const Pot expected = plainly_thrown(small_scene(5.0), **work.pot(1), part);
    RC_ASSERT(work.scrub(2, static_cast<double>(part.back().time_us) / 1e6).value() == expected);
  }
}

/// The slider of the window ends at the seconds of the stroke.
TEST(Work, TheLastMomentOfAStrokeIsItsPot) {
  auto poses = press_stroke(1);
  for (std::int64_t late_us = 0; late_us < 20; ++late_us) {
    poses.back().time_us += 1;
    Work work = Work::begin(small_scene()).value();
    (void)work.add(small_scene(), poses).value();
    const double seconds = work.view(1).seconds;
    EXPECT_EQ(work.scrub(1, seconds).value(), **work.pot(1)) << poses.back().time_us;
    EXPECT_EQ(work.branch(1, seconds)->strokes, 0u) << poses.back().time_us;
  }
}

RC_GTEST_PROP(Work, BranchesFromAMomentAndKeepsTheStroke, ()) {
  Work work = Work::begin(small_scene()).value();
  (void)work.add(small_scene(), press_stroke(1)).value();
  const auto poses = press_stroke(2);
  (void)work.add(small_scene(5.0), poses).value();
  const Pot whole = **work.pot(2);
  const auto count = *rc::gen::inRange<std::size_t>(1, poses.size() + 1);
  const double seconds = static_cast<double>(poses[count - 1].time_us) / 1e6;
  const Pot shown = work.scrub(2, seconds).value();
  const Added added = work.branch(2, seconds).value();
  RC_ASSERT(**work.pot() == shown);
  RC_ASSERT(**work.pot(2) == whole);
  if (count == poses.size()) {
    RC_ASSERT(added.strokes == 0u && work.at() == 2u);
  } else {
    RC_ASSERT(added.node == 3u && work.at() == 3u && work.view(3).parent == 1u);
    RC_ASSERT(plainly_thrown(work.record(), 3) == shown);
    RC_ASSERT(work.undo() && work.at() == 1u && work.redo() && work.at() == 3u);
  }
}

TEST(Work, RefusesStrokesOnACollapsedRoot) {
  Pot fallen = Wheel::build(small_scene()).value().pot();
  fallen.collapse = Collapse{10, {30.0, 10.0, 0.0}, {0.0, 0.0, 1.0}, 1.0, 12.0};
  Work work = Work::begin(small_scene(), fallen).value();
  EXPECT_EQ(**work.pot(), fallen);
  const auto added = work.add(small_scene(), press_stroke(1));
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().message, "pot: expected a standing pot, found a collapsed one");
  const test::ScratchFolder folder;
  ASSERT_TRUE(work.save(folder.file("fallen.work")));
  auto again = load(folder.file("fallen.work"));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(**again->work.pot(), fallen);
  const Pot rounded = rounded_pot(fallen, 0.01).value();
  ASSERT_TRUE(Work::begin(small_scene(), rounded)->save(folder.file("rounded.work")));
  again = load(folder.file("rounded.work"));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(**again->work.pot(), rounded);
  SceneSpec bad = small_scene();
  bad.flow.inside_share = 2.0;
  EXPECT_FALSE(Work::begin(bad, fallen));
}

TEST(Work, ListsItsStrokes) {
  Work work = Work::begin(small_scene()).value();
  EXPECT_FALSE(work.can_undo());
  (void)work.add(small_scene(), press_stroke(1)).value();
  work.undo();
  (void)work.add(small_scene(8.0, ToolMode::trim), press_stroke(1)).value();
  const auto air = std::vector<Pose>{{0, {90.0, 5.0, 0.0}, false, 0.0},
                                     {1'000'000, {90.0, 15.0, 0.0}, false, 0.0}};
  (void)work.add(small_scene(), air).value();
  EXPECT_EQ(work.view(0).children, (std::vector<NodeId>{1, 2}));
  EXPECT_EQ(work.view(2).children, std::vector<NodeId>{3});
  EXPECT_EQ(work.view(3).parent, 2u);
  EXPECT_TRUE(work.view(1).changed.value());
  EXPECT_DOUBLE_EQ(work.view(1).volume_mm3.value(), work.view(0).volume_mm3.value());
  EXPECT_LT(work.view(2).volume_mm3.value(), work.view(1).volume_mm3.value());
  EXPECT_EQ(work.view(2).scene->tool.mode, ToolMode::trim);
  EXPECT_FALSE(work.view(3).changed.value());
  EXPECT_DOUBLE_EQ(work.view(3).seconds, 1.0);
}

TEST(Work, KeepsThePotOfTheWheelWithoutPlayingThePosesAgain) {
  Work work = Work::begin(small_scene()).value();
  Begun begun = work.begin_stroke(small_scene()).value();
  test::record(press_stroke(1), *begun.sink);
  for (const Pose& pose : press_stroke(1)) begun.wheel.step(pose);
  EXPECT_EQ(work.end_stroke(begun.wheel.pot()).value().strokes, 1u);
  EXPECT_EQ(**work.pot(), plainly_thrown(work.record(), 1)) << "the wheel is the replay's";

  // A pot that the poses do not make would be kept as well.
  work.undo();
  test::record(press_stroke(2), *work.begin_stroke(small_scene()).value().sink);
  const Pot other = begun.wheel.pot();
  EXPECT_TRUE(work.end_stroke(other));
  EXPECT_EQ(**work.pot(), other);
}

TEST(Work, SplitsByTheContactsThatTheServoReports) {
  const auto poses = recording(3, 0.4);
  Work work = Work::begin(small_scene()).value();
  Begun begun = work.begin_stroke(small_scene()).value();
  for (const Pose& pose : poses) {
    const bool contact = (begun.wheel.step(pose).flags & kContact) != 0;
    ASSERT_TRUE(begun.sink->append({std::span(&pose, 1), std::span(&contact, 1)}));
  }
  EXPECT_EQ(work.end_stroke(begun.wheel.pot()).value().strokes, 3u);
  EXPECT_EQ(**work.pot(), begun.wheel.pot());
  for (NodeId node = 1; node < work.size(); ++node)
    EXPECT_EQ(*work.pot(node).value(), plainly_thrown(work.record(), node)) << node;
}

TEST(Work, KeepsAPressOfTheMouseAsOneStroke) {
  Work work = Work::begin(small_scene()).value();
  Begun begun = work.begin_stroke(small_scene()).value();
  for (const Pose& pose : recording(3, 0.4)) {
    const bool contact = (begun.wheel.step(pose).flags & kContact) != 0;
    ASSERT_TRUE(begun.sink->append({std::span(&pose, 1), std::span(&contact, 1)}));
  }
  EXPECT_EQ(work.end_stroke(begun.wheel.pot(), Recording::one_stroke).value().strokes, 1u);
  EXPECT_EQ(**work.pot(), begun.wheel.pot());
}

TEST(Work, IgnoresAStrokeInFreeAirAndCanStillRedo) {
  Work work = Work::begin(small_scene()).value();
  (void)work.add(small_scene(), press_stroke(1)).value();
  work.undo();
  test::record(press_stroke(2), *work.begin_stroke(small_scene()).value().sink, false);
  EXPECT_EQ(work.end_stroke().value().strokes, 0u);
  EXPECT_FALSE(work.in_stroke());
  EXPECT_EQ(work.size(), 2u);
  ASSERT_TRUE(work.redo());
  EXPECT_EQ(work.at(), 1u);
}

TEST(Work, IgnoresAStrokeWithoutPoses) {
  Work work = Work::begin(small_scene()).value();
  EXPECT_EQ(work.add(small_scene(), {}).value().strokes, 0u);
  EXPECT_EQ(work.size(), 1u);
}

TEST(Work, RefusesAStrokeThatDoesNotFitThePot) {
  Work work = Work::begin(small_scene()).value();
  SceneSpec paper = small_scene();
  paper.model = Model::paper;
  const auto added = work.add(paper, press_stroke(1));
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().message, "model: expected the pot's, conserving, found paper");
  EXPECT_FALSE(work.in_stroke());
}

TEST(Work, RoundTripsThroughAFile) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("mine.work");
  Work work = Work::begin(small_scene()).value();
  EXPECT_FALSE(work.unsaved());
  (void)work.add(small_scene(), press_stroke(1)).value();
  EXPECT_TRUE(work.unsaved());
  (void)work.add(small_scene(5.0), press_stroke(2)).value();
  work.undo();
  ASSERT_TRUE(work.save(path));
  EXPECT_FALSE(work.unsaved());
  auto loaded = load(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_FALSE(loaded->torn);
  EXPECT_FALSE(loaded->work.unsaved());
  EXPECT_EQ(loaded->work.at(), 1u);
  EXPECT_EQ(**loaded->work.pot(), **work.pot());
  EXPECT_TRUE(loaded->work.redo());
  EXPECT_TRUE(loaded->work.unsaved());
  work.redo();
  EXPECT_EQ(**loaded->work.pot(), **work.pot());
}

TEST(Work, StartsFromAPot) {
  Work first = Work::begin(small_scene()).value();
  (void)first.add(small_scene(), press_stroke(1)).value();
  Work second = Work::begin(small_scene(), **first.pot()).value();
  (void)second.add(small_scene(5.0), press_stroke(2)).value();
  (void)first.add(small_scene(5.0), press_stroke(2)).value();
  EXPECT_EQ(**second.pot(), **first.pot());
  const auto read = parse_work(write_work(second.record()), "w").value();
  EXPECT_EQ(read.work.start, second.record().start);
}

Split cut(const Pot& before, const std::vector<Pose>& poses) {
  Wheel wheel = Wheel::build(small_scene(), before).value();
  return split(small_scene(), before, poses, replay(std::move(wheel), poses));
}

TEST(Split, SplitsARecordingInFreeAir) {
  const Pot lump = Wheel::build(small_scene()).value().pot();
  const auto poses = recording(4, 0.4);
  const Split parts = cut(lump, poses);
  ASSERT_EQ(parts.begins.size(), 3u);
  EXPECT_EQ(parts.pots.back(), plainly_thrown(small_scene(), lump, poses));
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = poses[parts.begins[i]].position_mm.x;
    EXPECT_GT(x, 40.0) << "in the air";
    EXPECT_NE(parts.pots[i], parts.pots[i + 1]);
  }
}

TEST(Split, KeepsAnUnsplittableRecordingWhole) {
  const Pot lump = Wheel::build(small_scene()).value().pot();
  // The motion of the strokes in free air takes less than 0.1 s.
  EXPECT_TRUE(cut(lump, recording(3, 0.1)).begins.empty());
  EXPECT_TRUE(cut(lump, recording(3, 0.4, true)).begins.empty())
      << "a stroke has no earlier direction of the tool";
  Work work = Work::begin(small_scene()).value();
  EXPECT_EQ(work.add(small_scene(), recording(3, 0.4)).value().strokes, 1u) << "poses from a file";
}

RC_GTEST_PROP(Split, NeverChangesThePot, ()) {
  const Pot lump = Wheel::build(small_scene()).value().pot();
  const auto poses = recording(*rc::gen::inRange(1, 5), *rc::gen::element(0.2, 0.3, 0.5),
                               *rc::gen::arbitrary<bool>());
  const Split parts = cut(lump, poses);
  RC_ASSERT(parts.pots.size() == parts.begins.size() + 1);
  RC_ASSERT(parts.pots.back() == plainly_thrown(small_scene(), lump, poses));
}

TEST(PotCache, EvictsTheLeastRecentlyUsed) {
  const auto pot = std::make_shared<const Pot>(Wheel::build(small_scene()).value().pot());
  PotCache cache(3 * (sizeof(Pot) + 30 * sizeof(Ring)));
  for (const std::size_t node : {1u, 2u, 3u}) cache.put(node, pot);
  EXPECT_NE(cache.find(1), nullptr);
  cache.put(4, pot);
  EXPECT_EQ(cache.find(2), nullptr);
  EXPECT_NE(cache.find(1), nullptr);
  EXPECT_EQ(cache.size(), 3u);
}

TEST(PotCache, CountsAPotThatIsPutAgainOnce) {
  const auto pot = std::make_shared<const Pot>(Wheel::build(small_scene()).value().pot());
  PotCache cache(3 * (sizeof(Pot) + 30 * sizeof(Ring)));
  for (const std::size_t node : {1u, 2u, 3u, 3u, 3u}) cache.put(node, pot);
  EXPECT_EQ(cache.size(), 3u);
}

TEST(PotCache, KeepsTheNewestPotWithoutAnyMemory) {
  const auto pot = std::make_shared<const Pot>(Wheel::build(small_scene()).value().pot());
  PotCache cache(0);
  for (const std::size_t node : {1u, 2u}) cache.put(node, pot);
  EXPECT_EQ(cache.size(), 1u);
  EXPECT_NE(cache.find(2), nullptr);
}

}  // namespace
}  // namespace clay::history
