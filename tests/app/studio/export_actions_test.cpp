// Actions of the export dialog: its process, its outcome and its marks.

#include "app/history/pot_scene.hpp"
#include "app/studio/commands.hpp"
#include "tests/app/studio/actions.hpp"
#include "tests/app/studio/cups.hpp"

#include <string>

namespace clay::studio {
namespace {

TEST_F(ActionsTest, WallsAndExportHaveOneProcess) {
  const auto of_export = [this]() -> std::string& { return state.ui.exporting.choices.process; };
  apply(state, ShowDialog{DialogKind::export_files});
  EXPECT_EQ(of_export(), "");
  apply(state, CloseDialog{});
  apply(state, SetProcess{"porcelain"});
  apply(state, ShowDialog{DialogKind::export_files});
  EXPECT_EQ(of_export(), "porcelain") << "chosen in the panel after the first export";
  ExportChoices choices = state.ui.exporting.choices;
  choices.process = "stoneware";
  apply(state, EditExport{choices});
  EXPECT_EQ(state.settings.process, "stoneware") << "chosen in the dialog";
  apply(state, UseProcess{test::sample("workshop.process.json")});
  EXPECT_EQ(of_export(), state.settings.process);
}

TEST_F(ActionsTest, ThePreviewIsOfTheChoicesAndThePotOnTheWheel) {
  const auto previews = [this] {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = log.find("export previewed", at)) != std::string::npos; ++at)
      ++count;
    return count;
  };
  apply(state, ShowDialog{DialogKind::export_files});
  update(state);
  ASSERT_EQ(previews(), 1u) << state.ui.exporting.problem;
  const double lump_g = state.ui.exporting.preview->weight_g;
  ExportChoices choices = state.ui.exporting.choices;
  for (const char letter : {'j', 'u', 'g'}) {
    choices.name += letter;
    apply(state, EditExport{choices});
    update(state);
  }
  EXPECT_EQ(previews(), 1u) << "a name does not change the solid";
  choices.tolerance_mm = 0.1;
  apply(state, EditExport{choices});
  update(state);
  EXPECT_EQ(previews(), 2u);
  // An arm may change the pot while the dialog is open.
  SceneSpec trimming = test::small_scene(8.0, ToolMode::trim);
  auto begun = state.document.begin_stroke(trimming);
  ASSERT_TRUE(begun);
  test::record(test::press_stroke(1), *begun->sink);
  ASSERT_TRUE(state.document.end_stroke(std::nullopt, history::Recording::one_stroke));
  update(state);
  EXPECT_EQ(previews(), 3u);
  ASSERT_TRUE(state.ui.exporting.preview) << state.ui.exporting.problem;
  EXPECT_LT(state.ui.exporting.preview->weight_g, lump_g);
}

TEST_F(ActionsTest, APotInPartsIsNotExportedAndTheDialogSaysSo) {
  auto parted = test::cup_rings();
  for (std::size_t i = 80; i < parted.size(); ++i)
    parted[i] = {quanta_from_radius(30.0), quanta_from_radius(25.0)};
  const history::SharedPot pot = test::pot_of(std::move(parted));
  apply(state, BeginWork{history::scene_for(*pot, "parted"), pot, {}});
  ASSERT_EQ(state.document.pot().stack, pot->stack) << log;
  apply(state, ShowDialog{DialogKind::export_files});
  update(state);
  EXPECT_EQ(
      state.ui.exporting.problem,
      "The pot is in two parts, separated at a height of 40.0 mm. Only a pot in one part can be "
      "exported");
  const Command& write = *find_command("export.write");
  EXPECT_FALSE(write.enabled(view_model(state)));
  ExportChoices drawing = state.ui.exporting.choices;
  drawing.meshes.clear();
  drawing.section = true;
  apply(state, EditExport{drawing});
  update(state);
  EXPECT_TRUE(write.enabled(view_model(state))) << "other choices have not failed";
}

