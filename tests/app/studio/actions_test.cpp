#include "app/studio/actions.hpp"

#include "app/studio/input.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace clay::studio {
namespace {

TEST(Actions, EachIdAndEachChordIsGivenOnce) {
  std::set<std::string_view> ids;
  std::set<std::string> chords;
  for (const Action& action : actions()) {
    EXPECT_TRUE(ids.insert(action.id).second) << action.id;
    for (const KeyChord& chord : {action.chord, action.also}) {
      if (chord.key == 0) continue;
      EXPECT_TRUE(chords.insert(text_of(chord)).second) << text_of(chord) << " " << action.id;
    }
  }
}

TEST(Actions, EachIsFoundByItsIdAndItsChord) {
  for (const Action& action : actions()) {
    EXPECT_EQ(find_action(action.id), &action);
    if (action.chord.key == 0) continue;
    EXPECT_EQ(action_of(action.chord), &action);
  }
  EXPECT_EQ(find_action("edit.nothing"), nullptr);
  EXPECT_EQ(action_of({}), nullptr);
}

TEST(Actions, EachMenuHasSome) {
  for (const MenuTitle& menu : menus())
    EXPECT_TRUE(std::ranges::any_of(actions(), [&](const Action& action) {
      return action.id.starts_with(menu.prefix);
    })) << menu.title;
}

TEST(Actions, WhatUsersExpectIsWhereTheyExpectIt) {
  const auto id_of = [](std::string_view chord) {
    const Action* action = action_of(chord_of(chord).value());
    return action != nullptr ? action->id : "none";
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

TEST(Keys, TextAndChordAreEachOthersInverse) {
  for (const Action& action : actions()) {
    if (action.chord.key == 0) continue;
    const auto back = chord_of(text_of(action.chord));
    ASSERT_TRUE(back) << text_of(action.chord);
    EXPECT_EQ(*back, action.chord) << text_of(action.chord);
  }
  EXPECT_EQ(text_of({'Z', kControl | kShift}), "Ctrl+Shift+Z");
  EXPECT_FALSE(chord_of("Ctrl+"));
  EXPECT_FALSE(chord_of("Hyper+Z"));
}

}  // namespace
}  // namespace clay::studio
