// Actions on the state of the window, without a window: their changes, and the questions before
// them.

#include "tests/app/studio/actions.hpp"
#include "app/studio/app_state.hpp"
#include "app/studio/commands.hpp"
#include "app/studio/new_scene.hpp"
#include "tests/support/run_program.hpp"

#include "app/history/journal.hpp"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>

namespace clay::studio {
namespace {

using test::small_scene;

TEST_F(ActionsTest, ADialogReplacesThePreviousOne) {
  EXPECT_TRUE(state.ui.shows<NoDialog>());
  apply(state, ShowDialog{DialogKind::settings});
  EXPECT_TRUE(state.ui.shows<SettingsDialog>());
  apply(state, SetMaterial{*find_material("celadon")});
  apply(state, ShowDialog{DialogKind::export_files});
  EXPECT_TRUE(state.ui.shows<ExportDialog>());
  EXPECT_EQ(state.ui.exporting.choices.material, "celadon") << "the glaze that the window shows";
  apply(state, ShowDialog{DialogKind::open_file});
  EXPECT_TRUE(state.ui.shows<OpenDialog>());
  apply(state, EditPath{"somewhere"});
  EXPECT_EQ(std::get<OpenDialog>(state.ui.dialog).path, "somewhere");
  apply(state, CloseDialog{});
  EXPECT_TRUE(state.ui.shows<NoDialog>());
}

TEST_F(ActionsTest, AGapCanBeAPartOfTheWall) {
  // A cup with a wall of 6 mm.
  SceneSpec scene = small_scene();
  std::vector<Ring> rings(120, Ring{quanta_from_radius(40.0), 0});
  for (std::size_t i = 20; i < rings.size(); ++i) rings[i].inner2 = quanta_from_radius(34.0);
  Pot cup;
  cup.stack = ClayStack::from_rings(0.5, std::move(rings), 0).value();
  cup.ledger.initial = cup.stack.volume();
  apply(state, BeginWork{scene, std::make_shared<const Pot>(cup), {}});
  apply(state, SetToolMode{ToolMode::pinch});
  apply(state, SetToolShape{Shape::sphere});
  state.settings.tool.sphere.radius_mm = 5.0;
  state.settings.tool.gap_share = 0.5;
  state.scene.place({{0.0f, 0.0f}, {800.0f, 600.0f}});
  Actions actions;
  state.scene.shape_from(view_model(state), {37.0, 40.0}, {}, actions);
  ASSERT_EQ(actions.size(), 1u);
  const auto& press = std::get<PressClay>(actions[0]).press;
  EXPECT_NEAR(press.tool.gap_mm.value(), 3.0, 1e-3);
  EXPECT_NEAR(std::hypot(press.place_mm.x, press.place_mm.z), 37.0, 1e-3);
  apply(state, ChangeGap{-1.0});
  EXPECT_DOUBLE_EQ(state.settings.tool.gap_share, 0.45);
}

TEST_F(ActionsTest, AnUnfoldedPanelIsScrolledTo) {
  apply(state, FoldPanel{"wheel", true});
  EXPECT_EQ(state.ui.reveal, "wheel");
  apply(state, FoldPanel{"wheel", false});
  EXPECT_EQ(state.ui.reveal, "");
}

/// In a narrow window the panels are hidden, or the diagnostics are in their place.
TEST_F(ActionsTest, APanelOutOfSightIsShown) {
  apply(state, FoldPanel{"goal", true});
  state.ui.context_shown = false;
  state.settings.open["diagnostics"] = true;
  const Command& goal = *find_command("view.goal");
  EXPECT_FALSE(goal.checked(view_model(state))) << "it is not in sight";
  apply(state, RunCommand{"view.goal"});
  EXPECT_TRUE(state.settings.open.at("goal"));
  EXPECT_TRUE(state.settings.open.at("below"));
  EXPECT_FALSE(state.settings.open.at("diagnostics"));
  EXPECT_EQ(state.ui.reveal, "goal");
  state.ui.context_shown = true;
  EXPECT_TRUE(goal.checked(view_model(state)));
  apply(state, RunCommand{"view.goal"});
  EXPECT_FALSE(state.settings.open.at("goal"));
}

/// The window is made larger, or a panel opens, while the button is held.
TEST_F(ActionsTest, TheToolStaysWhereItIsIfTheViewChangesInAStroke) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, LookFrom{ViewFrom::front});
  const double beside_mm = static_cast<double>(state.stroke.view().rows.front().outer_mm) + 20.0;
  const glm::vec2 at = state.scene.pixel_of({beside_mm, 20.0}).value();
  Actions actions;
  (void)state.scene.pointer_moved(view_model(state), {at}, actions);
  (void)state.scene.button(view_model(state), {MouseButton::left, true, kNoMods}, actions);
  apply_all(state, actions);
  ASSERT_TRUE(state.stroke.by_hand());
  state.scene.place({{0.0f, 0.0f}, {1600.0f, 1100.0f}}, 80.0f);
  (void)state.scene.pointer_moved(view_model(state), {at}, actions);
  ASSERT_EQ(actions.size(), 1u);
  const glm::dvec3 aim = std::get<AimTool>(actions[0]).aim.place_mm;
  EXPECT_NEAR(std::hypot(aim.x, aim.z), beside_mm, 1e-3);
  EXPECT_NEAR(aim.y, 20.0, 1e-3);
}

