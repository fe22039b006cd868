#pragma once
// All that can be done at the window: one table, which the menu, the keys, the sheet of shortcuts
// and the scripts read.

#include "app/studio/input.hpp"

#include <span>
#include <string_view>

namespace clay::studio {

struct AppState;

struct Action {
  std::string_view id;  ///< for scripts: "edit.undo"; before the point its menu
  const char* title;
  KeyChord chord;
  KeyChord also;  ///< a second one, not shown in the menu
  bool (*enabled)(const AppState&);
  void (*run)(AppState&);
  bool (*checked)(const AppState&) = nullptr;  ///< of those that switch something
};

/// In the order of the menus.
[[nodiscard]] std::span<const Action> actions();
/// nullptr: none has this id, or this chord.
[[nodiscard]] const Action* find_action(std::string_view id);
[[nodiscard]] const Action* action_of(const KeyChord& chord);
/// Where it is enabled, and said in the log; whether it was.
bool run(const Action& action, AppState& shop);

struct MenuTitle {
  std::string_view prefix;  ///< of the ids: "edit."
  const char* title;
};
[[nodiscard]] std::span<const MenuTitle> menus();

}  // namespace clay::studio
