// Pictures and turntables from the window: those of `claystack render`, in the background.

#include "app/studio/app_state.hpp"
#include "app/studio/commands.hpp"
#include "tests/app/history/strokes.hpp"
#include "tests/app/studio/still_host.hpp"
#include "tests/support/run_program.hpp"

#include "claystack/engine/files.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <thread>

namespace clay::studio {
namespace {

using test::claystack;
using test::read_text;
using test::small_scene;
using test::write_text;

class Pictures : public ::testing::Test {
 protected:
  Pictures() {
    apply(state, BeginWork{small_scene(), nullptr, {}});
    state.settings.folder = folder.path().string();
  }
  void run(const char* id) { EXPECT_TRUE(studio::run(*find_command(id), state)) << id; }
  void edit(const std::function<void(PictureFile&)>& change) {
    PictureFile file = state.ui.pictures.file;
    change(file);
    apply(state, EditPicture{file});
  }
  /// Writes the pot of the window, and draws it by the command.
  std::string commanded(const std::string& options, const std::string& out) {
    write_text(folder.file("p.pot.json"), write_pot(state.document.pot(), PotEncoding::json));
    const auto ran =
        claystack("render -q " + folder.file("p.pot.json") + " " + options + folder.file(out));
    EXPECT_EQ(ran.status, 0) << ran.err;
    return read_text(folder.file(out));
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(
        std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator{}));
  }

  StillHost host;
  std::string log;
  AppState state{host, Settings{},
                 [this](std::string_view line) { log.append(line).append("\n"); }};
  test::ScratchFolder folder;
};

TEST_F(Pictures, PicturesAreThoseOfTheCommand) {
  state.settings.material = *find_material("celadon");
  state.scene.cut = render::Cut::half;
  run("file.picture");
  ASSERT_TRUE(state.ui.shows<PictureDialog>());
  edit([](PictureFile& file) {
    file.name = "mine";
    file.look.size = {200, 120};
    file.look.azimuth_deg = -20.5;
    file.look.elevation_deg = 12.3;
  });
  run("export.write");
  update(state);
  ASSERT_EQ(state.ui.pictures.problem, "");
  EXPECT_EQ(state.ui.pictures.written, folder.file("mine.png"));
  const std::string same =
      "--size 200x120 --azimuth -20.5 --elevation 12.3 --section --theme dark ";
  const std::string mine = read_text(folder.file("mine.png"));
  EXPECT_TRUE(mine == commanded(same + "--material celadon --style clay -o ", "same.png"));
  EXPECT_FALSE(mine == commanded(same + "--material white --style clay -o ", "other.png"));
}

TEST_F(Pictures, MappedPicturesAndTurntablesAreThoseOfTheCommand) {
  state.settings.wall_map = true;
  state.settings.process = "porcelain";
  state.settings.throwing_lines = false;
  for (const char* id : {"file.picture", "file.turntable"}) {
    run(id);
    edit([](PictureFile& file) {
      file.name = "mine";
      file.look.size = {160, 90};
      file.look.frames = 8;
      file.look.azimuth_deg = 10.0;
      file.look.elevation_deg = 20.0;
      file.look.theme = render::Theme::light;
    });
    run("export.write");
    update(state);
    ASSERT_EQ(state.ui.pictures.problem, "") << id;
  }
  const std::string same =
      "--size 160x90 --azimuth 10 --elevation 20 --process porcelain --material wet ";
  EXPECT_TRUE(read_text(folder.file("mine.png")) == commanded(same + "-o ", "same.png"));
  EXPECT_TRUE(read_text(folder.file("mine.gif")) ==
              commanded(same + "--frames 8 --turntable ", "same.gif"));
}

TEST_F(Pictures, TheViewSetsTheDirection) {
  apply(state, LookFrom{ViewFrom::top});
  run("file.picture");
  EXPECT_DOUBLE_EQ(*state.ui.pictures.file.look.elevation_deg, 89.0);
  apply(state, CloseDialog{});
  apply(state, LookFrom{ViewFrom::right});
  run("file.picture");
  EXPECT_DOUBLE_EQ(*state.ui.pictures.file.look.azimuth_deg, 90.0);
}

TEST_F(Pictures, AsksBeforeItReplacesAnotherFile) {
  run("file.picture");
  edit([](PictureFile& file) {
    file.name = "taken";
    file.look.size = {32, 32};
  });
  write_text(folder.file("taken.png"), "mine");
  run("export.write");
  update(state);
  ASSERT_TRUE(state.ui.shows<ReplaceDialog>());
  EXPECT_EQ(read_text(folder.file("taken.png")), "mine");
  run("replace.cancel");
  EXPECT_TRUE(state.ui.shows<PictureDialog>());
  EXPECT_EQ(read_text(folder.file("taken.png")), "mine");
  run("export.write");
  run("replace.confirm");
  update(state);
  EXPECT_TRUE(state.ui.shows<PictureDialog>());
  EXPECT_EQ(read_text(folder.file("taken.png")).substr(1, 3), "PNG");
  run("export.write");  // its own file
  EXPECT_TRUE(state.ui.shows<PictureDialog>());
}

TEST_F(Pictures, AFolderThatIsMissingIsReported) {
  run("file.picture");
  edit([&](PictureFile& file) { file.folder = folder.file("none"); });
  run("export.write");
  update(state);
  EXPECT_NE(state.ui.pictures.problem.find("none"), std::string::npos) << state.ui.pictures.problem;
  EXPECT_TRUE(state.ui.pictures.written.empty());
  edit([](PictureFile& file) { file.name = "a/b"; });
  EXPECT_FALSE(studio::run(*find_command("export.write"), state));
}

TEST_F(Pictures, ACancelledTurntableLeavesNoFile) {
  PictureWriter writer(true);
  PictureFile file;
  file.turntable = true;
  file.folder = folder.path().string();
  file.name = "long";
  file.look.size = {320, 320};
  file.look.frames = render::kMostFrames;
  writer.write(state.document.shared_pot(), file);
  while (writer.progress() <= 0.0f && writer.busy()) std::this_thread::yield();
  writer.cancel();
  std::optional<PictureWriter::Outcome> outcome;
  while (!(outcome = writer.take())) std::this_thread::yield();
  EXPECT_TRUE(outcome->cancelled);
  EXPECT_FALSE(outcome->bytes);
  EXPECT_EQ(files(), 0u);
  EXPECT_LT(writer.progress(), 1.0f);
}

}  // namespace
}  // namespace clay::studio