TEST_F(ActionsTest, AFingerHasSlidersInsteadOfKeys) {
  const Command& size = *find_command("tool.size");
  EXPECT_TRUE(size.enabled(view_model(state)));
  host.touched = true;
  EXPECT_FALSE(size.enabled(view_model(state)));
  EXPECT_NE(std::string(size.why_not(view_model(state))).find("mouse"), std::string::npos);
}

TEST_F(ActionsTest, ALumpUpToTheTallestOneStands) {
  constexpr double kRadiusMm = 30.0;
  const double kg = tallest_lump_mm() / lump_height_mm(1.0, kRadiusMm);
  apply(state, BeginWork{lump_of(0.999 * kg, kRadiusMm), nullptr, {}});
  EXPECT_FALSE(state.last_error) << state.last_error->message;
  EXPECT_EQ(state.document.name(), "lump");
  apply(state, BeginWork{lump_of(1.01 * kg, kRadiusMm), nullptr, {}});
  EXPECT_TRUE(state.last_error) << "its lowest ring carries all others";
}

TEST_F(ActionsTest, AHoveringToolIsOnTheWheelAndNotInIt) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, LookFrom{ViewFrom::front});
  apply(state, SetToolShape{Shape::sphere});
  state.settings.tool.sphere.radius_mm = 6.0;
  const double beside_mm = static_cast<double>(state.stroke.view().rows.front().outer_mm) + 8.0;
  state.scene.lead({beside_mm, 0.0});
  for (const ToolMode mode : {ToolMode::press, ToolMode::trim, ToolMode::trim_foot}) {
    apply(state, SetToolMode{mode});
    const auto tool = state.scene.tool_view(view_model(state));
    ASSERT_TRUE(tool);
    EXPECT_NEAR(tool->place_mm.y, 6.0, 1e-9);
  }
  apply(state, SetToolMode{ToolMode::wire});
  EXPECT_NEAR(state.scene.tool_view(view_model(state))->place_mm.y, 0.0, 1e-9) << "where it cuts";
}

/// A change of the tool during a stroke applies to the next stroke.
TEST_F(ActionsTest, AStrokeIsShownWithItsOwnTool) {
  change();  // a groove: upside down, the pot looks different
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, LookFrom{ViewFrom::front});
  apply(state, SetToolMode{ToolMode::press});
  const double beside_mm = static_cast<double>(state.stroke.view().rows.front().outer_mm) + 20.0;
  Actions press;
  state.scene.shape_from(view_model(state), {beside_mm, 20.0}, {}, press);
  apply_all(state, press);
  ASSERT_TRUE(state.stroke.by_hand());
  const render::PotView standing = state.scene.picture(view_model(state)).pot;
  apply(state, SetToolMode{ToolMode::trim_foot});
  apply(state, ScaleTool{2.0});
  EXPECT_EQ(state.scene.picture(view_model(state)).pot, standing);
  EXPECT_EQ(view_model(state).tool_in_use(), state.document.scene().tool);
  apply(state, ReleaseTool{});
  EXPECT_NE(state.scene.picture(view_model(state)).pot, standing)
      << "the next stroke is at the foot";
  EXPECT_EQ(view_model(state).tool_in_use(), tool_of(state.settings.tool));
}

TEST_F(ActionsTest, AFallenPotIsNotTurnedOver) {
  const auto thrown =
      test::claystack("throw -q " + test::sample("collapse.scene.json") + " -s " +
                      test::sample("collapse.session") + " -o " + folder.file("fallen.pot.json"));
  ASSERT_LE(thrown.status, 1) << thrown.err;
  apply(state, OpenFile{folder.file("fallen.pot.json")});
  ASSERT_TRUE(state.document.fallen());
  apply(state, SetToolMode{ToolMode::trim_foot});
  EXPECT_EQ(state.scene.picture(view_model(state)).pot, state.document.view());
}

