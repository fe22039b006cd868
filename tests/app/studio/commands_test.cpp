#include "app/studio/commands.hpp"

#include "app/studio/input.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace clay::studio {
namespace {

TEST(Commands, IdsAndChordsAreUnique) {
  std::set<std::string_view> ids;
  std::set<std::string> chords;
  for (const Command& command : commands()) {
    EXPECT_TRUE(ids.insert(command.id).second) << command.id;
    for (const KeyChord& chord : {command.chord, command.second_chord}) {
      if (chord.key == 0) continue;
      EXPECT_TRUE(chords.insert(text_of(chord)).second) << text_of(chord) << " " << command.id;
    }
  }
}

TEST(Commands, CanBeFoundByIdAndChord) {
  for (const Command& command : commands()) {
    EXPECT_EQ(find_command(command.id), &command);
    if (command.chord.key == 0) continue;
    EXPECT_EQ(command_for(command.chord), &command);
  }
  EXPECT_EQ(find_command("edit.nothing"), nullptr);
  EXPECT_EQ(command_for({}), nullptr);
}

TEST(Commands, EveryMenuHasCommands) {
  for (const Menu& menu : menus())
    EXPECT_TRUE(std::ranges::any_of(commands(), [&](const Command& command) {
      return command.id.starts_with(menu.prefix);
    })) << menu.title;
}

TEST(Commands, UseTheUsualShortcuts) {
  const auto id_of = [](std::string_view chord) {
    const Command* command = command_for(chord_of(chord).value());
    return command != nullptr ? command->id : "none";
  };
  EXPECT_EQ(id_of("Ctrl+Z"), "edit.undo");
  EXPECT_EQ(id_of("Ctrl+Shift+Z"), "edit.redo");
  EXPECT_EQ(id_of("Ctrl+S"), "file.save");
  EXPECT_EQ(id_of("Ctrl+O"), "file.open");
  EXPECT_EQ(id_of("Ctrl+N"), "file.new");
  EXPECT_EQ(id_of("Ctrl+Y"), "edit.redo");
  EXPECT_EQ(id_of("Ctrl+E"), "file.export");
  EXPECT_EQ(id_of("Ctrl+Q"), "file.quit");
  EXPECT_EQ(id_of("Home"), "view.home");
  EXPECT_EQ(id_of("1"), "view.front");
  EXPECT_EQ(id_of("3"), "view.right");
  EXPECT_EQ(id_of("7"), "view.top");
  EXPECT_EQ(id_of("["), "tool.smaller");
  EXPECT_EQ(id_of("]"), "tool.larger");
  EXPECT_EQ(id_of("F"), "tool.size");
  EXPECT_EQ(id_of("Shift+F"), "tool.strength");
  EXPECT_EQ(id_of("Space"), "wheel.pause");
  EXPECT_EQ(id_of("Esc"), "wheel.zero_force");
  EXPECT_EQ(id_of("?"), "help.keys");
}

TEST(Keys, TextAndChordAreInverse) {
  for (const Command& command : commands()) {
    if (command.chord.key == 0) continue;
    const auto back = chord_of(text_of(command.chord));
    ASSERT_TRUE(back) << text_of(command.chord);
    EXPECT_EQ(*back, command.chord) << text_of(command.chord);
  }
  EXPECT_EQ(text_of({'Z', kControl | kShift}), "Ctrl+Shift+Z");
  EXPECT_FALSE(chord_of("Ctrl+"));
  EXPECT_FALSE(chord_of("Hyper+Z"));
}

/// The key that a German keyboard prints Z on is the American Y.
TEST(Keys, AreThoseOfTheUsersLayout) {
  EXPECT_EQ(key_of_layout('Y', "z", kControl), 'Z');
  EXPECT_EQ(key_of_layout('Z', "y", kControl), 'Y');
  EXPECT_EQ(key_of_layout('Q', "a", kControl), 'A') << "of a French keyboard";
  EXPECT_EQ(key_of_layout('/', "-", kControl), '-');
  EXPECT_EQ(key_of_layout(']', "+", kControl), '=') << "Ctrl++ enlarges the text";
  EXPECT_EQ(key_of_layout(']', "+", kNoMods), ']') << "it has no other key";
  EXPECT_EQ(key_of_layout('[', "\xc3\xbc", kNoMods), '[');
  EXPECT_EQ(key_of_layout('Z', "\xd1\x8f", kControl), 'Z') << "of a Russian keyboard";
  EXPECT_EQ(key_of_layout('1', "&", kNoMods), '1') << "of a French keyboard";
  EXPECT_EQ(key_of_layout('Z', "", kControl), 'Z');
}

TEST(Keys, OfTheNumberPadAreThoseOfTheOthers) {
  const auto code = [](const char* name) { return chord_of(name)->key; };
  constexpr int kPadPlus = 334, kPadMinus = 333, kPadEnter = 335;  // of GLFW
  EXPECT_EQ(key_of_layout(kPadEnter, "", kNoMods), code("Enter"));
  EXPECT_EQ(key_of_layout(kPadPlus, "+", kControl), code("="));
  EXPECT_EQ(key_of_layout(kPadMinus, "-", kControl), code("-"));
  EXPECT_EQ(key_of_layout(code("Num7"), "7", kNoMods), code("Num7")) << "a view";
}

}  // namespace
}  // namespace clay::studio