TEST_F(ActionsTest, AnExportThatFailsALimitIsAWarning) {
  apply(state, ShowDialog{DialogKind::export_files});
  ExportChoices choices = state.ui.exporting.choices;
  choices.folder = folder.path().string();
  choices.min_wall_mm = 500.0;  // no pot has such a wall
  apply(state, EditExport{choices});
  apply(state, RunCommand{"export.write"});
  apply(state, CloseDialog{});
  update(state);
  const ExportState& exporting = state.ui.exporting;
  ASSERT_EQ(exporting.written.size(), 1u) << exporting.problem;
  EXPECT_EQ(exporting.grade, Grade::warning);
  EXPECT_NE(exporting.result.find("1 limit failed"), std::string::npos) << exporting.result;
  ASSERT_TRUE(state.ui.notices.shown());
  EXPECT_EQ(state.ui.notices.shown()->grade, Grade::warning);
  EXPECT_TRUE(view_model(state).has_marks()) << "the marks stay after writing";
  choices.min_wall_mm = 0.0;
  apply(state, ShowDialog{DialogKind::export_files});
  choices.folder = folder.path().string();
  apply(state, EditExport{choices});
  apply(state, WriteExport{true});
  update(state);
  EXPECT_EQ(exporting.grade, Grade::note) << exporting.result;
  EXPECT_EQ(exporting.result.find("failed"), std::string::npos) << exporting.result;
}

/// An export that ended with the program would leave no file.
TEST_F(ActionsTest, QuittingWaitsForAnExport) {
  apply(state, ShowDialog{DialogKind::export_files});
  ExportChoices choices = state.ui.exporting.choices;
  choices.folder = folder.path().string();
  apply(state, EditExport{choices});
  apply(state, WriteExport{true});
  apply(state, CloseDialog{});
  apply(state, Quit{});
  EXPECT_FALSE(state.done);
  EXPECT_TRUE(state.ui.shows<ExportDialog>()) << "it shows the progress, and can be cancelled";
  ASSERT_TRUE(state.ui.notices.answer());
  EXPECT_EQ(state.ui.notices.answer()->grade, Grade::warning);
  update(state);
  ASSERT_EQ(state.ui.exporting.written.size(), 1u) << state.ui.exporting.problem;
  apply(state, Quit{});
  EXPECT_TRUE(state.done);
}

/// A new work may have the name of the one before.
TEST_F(ActionsTest, FilesOfTheWorkBeforeAreNotReplacedUnasked) {
  const auto begin_again = [this] { apply(state, BeginWork{test::small_scene(), nullptr, {}}); };
  const auto in_folder = [this] {
    ExportChoices choices = state.ui.exporting.choices;
    choices.folder = folder.path().string();
    apply(state, EditExport{choices});
  };
  apply(state, ShowDialog{DialogKind::export_files});
  in_folder();
  apply(state, WriteExport{});
  begin_again();
  apply(state, ShowDialog{DialogKind::export_files});
  in_folder();
  update(state);  // takes the outcome
  EXPECT_EQ(state.ui.exporting.result.find("Of the work before: 1 file written"), 0u);
  apply(state, WriteExport{});
  EXPECT_TRUE(state.ui.shows<ReplaceDialog>());
  apply(state, ReplaceFiles{});
  update(state);
  EXPECT_EQ(state.ui.exporting.written.size(), 1u) << "of this work";

  apply(state, ShowDialog{DialogKind::picture});
  PictureFile picture = state.ui.pictures.file;
  picture.folder = folder.path().string();
  apply(state, EditPicture{picture});
  apply(state, WriteExport{});
  begin_again();
  apply(state, ShowDialog{DialogKind::picture});
  update(state);
  apply(state, WriteExport{});
  EXPECT_TRUE(state.ui.shows<ReplaceDialog>());
}

/// A preview that is ready after another choice is not that of the choices shown.
TEST_F(ActionsTest, APreviewOfTheChoicesBeforeIsNotShown) {
  apply(state, ShowDialog{DialogKind::export_files});
  ExportChoices choices = state.ui.exporting.choices;
  ASSERT_FALSE(choices.meshes.empty());
  state.exporter.preview(state.document.shared_pot(), choices);
  state.exporter.wait();
  choices.meshes.clear();
  choices.step = true;
  apply(state, EditExport{choices});
  update(state);
  EXPECT_FALSE(state.ui.exporting.preview);
}

