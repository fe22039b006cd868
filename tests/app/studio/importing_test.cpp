#include "app/studio/importing.hpp"

#include "tests/support/run_program.hpp"

#include "claystack/engine/files.hpp"

#include <gtest/gtest.h>

namespace clay::studio {
namespace {

using test::claystack;
using test::read_text;
using test::ScratchFolder;

TEST(Importing, MatchesTheCommand) {
  const ScratchFolder folder;
  struct Case {
    const char* file;
    const char* options;
    ImportSettings settings;
  };
  const Case cases[] = {
      {"jug.svg", "", {}},
      {"jug.svg", "--height 120", {.height_mm = 120.0}},
      {"jug.svg", "--axis left --wall 5", {.axis = ImportAxis::left, .wall_mm = 5.0}},
      {"jug.svg", "--axis middle", {.axis = ImportAxis::middle}},
      {"jug.svg", "--axis right", {.axis = ImportAxis::right}},
      {"tumbler.csv", "--axis 5", {.axis = ImportAxis::at, .axis_mm = 5.0}},
  };
  for (const auto& [file, options, settings] : cases) {
    const std::string path = test::sample(std::string("drawings/") + file);
    const std::string pot = folder.file("pot.pot.json");
    const auto ran = claystack("import " + path + " -o " + pot + " " + options);
    const auto made = import_drawing(read_text(path), path, settings);
    ASSERT_EQ(ran.status == 0, made.has_value()) << options << ran.err;
    if (made)
      EXPECT_EQ(write_pot(made->pot, PotEncoding::json), read_text(pot)) << options;
    else
      EXPECT_NE(ran.err.find(made.error().message), std::string::npos) << ran.err;
  }
}

TEST(Importing, ErrorsAppearInTheDialog) {
  ImportCard card;
  card.path = "odd.csv";
  card.bytes = "not a table\n1,\n";
  reload(card);
  EXPECT_FALSE(card.made);
  EXPECT_NE(card.problem.find("odd.csv"), std::string::npos) << card.problem;
}

TEST(Importing, ShowsWhatOfTheDrawingIsNotUsed) {
  ImportCard card;
  card.path = "jug.svg";
  card.bytes = read_text(test::sample("drawings/jug.svg"));
  reload(card);
  ASSERT_TRUE(card.made) << card.problem;
  EXPECT_TRUE(card.made->notes.empty());
  card.bytes.insert(card.bytes.find("<path") + 5, " clip-path='url(#c)'");
  reload(card);
  ASSERT_TRUE(card.made) << card.problem;
  ASSERT_EQ(card.made->notes.size(), 1u);
  EXPECT_NE(card.made->notes.front().find("a clip-path is not applied"), std::string::npos);
}

TEST(Importing, RecognisesDrawingsByExtension) {
  for (const char* name : {"a.svg", "b.dxf", "c.csv", "Jug.SVG", "JUG.Dxf"})
    EXPECT_TRUE(is_drawing(name)) << name;
  for (const char* name : {"a.work", "a.pot.json", "svg", "a.svg.gz"})
    EXPECT_FALSE(is_drawing(name)) << name;
}

}  // namespace
}  // namespace clay::studio
