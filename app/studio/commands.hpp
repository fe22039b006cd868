#pragma once
// The table of commands: an action with an id, a title and a key. Menus, keys, the list of
// shortcuts and scripts read it.

#include "app/studio/action.hpp"
#include "app/studio/input.hpp"

#include <span>
#include <string_view>

namespace clay::studio {

struct AppState;
struct ViewModel;

struct Command {
  /// For scripts, such as "edit.undo"; the part before the point names the menu.
  std::string_view id;
  const char* title;
  KeyChord chord;
  KeyChord second_chord;  ///< not shown in the menu
  Action action;
  bool (*enabled)(const ViewModel&);
  bool (*checked)(const ViewModel&) = nullptr;  ///< state of a command that toggles something
  /// Reason why it is disabled now, as the end of a sentence; null: it is enabled, or the view
  /// shows the reason.
  const char* (*why_not)(const ViewModel&) = nullptr;
};

/// Title, keys, and the reason why the command is disabled.
[[nodiscard]] std::string tip_of(const Command& command, const ViewModel& model);

/// In the order of the menus.
[[nodiscard]] std::span<const Command> commands();
/// Null if no command has this id or chord.
[[nodiscard]] const Command* find_command(std::string_view id);
[[nodiscard]] const Command* command_for(const KeyChord& chord);
/// Logs the command and applies its action if the command is enabled. Returns false otherwise.
bool run(const Command& command, AppState& state);

struct Menu {
  std::string_view prefix;  ///< prefix of the ids: "edit."
  const char* title;
};
[[nodiscard]] std::span<const Menu> menus();

}  // namespace clay::studio
