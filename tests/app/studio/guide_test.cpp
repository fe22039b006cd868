// The guide: its plans are those of the strokes, its demonstration throws a printable pot, and a
// newcomer who follows it throws one, too.

#include "app/studio/guide/guide.hpp"

#include "app/render/pot_view.hpp"
#include "app/studio/app_state.hpp"
#include "app/studio/new_scene.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"
#include "tests/app/studio/first_timer.hpp"
#include "tests/app/studio/timed_host.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace clay::studio {
namespace {

constexpr std::size_t kCylinder = 3;

/// Rows of 1 mm of a pipe.
render::PotView pipe(float outer_mm, float inner_mm, std::size_t rows) {
  render::PotView pot;
  pot.rows.assign(rows, {outer_mm, inner_mm});
  pot.height_mm = static_cast<double>(rows);
  return pot;
}

TEST(Guide, DifferenceIsTheAreaThatOnlyOneSectionHas) {
  const render::PotView pot = pipe(40.0f, 30.0f, 50);
  EXPECT_EQ(difference_mm2(pot, pot), 0.0);
  EXPECT_NEAR(difference_mm2(pot, pipe(42.0f, 30.0f, 50)), 2.0 * 50.0, 1e-3);
  EXPECT_NEAR(difference_mm2(pot, pipe(42.0f, 33.0f, 50)), 5.0 * 50.0, 1e-3);
  EXPECT_NEAR(difference_mm2(pot, pipe(40.0f, 30.0f, 60)), 10.0 * 10.0, 1e-3);
  EXPECT_NEAR(difference_mm2(pot, pipe(20.0f, 10.0f, 50)), 20.0 * 50.0, 1e-3) << "apart";
}

TEST(Guide, ThePathOfTheFirstStepOpensTheLump) {
  const Sample& sample = samples()[kCylinder];
  const auto scene = scene_of(sample).value();
  const auto pot = std::make_shared<const Pot>(Wheel::build(scene)->pot());
  const auto script = std::make_shared<const strokes::StrokeScript>(
      strokes::parse_strokes(sample.strokes_text, sample.name).value());
  const LessonPlan plan = plan_step({script, scene, pot, 0, 0, 1});
  ASSERT_GT(plan.path.size(), 10u);
  EXPECT_EQ(plan.mode, ToolMode::press);
  const double radius_mm = std::get<SphereSpec>(scene.tool.shape).radius_mm;
  EXPECT_GT(plan.path.front().at_mm.y, pot->stack.height_mm() + radius_mm - 0.5) << "in the air";
  double lowest = 1e9;
  for (const PathPoint& point : plan.path) lowest = std::min(lowest, point.at_mm.y);
  EXPECT_NEAR(lowest, script->strokes[0].through_mm[4].y, 0.5) << "the script's lowest point";
  EXPECT_NEAR(plan.left_mm2, difference_mm2(render::view_of(*pot), plan.after), 1e-9);
  EXPECT_GT(plan.left_mm2, 100.0);
}

TEST(Guide, APinchIsPlannedWithItsGap) {
  const Sample& sample = samples()[kCylinder];
  const auto scene = scene_of(sample).value();
  const auto script = std::make_shared<const strokes::StrokeScript>(
      strokes::parse_strokes(sample.strokes_text, sample.name).value());
  const auto pot = std::make_shared<const Pot>(finished_pot(sample).value());
  const LessonPlan plan = plan_step({script, scene, pot, 7, 5, 1});
  EXPECT_EQ(plan.mode, ToolMode::pinch);
  EXPECT_DOUBLE_EQ(plan.gap_mm, 5.0);
  ASSERT_FALSE(plan.path.empty());
  EXPECT_GT(plan.path.back().at_mm.y, pot->stack.height_mm()) << "over the rim";
  EXPECT_EQ(plan.node, 7u);
}

class Lesson : public ::testing::Test {
 protected:
  void frames(int count) {
    for (int i = 0; i < count && !state.guide.finished(); ++i) {
      host.advance();
      update(state);
    }
  }
  test::TimedHost host;
  AppState state{host, Settings{}, [](std::string_view) {}};
};

TEST_F(Lesson, TheDemonstrationThrowsAPotThatIsReadyToPrint) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, BeginLesson{kCylinder, true});
  frames(60 * 180);
  ASSERT_TRUE(state.guide.finished()) << "at step " << state.guide.step();
  const PotCheck check =
      check_pot({{state.document.shared_pot(), state.document.view()}, state.settings.process});
  EXPECT_TRUE(check.ready()) << ready_text(check, LengthUnit::mm);
  const double sample_mm = finished_pot(samples()[kCylinder])->stack.height_mm();
  EXPECT_NEAR(state.document.pot().stack.height_mm(), sample_mm, 0.15 * sample_mm);
  // The demonstrated strokes stay as a branch, and the user begins with the lump.
  const std::size_t strokes = state.document.work().size();
  apply(state, YourTurn{});
  EXPECT_EQ(state.document.work().at(), 0u);
  EXPECT_EQ(state.document.work().size(), strokes);
  EXPECT_EQ(state.guide.step(), 0u);
}

