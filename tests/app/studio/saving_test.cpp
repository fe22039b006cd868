// Files of the window, without a window: the questions before a work or a file is lost.

#include "app/history/file_lock.hpp"
#include "app/studio/app_state.hpp"
#include "tests/app/studio/actions.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace clay::studio {
namespace {

using test::small_scene;

TEST_F(ActionsTest, ActionsThatReplaceAnUnsavedWorkAskFirst) {
  ASSERT_TRUE(state.document.save(folder.file("a.work")));
  change();
  state.recoverable.emplace_back();
  const Action replacing[] = {BeginWork{small_scene(), nullptr, {}}, BeginSample{0},
                              OpenFile{folder.file("a.work")}, RecoverWork{0}, Quit{}};
  for (const Action& action : replacing) {
    apply(state, action);
    ASSERT_TRUE(state.ui.shows<UnsavedDialog>()) << action.index();
    EXPECT_EQ(std::get<UnsavedDialog>(state.ui.dialog).next.index(), action.index());
    EXPECT_EQ(strokes(), 1u);
    EXPECT_FALSE(state.done);
    apply(state, CloseDialog{});
    EXPECT_TRUE(state.ui.shows<NoDialog>());
  }
}

TEST_F(ActionsTest, AnUnsavedWorkIsDeletedOnlyAfterAQuestion) {
  for (const char* name : {"a.journal", "b.journal"}) {
    test::write_text(folder.file(name), "x");
    state.recoverable.emplace_back().path = folder.file(name);
  }
  apply(state, DiscardRecoverable{1});
  ASSERT_TRUE(state.ui.shows<DiscardDialog>());
  apply(state, Back{});
  EXPECT_TRUE(state.ui.shows<GalleryDialog>());
  EXPECT_TRUE(std::filesystem::exists(folder.file("b.journal")));
  EXPECT_EQ(state.recoverable.size(), 2u);
  apply(state, DiscardRecoverable{1});
  apply(state, DiscardAsked{});
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.journal")));
  EXPECT_TRUE(std::filesystem::exists(folder.file("a.journal")));
  EXPECT_EQ(state.recoverable.size(), 1u);
}

TEST_F(ActionsTest, DiscardingContinuesAndAFailedOpenKeepsTheWork) {
  change();
  test::write_text(folder.file("a.txt"), "hello\n");
  for (const char* name : {"none.work", "a.txt"}) {
    apply(state, OpenFile{folder.file(name)});
    EXPECT_TRUE(state.ui.shows<NoDialog>()) << name << ": nothing to ask";
    ASSERT_TRUE(state.ui.notices.shown());
    EXPECT_NE(state.ui.notices.shown()->text.find(name), std::string::npos);
    EXPECT_EQ(state.ui.notices.shown()->grade, Grade::error);
  }
  ASSERT_TRUE(state.document.save(folder.file("a.pot.json")));
  apply(state, OpenFile{folder.file("a.pot.json")});
  ASSERT_TRUE(state.ui.shows<UnsavedDialog>());
  std::filesystem::remove(folder.file("a.pot.json"));
  apply(state, DiscardAndContinue{});
  EXPECT_EQ(strokes(), 1u);
  EXPECT_TRUE(state.document.unsaved()) << "the file is gone";
  apply(state, BeginSample{1});
  apply(state, DiscardAndContinue{});
  EXPECT_EQ(strokes(), 0u);
  EXPECT_EQ(state.document.scene().name, "vase");
  change();
  apply(state, Quit{});
  apply(state, DiscardAndContinue{});
  EXPECT_TRUE(state.done);
}

TEST_F(ActionsTest, SavingRequestsANameAndContinuesOnlyWithAWork) {
  change();
  apply(state, Quit{});
  apply(state, SaveAndContinue{});
  ASSERT_TRUE(state.ui.shows<SaveDialog>());
  apply(state, SaveFile{"/nonexistent/a.work"});
  EXPECT_TRUE(state.ui.shows<SaveDialog>()) << "not saved";
  EXPECT_FALSE(state.done);
  apply(state, SaveFile{folder.file("a.pot.json")});
  EXPECT_FALSE(state.done) << "a pot file has no strokes";
  apply(state, Quit{});
  apply(state, SaveAndContinue{});
  apply(state, SaveFile{folder.file("a.work")});
  EXPECT_TRUE(state.done);
}

TEST_F(ActionsTest, SavingOverAnotherFileAsksFirst) {
  const std::string name = folder.file("other.work");
  test::write_text(name, "another work");
  change();
  apply(state, Quit{});
  apply(state, SaveAndContinue{});
  apply(state, SaveFile{folder.file("other")});  // the extension is completed
  ASSERT_TRUE(state.ui.shows<ReplaceDialog>());
  EXPECT_NE(std::get<ReplaceDialog>(state.ui.dialog).question.find("other.work exists"),
            std::string::npos);
  apply(state, Back{});
  ASSERT_TRUE(state.ui.shows<SaveDialog>());
  EXPECT_EQ(std::get<SaveDialog>(state.ui.dialog).path, name);
  EXPECT_EQ(test::read_text(name), "another work");
  EXPECT_FALSE(state.done);
  apply(state, SaveFile{name});
  apply(state, RunCommand{"replace.confirm"});
  EXPECT_TRUE(history::load(name));
  EXPECT_TRUE(state.done) << "the earlier question continues";
}

TEST_F(ActionsTest, SavingAgainAsksOnlyIfAnotherProgramChangedTheFile) {
  const std::string name = folder.file("mine.work");
  change();
  apply(state, SaveFile{name});
  EXPECT_TRUE(state.ui.shows<NoDialog>());
  change();
  apply(state, Save{});
  EXPECT_FALSE(state.document.unsaved());
  test::write_text(name, test::read_text(name) + "\n");
  const std::string changed = test::read_text(name);
  change();
  apply(state, Save{});
  ASSERT_TRUE(state.ui.shows<ReplaceDialog>());
  EXPECT_NE(std::get<ReplaceDialog>(state.ui.dialog).question.find("changed by another program"),
            std::string::npos);
  EXPECT_EQ(test::read_text(name), changed);
  EXPECT_TRUE(state.document.unsaved());
  apply(state, ReplaceFiles{});
  EXPECT_FALSE(state.document.unsaved());
  EXPECT_TRUE(state.ui.shows<NoDialog>());
}

TEST_F(ActionsTest, DesktopDialogConfirmsOnlyTheNameItReturns) {
  change();
  test::write_text(folder.file("a.work"), "x");
  apply(state, SaveFile{folder.file("a"), true});
  EXPECT_TRUE(state.ui.shows<ReplaceDialog>());
  apply(state, KeepFiles{});
  apply(state, SaveFile{folder.file("a.work"), true});
  EXPECT_FALSE(state.document.unsaved());
}

TEST_F(ActionsTest, SavingOverAFolderFails) {
  change();
  std::filesystem::create_directory(folder.file("a.work"));
  apply(state, SaveFile{folder.file("a.work")});
  if (state.ui.shows<ReplaceDialog>()) apply(state, ReplaceFiles{});
  EXPECT_TRUE(state.document.unsaved());
  EXPECT_TRUE(std::filesystem::is_directory(folder.file("a.work")));
}

TEST_F(ActionsTest, ProposesAFreeName) {
  state.settings.folder = folder.file("");
  change();
  for (const char* expected : {"small.work", "small-2.work", "small-3.work"}) {
    apply(state, ShowDialog{DialogKind::save_file});
    const std::string path = std::get<SaveDialog>(state.ui.dialog).path;
    EXPECT_EQ(std::filesystem::path(path).filename(),
              std::string(expected).replace(0, 5, state.document.scene().name));
    test::write_text(path, "x");
  }
}

TEST_F(ActionsTest, OpeningAFileLeavesTheFolderOfExports) {
  state.settings.folder = "/exports";
  test::write_text(folder.file("lump.scene.json"),
                   test::read_text(test::sample("vase.scene.json")));
  apply(state, OpenFile{folder.file("lump.scene.json")});
  ASSERT_EQ(state.document.scene().name, "vase");
  EXPECT_EQ(state.settings.folder, "/exports");
  apply(state, ShowDialog{DialogKind::open_file});
  EXPECT_EQ(std::filesystem::path(std::get<OpenDialog>(state.ui.dialog).path).parent_path(),
            folder.path());
  apply(state, ShowDialog{DialogKind::export_files});
  EXPECT_EQ(state.ui.exporting.choices.folder, "/exports");
  apply(state, SaveFile{folder.file("a.work")});
  EXPECT_EQ(state.settings.folder, folder.path()) << "what is written stays together";
}

TEST_F(ActionsTest, ARecentFileThatIsGoneIsOfferedNoMore) {
  const std::string work = folder.file("a.work"), pot = folder.file("b.pot.json");
  apply(state, SaveFile{work});
  apply(state, SaveFile{pot});
  ASSERT_EQ(state.settings.recent, (std::vector{pot, work}));
  std::filesystem::remove(pot);
  apply(state, OpenFile{pot});
  EXPECT_EQ(state.settings.recent, (std::vector{work}));
  change();
  std::filesystem::remove(work);
  apply(state, OpenFile{work});  // of an unsaved work
  EXPECT_TRUE(state.settings.recent.empty());
  test::write_text(work, "not a work");
  state.settings.recent = {work};
  apply(state, OpenFile{work});
  EXPECT_EQ(state.settings.recent, (std::vector{work})) << "it may be repaired";
}

TEST_F(ActionsTest, WorksAreListedNewestFirst) {
  namespace fs = std::filesystem;
  for (const char* name : {"b.work", "c.WORK", "a.work", "a.pot.json"})
    test::write_text(folder.file(name), name);
  fs::create_directory(folder.file("d.work"));
  const auto now = fs::file_time_type::clock::now();
  fs::last_write_time(folder.file("a.work"), now - std::chrono::hours(2));
  fs::last_write_time(folder.file("b.work"), now - std::chrono::hours(1));
  fs::last_write_time(folder.file("c.WORK"), now - std::chrono::hours(3));
  state.settings.folder = folder.path();
  apply(state, ShowDialog{DialogKind::works});
  const auto& works = std::get<WorksDialog>(state.ui.dialog).works;
  std::vector<std::string> names;
  for (const StoredWork& work : works) names.push_back(work.path.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"b.work", "a.work", "c.WORK"}));
  EXPECT_EQ(works[0].bytes, 6u);
  const auto age = std::chrono::system_clock::now() - works[0].when;
  EXPECT_GT(age, std::chrono::minutes(59));
  EXPECT_LT(age, std::chrono::minutes(70));
  state.settings.folder = folder.file("none");
  apply(state, ShowDialog{DialogKind::works});
  EXPECT_TRUE(std::get<WorksDialog>(state.ui.dialog).works.empty());
}

