#include "app/studio/file_dialog.hpp"

#include "app/studio/app_state.hpp"
#include "tests/app/history/strokes.hpp"
#include "tests/app/studio/still_host.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <thread>

namespace clay::studio {
namespace {

using test::read_text;
using test::ScratchFolder;
using test::write_text;

/// A PATH with only the installed programs.
class Desktop : public ::testing::Test {
 protected:
  void SetUp() override { setenv("PATH", folder.path().c_str(), 1); }
  void TearDown() override { setenv("PATH", before.c_str(), 1); }
  void install(const char* name, const std::string& script) {
    write_text(folder.file(name), "#!/bin/sh\n" + script);
    std::filesystem::permissions(folder.file(name), std::filesystem::perms::owner_all);
  }
  std::string answer(FileDialog& dialog) {
    while (true)
      if (auto taken = dialog.take()) return *taken;
  }
  ScratchFolder folder;
  std::string before = std::getenv("PATH");
};

TEST_F(Desktop, FallsBackToATextFieldWithoutADialog) {
  FileDialog dialog;
  EXPECT_FALSE(dialog.begin(FileDialog::Kind::open, "/tmp/"));
  EXPECT_FALSE(dialog.open());
  EXPECT_FALSE(dialog.take());
  EXPECT_FALSE(show_folder("/tmp"));
}

TEST_F(Desktop, ReadsTheChoiceFromZenity) {
  install("zenity", "printf '%s\\n' \"$*\" >" + folder.file("asked") +
                        "\nprintf '/a place/my pot.work\\n'\n");
  FileDialog dialog;
  ASSERT_TRUE(dialog.begin(FileDialog::Kind::save, "/here/bowl.work"));
  EXPECT_FALSE(dialog.begin(FileDialog::Kind::open, "/"));
  EXPECT_EQ(dialog.kind(), FileDialog::Kind::save);
  EXPECT_EQ(answer(dialog), "/a place/my pot.work");
  EXPECT_FALSE(dialog.open());
  EXPECT_EQ(
      read_text(folder.file("asked")),
      "--file-selection --title=Save as --filename=/here/bowl.work --save --confirm-overwrite\n");
}

TEST_F(Desktop, ClosedDialogChoosesNothing) {
  install("zenity", "echo /half/a/name; exit 1\n");
  FileDialog dialog;
  ASSERT_TRUE(dialog.begin(FileDialog::Kind::folder, "/"));
  EXPECT_EQ(answer(dialog), "");
  ASSERT_TRUE(dialog.begin(FileDialog::Kind::folder, "/"));
}

TEST_F(Desktop, UsesKdialogWithoutZenity) {
  install("kdialog", "echo \"$*\"\n");
  FileDialog dialog;
  ASSERT_TRUE(dialog.begin(FileDialog::Kind::open, "/x/"));
  EXPECT_EQ(answer(dialog), "--title=Open --getopenfilename /x/");
}

/// A second dialog would hide the first one, and one of their answers would be lost.
TEST_F(Desktop, OpensOneDialogAtATime) {
  install("zenity", "read line <" + folder.file("wait") + "\n");
  ASSERT_EQ(mkfifo(folder.file("wait").c_str(), 0600), 0);
  StillHost host;
  AppState state{host, Settings{}, [](std::string_view) {}};
  host.real = true;
  apply(state, BeginWork{test::small_scene(), nullptr, {}});
  apply(state, ShowDialog{DialogKind::open_file});
  ASSERT_TRUE(state.file_dialog.open());
  EXPECT_FALSE(state.ui.notices.answer());
  for (const Action& action :
       {Action(ShowDialog{DialogKind::open_file}), Action(Save{}), Action(ChooseProcessFile{})}) {
    state.ui.notices.close_answer();
    apply(state, action);
    EXPECT_TRUE(state.ui.shows<NoDialog>());
    ASSERT_TRUE(state.ui.notices.answer());
    EXPECT_NE(state.ui.notices.answer()->text.find("is open"), std::string::npos);
  }
}

}  // namespace
}  // namespace clay::studio