/// A pull of half the height stays in sight.
TEST_F(ActionsTest, AChosenPinchHasRoomAboveTheRim) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, LookFrom{ViewFrom::front});
  for (int i = 0; i < 4; ++i) apply(state, Zoom{1.0});
  const double pulled_mm = 1.5 * state.stroke.view().height_mm;
  const auto above = [&] { return state.scene.pixel_of({0.0, pulled_mm}).value().y; };
  ASSERT_LT(above(), 0.0f);
  apply(state, SetToolMode{ToolMode::trim});
  EXPECT_LT(above(), 0.0f) << "only a pinch pulls";
  apply(state, SetToolMode{ToolMode::pinch});
  EXPECT_GE(above(), 0.0f);
}

TEST_F(ActionsTest, ANameToSaveUnderHasItsFolder) {
  apply(state, ShowDialog{DialogKind::save_file});
  const std::filesystem::path path = std::get<SaveDialog>(state.ui.dialog).path;
  EXPECT_EQ(path.parent_path(), std::filesystem::current_path());
}

TEST_F(ActionsTest, ATargetIsAPotAWorkOrADrawing) {
  ASSERT_TRUE(state.document.save(folder.file("a.pot.cbor")));
  ASSERT_TRUE(state.document.save(folder.file("a.work")));
  for (const std::string& path : {folder.file("a.pot.cbor"), folder.file("a.work")}) {
    apply(state, UseTarget{path});
    ASSERT_TRUE(state.ui.target) << path;
    EXPECT_EQ(state.ui.target->view, state.document.view()) << path;
    apply(state, ClearTarget{});
    EXPECT_FALSE(state.ui.target);
  }
  apply(state, ChooseTarget{});
  EXPECT_TRUE(state.ui.shows<OpenDialog>());
  apply(state, UseTarget{test::sample("drawings/jug.svg")});
  ASSERT_TRUE(state.ui.target);
  EXPECT_EQ(state.ui.target->name, "jug.svg");
  EXPECT_TRUE(state.ui.shows<NoDialog>());
  EXPECT_EQ(strokes(), 0u) << "the pot on the wheel stays";
  test::write_text(folder.file("bad.pot.json"), "{}");
  apply(state, UseTarget{folder.file("bad.pot.json")});
  EXPECT_EQ(state.ui.target->name, "jug.svg") << "an error changes nothing";
  EXPECT_TRUE(state.last_error);
}

TEST_F(ActionsTest, GalleryStaysOpenWithoutAWork) {
  AppState empty{host, Settings{}, [](std::string_view) {}};
  EXPECT_TRUE(empty.ui.shows<GalleryDialog>());
  apply(empty, ShowDialog{DialogKind::shortcuts});
  apply(empty, Back{});
  EXPECT_TRUE(empty.ui.shows<GalleryDialog>());
}

TEST_F(ActionsTest, ANewLumpHasRoomForTheTarget) {
  state.scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state, UseSampleTarget{2});
  const double target_mm = state.ui.target->view.height_mm;
  apply(state, BeginSample{0});
  ASSERT_LT(state.stroke.view().height_mm, 0.6 * target_mm);
  EXPECT_GT(state.scene.pixel_of({0.0, target_mm}).value().y, 0.0f);
}

TEST_F(ActionsTest, TheBannerAnswersTheLatestAction) {
  const auto text = [this] {
    const auto& notice = state.ui.notices.shown();
    return notice ? notice->text : std::string();
  };
  apply(state, SaveFile{folder.file("none/a.work")});
  EXPECT_NE(text().find("none/a.work"), std::string::npos) << text();
  EXPECT_EQ(state.ui.notices.shown()->grade, Grade::error);
  apply(state, SaveFile{folder.file("a.stl")});
  EXPECT_NE(text().find("a.stl"), std::string::npos) << text();
  state.ui.notices.show_state(Grade::warning, "home the arm");
  apply(state, SaveFile{folder.file("a.work")});
  EXPECT_EQ(text(), "Saved " + folder.file("a.work"));
  EXPECT_EQ(state.ui.notices.state()->text, "home the arm") << "no answer hides it";
  apply(state, Back{});
  EXPECT_EQ(text(), "home the arm");
  apply(state, Back{});
  EXPECT_EQ(text(), "");
}