/// A turntable may be in progress, too.
TEST_F(ActionsTest, CancelEndsWhatTheDialogShows) {
  apply(state, ShowDialog{DialogKind::picture});
  PictureFile picture = state.ui.pictures.file;
  picture.folder = folder.path().string();
  apply(state, EditPicture{picture});
  apply(state, WriteExport{});
  ASSERT_TRUE(state.pictures.busy());
  apply(state, CloseDialog{});
  apply(state, ShowDialog{DialogKind::export_files});
  EXPECT_FALSE(find_command("export.cancel")->enabled(view_model(state)));
  ExportChoices choices = state.ui.exporting.choices;
  choices.folder = folder.path().string();
  choices.tolerance_mm = kFinestMm;
  apply(state, EditExport{choices});
  apply(state, WriteExport{});
  apply(state, CancelExport{});
  update(state);
  EXPECT_NE(log.find("export cancelled"), std::string::npos) << log;
}

/// A dialog that is opened again shows no earlier failure, so a banner reports it.
TEST_F(ActionsTest, AFailureAfterTheDialogWasClosedIsABanner) {
  const std::string gone = folder.file("gone");
  const auto expect_banner = [&] {
    apply(state, WriteExport{true});
    apply(state, CloseDialog{});
    update(state);
    ASSERT_TRUE(state.ui.notices.answer());
    EXPECT_EQ(state.ui.notices.answer()->grade, Grade::error);
    EXPECT_NE(state.ui.notices.answer()->text.find(gone), std::string::npos);
  };
  apply(state, ShowDialog{DialogKind::export_files});
  ExportChoices choices = state.ui.exporting.choices;
  choices.folder = gone;
  apply(state, EditExport{choices});
  expect_banner();
  apply(state, CloseNotice{});
  apply(state, ShowDialog{DialogKind::picture});
  PictureFile picture = state.ui.pictures.file;
  picture.folder = gone;
  apply(state, EditPicture{picture});
  expect_banner();
}

TEST_F(ActionsTest, TheOutcomeIsThatOfTheChoices) {
  apply(state, ShowDialog{DialogKind::export_files});
  ExportChoices choices = state.ui.exporting.choices;
  choices.folder = folder.path().string();
  apply(state, EditExport{choices});
  const auto write = [this] {
    apply(state, WriteExport{true});
    update(state);
    return state.ui.exporting.result;
  };
  ASSERT_NE(write(), "") << state.ui.exporting.problem;
  apply(state, EditExport{choices});
  EXPECT_NE(state.ui.exporting.result, "") << "nothing has changed";
  choices.report = true;
  apply(state, EditExport{choices});
  EXPECT_EQ(state.ui.exporting.result, "");
  ASSERT_NE(write(), "");
  apply(state, SetProcess{"porcelain"});
  EXPECT_EQ(state.ui.exporting.result, "");
}

/// The pot is too thin for any limit. Its foot ring, an overhang, is not in the pot on the wheel.
TEST_F(ActionsTest, MarksAreThoseOfThePotOnTheWheel) {
  const auto marks = [this](double min_wall_mm, double foot_width_mm) {
    apply(state, ShowDialog{DialogKind::export_files});
    ExportChoices choices = state.ui.exporting.choices;
    choices.process = foot_width_mm > 0.0 ? "fdm" : "";
    choices.min_wall_mm = min_wall_mm;
    choices.foot_width_mm = foot_width_mm;
    apply(state, EditExport{choices});
    update(state);
    EXPECT_TRUE(state.ui.exporting.preview) << state.ui.exporting.problem;
    if (state.ui.exporting.preview) {
      EXPECT_FALSE(state.ui.exporting.preview->marks.empty());
    }
    apply(state, CloseDialog{});
    return view_model(state).has_marks();
  };
  EXPECT_TRUE(marks(500.0, 0.0));
  EXPECT_FALSE(marks(0.0, 5.0));
  EXPECT_TRUE(marks(500.0, 0.0));
}

TEST_F(ActionsTest, ANameOfAFolderExportsNothingAndSaysWhy) {
  const Command& write = *find_command("export.write");
  for (const DialogKind kind : {DialogKind::export_files, DialogKind::picture}) {
    apply(state, ShowDialog{kind});
    EXPECT_TRUE(write.enabled(view_model(state)));
    EXPECT_EQ(write.why_not(view_model(state)), nullptr);
    for (const char* name : {"bad/name", ""}) {
      state.ui.exporting.choices.name = state.ui.pictures.file.name = name;
      EXPECT_FALSE(write.enabled(view_model(state)));
      ASSERT_NE(write.why_not(view_model(state)), nullptr);
      EXPECT_NE(std::string(write.why_not(view_model(state))).find("name"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace clay::studio