/// The tool stays in the plane of the demonstration: another view does not pull it through the pot.
TEST_F(Lesson, ADemonstrationCanBeWatchedFromAnySide) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, BeginLesson{kCylinder, true});
  int waited = 0;
  while (!state.stroke.throwing() && ++waited < 600) frames(1);
  frames(60);
  ASSERT_TRUE(state.stroke.throwing());
  apply(state, LookFrom{ViewFrom::right});
  double most_mm = 0.0;
  for (; state.stroke.throwing(); frames(1))
    most_mm = std::max(most_mm, std::abs(state.stroke.status().tool_mm.z));
  EXPECT_LT(most_mm, 1.0) << "the plane of the front view";
}

TEST_F(Lesson, AnotherPotEndsTheDemonstration) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, BeginLesson{kCylinder, true});
  ASSERT_EQ(state.guide.demonstration(), Demonstration::all);
  apply(state, BeginSample{kCylinder});
  update(state);
  EXPECT_FALSE(state.guide.active());
  EXPECT_EQ(state.guide.demonstration(), Demonstration::none);
}

/// A frame of a real host is older than a stroke that begins in it.
TEST_F(Lesson, FingersDoNotOpenInTheFrameInWhichTheyTakeTheWall) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, BeginWork{scene_of(samples()[kCylinder]).value(),
                         std::make_shared<const Pot>(finished_pot(samples()[kCylinder]).value()),
                         {}});
  apply(state, SetToolMode{ToolMode::pinch});
  const std::int64_t frame_ns = host.frame_ns();
  host.clock().sleep_until_ns(frame_ns + 50'000'000);
  const double wide_mm = 9.0, closed_mm = 6.0;
  ToolSpec fingers{SphereSpec{5.0}, ToolMode::pinch, closed_mm};
  ASSERT_TRUE(state.stroke.press({fingers, 120.0, {30.0, 60.0, 0.0}, wide_mm}));
  state.stroke.advance(frame_ns);
  for (int i = 0; i < 30; ++i) {
    host.advance();
    update(state);
  }
  state.stroke.release();
  const test::ScratchFolder folder;
  ASSERT_TRUE(state.document.save(folder.file("pinch.work")));
  const auto read = parse_work(test::read_text(folder.file("pinch.work")), "pinch.work");
  ASSERT_TRUE(read) << read.error().message;
  const std::vector<Pose>& poses = read->work.nodes.back().poses;
  ASSERT_GT(poses.size(), 100u);
  for (const Pose& pose : poses) ASSERT_LE(pose.gap_mm, wide_mm);
  EXPECT_NEAR(poses.back().gap_mm, closed_mm, 0.02) << "the wall leans a little";
}

/// A pull along the wall of a bowl that leans by 45 degrees, in a new work: the wall stays smooth.
TEST_F(Lesson, FingersStandOffAWallThatLeans) {
  constexpr double kH = 0.5;
  SceneSpec scene = lump_of(1.0, 40.0);
  scene.tool = {SphereSpec{10.0}, ToolMode::pinch, 6.0};
  std::vector<Ring> rings(16, Ring{quanta_from_radius(32.0), 0});
  for (double up = 8.0 + 0.5 * kH; up < 62.0; up += kH)
    rings.push_back({quanta_from_radius(24.0 + up), quanta_from_radius(15.5 + up)});
  Pot bowl;
  bowl.stack = ClayStack::from_rings(kH, std::move(rings), 0).value();
  bowl.density_g_cm3 = scene.lump.density_g_cm3;
  bowl.ledger.initial = bowl.stack.volume();
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, BeginWork{scene, std::make_shared<const Pot>(bowl), {}});
  ASSERT_TRUE(state.stroke.press({scene.tool, 120.0, {41.75, 22.0, 0.0}, 18.0}));
  for (int i = 0; i <= 90; ++i) {
    const double on = 0.55 * i;
    state.stroke.aim({{41.75 + on, 22.0 + on, 0.0}, kPressingMmPerS, 8.0});
    host.advance();
    update(state);
  }
  state.stroke.release();
  const auto& after = state.document.pot().stack;
  double steepest = 0.0;
  for (std::size_t i = 17; i < after.size(); ++i)
    for (const auto radius : {&Ring::outer_mm, &Ring::inner_mm})
      steepest = std::max(
          steepest, std::abs((after.rings()[i].*radius)() - (after.rings()[i - 1].*radius)()) / kH);
  EXPECT_LT(steepest, 3.0);
}

