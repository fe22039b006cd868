#include "app/studio/document.hpp"

#include "tests/app/history/strokes.hpp"
#include "tests/support/run_program.hpp"

#include "claystack/engine/files.hpp"

#include "app/render/pot_view.hpp"

#include <gtest/gtest.h>

namespace clay::studio {
namespace {

using test::press_stroke;
using test::read_text;
using test::ScratchFolder;
using test::small_scene;
using test::write_text;

class DocumentTest : public ::testing::Test {
 protected:
  DocumentTest() { EXPECT_TRUE(document.begin(small_scene())); }
  /// One stroke through the functions that a servo's recorder uses.
  void stroke(std::uint64_t seed) {
    auto begun = document.begin_stroke(small_scene());
    ASSERT_TRUE(begun) << begun.error().message;
    test::record(press_stroke(seed), *begun->sink);
    ASSERT_TRUE(document.end_stroke(std::nullopt, history::Recording::one_stroke));
  }
  [[nodiscard]] std::string pot() const { return write_pot(document.pot(), PotEncoding::json); }
  Document document;
  ScratchFolder folder;
};

TEST_F(DocumentTest, NamesTheFilesThatItOpensAndTheImport) {
  const std::string before = pot();
  write_text(folder.file("a.stl"), "solid a\nendsolid a\n");
  write_text(folder.file("a.bin"), "\x89PNG\r\n\x1a\n");
  for (const char* name : {"a.stl", "a.bin"}) {
    const auto opened = document.open(folder.file(name));
    ASSERT_FALSE(opened) << name;
    EXPECT_EQ(opened.error().kind, ErrorKind::bad_input);
    for (const char* kind : {".scene.json", ".pot.json", ".work", "3MF", ".svg"})
      EXPECT_NE(opened.error().message.find(kind), std::string::npos) << opened.error().message;
  }
  EXPECT_NE(document.open(folder.file("a.stl")).error().message.find("claystack import"),
            std::string::npos);
  write_text(folder.file("a.txt"), "hello\n");
  const std::string text = document.open(folder.file("a.txt")).error().message;
  EXPECT_NE(text.find("found text that begins with 'hello'"), std::string::npos) << text;
  EXPECT_EQ(text.find("syntax error"), std::string::npos) << text;
  write_text(folder.file("a.scene.json"), "\n {\"tool\": }\n");
  EXPECT_NE(document.open(folder.file("a.scene.json")).error().message.find("a.scene.json:2"),
            std::string::npos)
      << "a damaged scene names the line";
  EXPECT_EQ(pot(), before);
}

TEST_F(DocumentTest, IsUnsavedFromAStrokeUntilAWorkIsSaved) {
  EXPECT_FALSE(document.unsaved());
  stroke(1);
  EXPECT_TRUE(document.unsaved());
  ASSERT_TRUE(document.save(folder.file("a.pot.json")));
  EXPECT_TRUE(document.unsaved()) << "a pot file has no strokes";
  EXPECT_TRUE(document.pot_saved());
  stroke(2);
  EXPECT_FALSE(document.pot_saved());
  ASSERT_TRUE(document.undo());
  EXPECT_TRUE(document.pot_saved());
  EXPECT_TRUE(document.file().empty());
  ASSERT_TRUE(document.save(folder.file("a.work")));
  EXPECT_FALSE(document.unsaved());
  EXPECT_EQ(document.name(), "a.work");
  ASSERT_TRUE(document.undo());
  EXPECT_TRUE(document.unsaved());
}

TEST_F(DocumentTest, DiscardedChangesAreUnsavedAgainAfterAStroke) {
  stroke(1);
  document.discard_changes();
  EXPECT_FALSE(document.unsaved());
  document.keep_changes();
  EXPECT_TRUE(document.unsaved());
  document.discard_changes();
  stroke(2);
  EXPECT_TRUE(document.unsaved());
}

TEST_F(DocumentTest, UndoAndRedoFollowTheStrokes) {
  const std::string lump = pot();
  EXPECT_FALSE(document.can_undo());
  stroke(1);
  const std::string one = pot();
  EXPECT_NE(one, lump);
  EXPECT_FALSE(document.can_redo());
  ASSERT_TRUE(document.undo());
  EXPECT_EQ(pot(), lump);
  ASSERT_TRUE(document.redo());
  EXPECT_EQ(pot(), one);
  ASSERT_TRUE(document.go_to(0));
  stroke(2);
  EXPECT_EQ(document.work().at(), 2u);
  EXPECT_EQ(document.other_branch(), 1u);
  ASSERT_TRUE(document.go_to(*document.other_branch()));
  EXPECT_EQ(pot(), one);
}

TEST_F(DocumentTest, ShowsAScrubbedMomentAndBranchesThere) {
  stroke(1);
  const double half_s = 0.5 * document.work().view(1).seconds;
  const render::PotView whole = document.view();
  ASSERT_TRUE(document.scrub(1, half_s));
  EXPECT_TRUE(document.scrubbing());
  EXPECT_NE(document.view(), whole);
  EXPECT_EQ(render::view_of(*document.shown_pot()), document.view())
      << "the panels measure the moment shown";
  EXPECT_NE(document.shown_pot(), document.shared_pot());
  ASSERT_TRUE(document.show_present());
  EXPECT_EQ(document.shown_pot(), document.shared_pot());
  EXPECT_FALSE(document.scrubbing());
  EXPECT_EQ(document.view(), whole);
  ASSERT_TRUE(document.scrub(1, half_s));
  const render::PotView shown = document.view();
  ASSERT_TRUE(document.branch_here());
  EXPECT_EQ(document.work().at(), 2u);
  EXPECT_EQ(document.view(), shown);
}

TEST_F(DocumentTest, FailedOpenChangesNothing) {
  stroke(1);
  const std::string before = pot();
  EXPECT_EQ(document.open(folder.file("none.work")).error().kind, ErrorKind::io);
  EXPECT_EQ(document.open(folder.file("none.scene.json")).error().kind, ErrorKind::io);
  for (const char* name : {"bad.work", "bad.pot.json", "bad.scene.json"}) {
    write_text(folder.file(name), "{}");
    EXPECT_EQ(document.open(folder.file(name)).error().kind, ErrorKind::bad_input) << name;
  }
  EXPECT_EQ(pot(), before);
  EXPECT_TRUE(document.unsaved());
}

/// Another flow, threshold and rules than a pot of this size has by default.
SceneSpec own_clay() {
  SceneSpec scene = small_scene();
  scene.flow.reach_mm = 7.0;
  scene.stability = StabilitySpec{14.0};
  scene.clay = ClaySpec{.hoop = false, .wheel_rpm = 150.0, .floor_mm = 3.0};
  scene.tool.shape = EllipseSpec{9.0, 6.0};
  return scene;
}

std::string pot_after(Document& document, std::uint64_t seed) {
  const SceneSpec scene = document.scene_with(document.scene().tool, 150.0);
  auto begun = document.begin_stroke(scene);
  EXPECT_TRUE(begun) << begun.error().message;
  test::record(press_stroke(seed), *begun->sink);
  EXPECT_TRUE(document.end_stroke(std::nullopt, history::Recording::one_stroke));
  return write_pot(document.pot(), PotEncoding::json);
}

TEST_F(DocumentTest, TheSameStrokeGivesTheSamePotFromWorkAndPot) {
  ASSERT_TRUE(document.begin(own_clay()));
  const std::string before = pot_after(document, 1);
  for (const char* name : {"a.work", "a.pot.json", "a.pot.cbor"})
    ASSERT_TRUE(document.save(folder.file(name))) << name;
  const std::string after = pot_after(document, 2);
  EXPECT_NE(after, before);
  for (const char* name : {"a.work", "a.pot.json", "a.pot.cbor"}) {
    Document other;
    ASSERT_TRUE(other.open(folder.file(name))) << name;
    EXPECT_EQ(settings_of(other.scene()), settings_of(own_clay())) << name;
    EXPECT_EQ(other.wheel_rpm(), 150.0) << name;
    EXPECT_EQ(pot_after(other, 2), after) << name;
  }
  const std::string usual = write_pot(document.pot(), PotEncoding::json);
  test::write_text(folder.file("usual.pot.json"), usual);
  Document other;
  ASSERT_TRUE(other.open(folder.file("usual.pot.json")));
  ASSERT_TRUE(other.save(folder.file("again.pot.json")));
  EXPECT_EQ(read_text(folder.file("again.pot.json")), usual) << "usual clay takes no section";
}

TEST_F(DocumentTest, SavesAndOpensEachKindOfFile) {
  stroke(1);
  const std::string before = pot();
  for (const char* name : {"a.work", "a.pot.json", "a.pot.cbor"}) {
    ASSERT_TRUE(document.save(folder.file(name))) << name;
    Document other;
    const auto opened = other.open(folder.file(name));
    ASSERT_TRUE(opened) << opened.error().message;
    // The first document still has the work open.
    EXPECT_EQ(opened->empty(), std::string(name) != "a.work") << *opened;
    EXPECT_EQ(write_pot(other.pot(), PotEncoding::json), before) << name;
    EXPECT_FALSE(other.unsaved());
    EXPECT_EQ(other.file().empty(), std::string(name) != "a.work");
  }
  EXPECT_EQ(document.save(folder.file("a.txt")).error().kind, ErrorKind::bad_input);
  EXPECT_EQ(document.save("/nonexistent/a.work").error().kind, ErrorKind::io);
}

TEST_F(DocumentTest, ReportsAnIncompleteLastLineOfAWork) {
  stroke(1);
  ASSERT_TRUE(document.save(folder.file("a.work")));
  const std::string text = read_text(folder.file("a.work"));
  write_text(folder.file("torn.work"), text.substr(0, text.size() - 5));
  Document other;
  const auto opened = other.open(folder.file("torn.work"));
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_NE(*opened, "");
}

TEST_F(DocumentTest, AWorkOpenInTwoWindowsIsNotReplacedSilently) {
  const std::string path = folder.file("a.work");
  stroke(1);
  ASSERT_TRUE(document.save(path));
  EXPECT_FALSE(document.replaces_other(path));
  Document second;
  const auto remark = second.open(path);
  ASSERT_TRUE(remark);
  EXPECT_NE(remark->find("is open in another window"), std::string::npos) << *remark;
  EXPECT_TRUE(second.replaces_other(path));
  EXPECT_FALSE(document.replaces_other(path)) << "the first window has it";
  ASSERT_TRUE(second.save(path));
  EXPECT_TRUE(document.replaces_other(path)) << "another window has changed it";
  EXPECT_FALSE(second.replaces_other(path)) << "now the second window has it";
}

TEST_F(DocumentTest, ItsFileIsItsFileUnderAnotherSpelling) {
  const std::string path = folder.file("a.work");
  ASSERT_TRUE(document.save(path));
  std::filesystem::create_directory(folder.path() / "sub");
  EXPECT_FALSE(document.replaces_other(folder.path() / "sub" / ".." / "a.work"));
  EXPECT_FALSE(document.replaces_other(std::filesystem::relative(path)));
  std::filesystem::copy(path, folder.file("b.work"));
  EXPECT_TRUE(document.replaces_other(folder.file("b.work")));
}

TEST_F(DocumentTest, AWorkOpenedAgainInItsWindowIsNotInUse) {
  const std::string path = folder.file("a.work");
  ASSERT_TRUE(document.save(path));
  const auto remark = document.open(path);
  ASSERT_TRUE(remark);
  EXPECT_EQ(*remark, "");
  EXPECT_FALSE(document.replaces_other(path));
}

}  // namespace
}  // namespace clay::studio