TEST_F(ActionsTest, AFullDiskShowsABannerUntilStrokesAreProtectedAgain) {
  setenv("XDG_STATE_HOME", folder.path().c_str(), 1);
  state.document.keep_journals();
  apply(state, BeginWork{small_scene(), nullptr, {}});
  update(state);
  EXPECT_FALSE(state.ui.notices.shown());

  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{200, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);  // as on a full disk
  const auto wait = [this](double seconds) {
    host.clock().sleep_until_ns(host.clock().now_ns() + static_cast<std::int64_t>(1e9 * seconds));
    update(state);
  };
  change();
  wait(0.1);
  ASSERT_TRUE(state.ui.notices.shown());
  EXPECT_EQ(state.ui.notices.shown()->grade, Grade::error);
  EXPECT_NE(state.ui.notices.shown()->text.find("A crash would lose strokes"), std::string::npos);
  wait(10.0);
  wait(0.1);
  EXPECT_TRUE(state.document.journal_problem()) << "the disk is still full";
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);

  wait(10.0);
  wait(0.1);
  EXPECT_FALSE(state.document.journal_problem());
  ASSERT_TRUE(state.ui.notices.shown());
  EXPECT_EQ(state.ui.notices.shown()->grade, Grade::note);
  const auto journals = history::recovery_folder();
  ASSERT_EQ(std::distance(std::filesystem::directory_iterator(journals),
                          std::filesystem::directory_iterator()),
            1);
  ASSERT_TRUE(state.document.work().journal()->path().parent_path() == journals);
  const auto kept = history::load(state.document.work().journal()->path().string());
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_EQ(kept->work.size(), 2u) << "the stroke is in the new journal";
  unsetenv("XDG_STATE_HOME");
}

TEST_F(ActionsTest, UndoAndRedoChangeTheDocument) {
  change();
  const auto pot = state.document.shared_pot();
  apply(state, RunCommand{"edit.undo"});
  EXPECT_EQ(state.document.work().at(), 0u);
  EXPECT_FALSE(find_command("edit.undo")->enabled(view_model(state)));
  apply(state, RunCommand{"edit.redo"});
  EXPECT_EQ(state.document.shared_pot(), pot);
  EXPECT_NE(log.find("action: edit.undo\n"), std::string::npos);
}

TEST_F(ActionsTest, ActionsChangeSettings) {
  state.ui.restyle = false;
  apply(state, SetWheelSpeed{90.0});
  apply(state, SetToolShape{Shape::rib});
  EXPECT_FALSE(state.ui.restyle);
  EXPECT_EQ(state.settings.wheel_rpm, 90.0);
  EXPECT_EQ(state.settings.tool.shape, Shape::rib);
  const double rate = state.document.scene_with({}, kNominalRpm).removal.rate_per_s;
  EXPECT_EQ(state.document.scene_with({}, 90.0).removal.rate_per_s, 0.75 * rate);
  apply(state, ToggleTheme{});
  EXPECT_EQ(state.settings.theme, Theme::light);
  EXPECT_TRUE(state.settings.theme_chosen);
  EXPECT_TRUE(state.ui.restyle);
  apply(state, ScaleText{1000.0f});
  EXPECT_EQ(state.settings.scale, kLargestScale);
  apply(state, ToggleWallMap{});
  EXPECT_TRUE(state.settings.wall_map);
}

TEST_F(ActionsTest, ADrawingOpensItsDialogAndAsksBeforeImport) {
  change();
  apply(state, OpenFile{test::sample("drawings/jug.svg")});
  ASSERT_TRUE(state.ui.shows<ImportDialog>());
  const auto& import = std::get<ImportDialog>(state.ui.dialog);
  ASSERT_TRUE(import.made) << import.problem;
  ImportSettings settings;
  settings.height_mm = 100.0;
  apply(state, EditImport{settings});
  EXPECT_NEAR(import.made->pot.stack.height_mm(), 100.0, 0.5);
  apply(state, TakeImport{});
  ASSERT_TRUE(state.ui.shows<UnsavedDialog>());
  apply(state, CloseDialog{});
  ASSERT_TRUE(state.ui.shows<ImportDialog>()) << "Cancel keeps the settings of the import";
  EXPECT_NEAR(std::get<ImportDialog>(state.ui.dialog).made->pot.stack.height_mm(), 100.0, 0.5);
  apply(state, TakeImport{});
  apply(state, DiscardAndContinue{});
  EXPECT_EQ(state.document.scene().name, "jug");
  EXPECT_NEAR(state.document.pot().stack.height_mm(), 100.0, 0.5);
}

}  // namespace
}  // namespace clay::studio