TEST_F(Lesson, UndoGoesBackToTheStepOfThePot) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, BeginLesson{kCylinder, true});
  while (state.guide.step() == 0 && host.frame_ns() < 60'000'000'000) frames(1);
  ASSERT_EQ(state.guide.step(), 1u);
  apply(state, StopShowing{});
  apply(state, Undo{});
  frames(2);
  EXPECT_EQ(state.guide.step(), 0u);
  apply(state, Redo{});
  frames(2);
  EXPECT_EQ(state.guide.step(), 1u);
}

TEST_F(Lesson, AStepSelectsItsToolAndAPressEndsTheDemonstration) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  state.settings.tool.mode = ToolMode::wire;
  apply(state, BeginLesson{kCylinder, false});
  frames(2);
  EXPECT_EQ(state.settings.tool.mode, ToolMode::press);
  for (int step = 0; step < 3; ++step) {
    apply(state, NextStep{});
    frames(2);
  }
  EXPECT_EQ(state.settings.tool.mode, ToolMode::pinch);
  apply(state, ShowStep{});
  EXPECT_EQ(state.guide.demonstration(), Demonstration::step);
  apply(state, StopShowing{});
  EXPECT_EQ(state.guide.demonstration(), Demonstration::none);
}

TEST_F(Lesson, AStepIsSkippedIfItHasNoStroke) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, BeginLesson{kCylinder, true});
  while (state.guide.step() == 0 && host.frame_ns() < 60'000'000'000) frames(1);
  ASSERT_EQ(state.guide.step(), 1u);
  apply(state, StopShowing{});
  apply(state, NextStep{});
  EXPECT_EQ(state.guide.step(), 2u);
  EXPECT_FALSE(state.guide.skipped(0)) << "it was shown";
  EXPECT_TRUE(state.guide.skipped(1));
  EXPECT_EQ(state.guide.skipped_steps(), 1u);
}

/// The stroke ends with its step; the pot keeps the change so far.
TEST_F(Lesson, NextStepEndsTheStrokeThatIsShown) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, BeginLesson{kCylinder, true});
  while (!state.stroke.status().contact && host.frame_ns() < 60'000'000'000) frames(1);
  frames(30);
  ASSERT_TRUE(state.stroke.throwing());
  apply(state, NextStep{});
  EXPECT_FALSE(state.stroke.throwing());
  EXPECT_EQ(state.document.work().at(), 1u);
  EXPECT_EQ(state.guide.step(), 1u);
  EXPECT_FALSE(state.guide.skipped(0)) << "it has a stroke";
  const auto next = [&] { return state.stroke.throwing() || host.frame_ns() > 60'000'000'000; };
  while (!next()) frames(1);
  EXPECT_TRUE(state.stroke.throwing()) << "the stroke of the next step is shown";
  EXPECT_EQ(state.guide.step(), 1u);
}

/// On a finished pot, as far as the sample needs no stroke there.
TEST_F(Lesson, AStepWithoutAChangeIsLeftOut) {
  const Sample& sample = samples()[kCylinder];
  apply(state, BeginWork{scene_of(sample).value(),
                         std::make_shared<const Pot>(finished_pot(sample).value()),
                         {}});
  ASSERT_TRUE(state.guide.begin(sample, Demonstration::none));
  std::size_t left_out = 0;
  while (!state.guide.finished()) {
    frames(20);
    if (state.guide.finished()) break;
    EXPECT_FALSE(state.guide.left_out(state.guide.step()));
    apply(state, NextStep{});
  }
  for (std::size_t i = 0; i < state.guide.steps(); ++i) {
    EXPECT_NE(state.guide.left_out(i), state.guide.skipped(i)) << i;
    if (state.guide.left_out(i)) ++left_out;
  }
  EXPECT_GT(left_out, 0u);
}

/// Skipping to the end is not the end of the way back.
TEST_F(Lesson, UndoGoesBackFromTheEnd) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, BeginLesson{kCylinder, true});
  while (state.guide.step() == 0 && host.frame_ns() < 60'000'000'000) frames(1);
  apply(state, StopShowing{});
  while (!state.guide.finished()) apply(state, NextStep{});
  host.advance();
  update(state);
  ASSERT_TRUE(state.guide.finished());
  apply(state, Undo{});
  frames(2);
  host.advance();
  update(state);
  EXPECT_FALSE(state.guide.finished());
  EXPECT_EQ(state.guide.step(), 0u);
  EXPECT_EQ(state.guide.skipped_steps(), 0u);
}

TEST(Newcomer, ThrowsAPotByFollowingThePath) {
  const test::FirstPot pot = test::throw_first_pot(kCylinder, 1, 2.5);
  EXPECT_TRUE(pot.finished);
  EXPECT_TRUE(pot.ready) << pot.verdict;
  EXPECT_TRUE(pot.is_pot()) << pot.capacity_ml << " of " << pot.sample_capacity_ml << " ml";
  EXPECT_LE(pot.stroke_s, 120.0);
}

}  // namespace
}  // namespace clay::studio