TEST_F(ActionsTest, AWorkIsDeletedOnlyAfterAQuestion) {
  const std::string work = folder.file("a.work");
  apply(state, SaveFile{work});
  apply(state, SaveFile{folder.file("b.work")});
  apply(state, ShowDialog{DialogKind::works});
  apply(state, DeleteWork{work});
  ASSERT_TRUE(state.ui.shows<DiscardDialog>());
  EXPECT_TRUE(std::get<DiscardDialog>(state.ui.dialog).is_file());
  apply(state, Back{});
  ASSERT_TRUE(state.ui.shows<WorksDialog>());
  EXPECT_EQ(std::get<WorksDialog>(state.ui.dialog).works.size(), 2u);
  apply(state, DeleteWork{work});
  apply(state, DiscardAsked{});
  EXPECT_FALSE(std::filesystem::exists(work));
  ASSERT_TRUE(state.ui.shows<WorksDialog>());
  EXPECT_EQ(std::get<WorksDialog>(state.ui.dialog).works.size(), 1u);
  EXPECT_EQ(state.settings.recent, (std::vector{folder.file("b.work")}));
  EXPECT_FALSE(state.last_error);
}

TEST_F(ActionsTest, AWorkThatIsOpenElsewhereIsNotDeleted) {
  const std::string work = folder.file("a.work");
  test::write_text(work, "x");
  state.settings.folder = folder.path();
  const history::FileLock other(work, history::FileLock::Kind::exclusive);
  apply(state, DeleteWork{work});
  apply(state, DiscardAsked{});
  EXPECT_TRUE(std::filesystem::exists(work));
  EXPECT_TRUE(state.ui.shows<WorksDialog>());
  ASSERT_TRUE(state.ui.notices.shown());
  EXPECT_EQ(state.ui.notices.shown()->text, work + " is open in another window");
}

TEST_F(ActionsTest, SavingFromTheMenuDuringTheQuestionDoesNotContinue) {
  change();
  ASSERT_TRUE(state.document.save(folder.file("a.work")));
  apply(state, Undo{});
  apply(state, Quit{});
  ASSERT_TRUE(state.ui.shows<UnsavedDialog>());
  apply(state, Save{});
  EXPECT_FALSE(state.done);
  EXPECT_FALSE(state.document.unsaved());
}

}  // namespace
}  // namespace clay::studio
