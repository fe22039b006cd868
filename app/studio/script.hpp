#pragma once
// Scripts drive the handlers of the window without a screen, on a virtual clock, so that every run
// gives the same result. docs/studio.md lists the commands.

#include "app/studio/offscreen_host.hpp"
#include "app/studio/studio.hpp"
#include "claystack/core/result.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::studio {

struct ScriptLine {
  std::size_t number = 0;          ///< line number in the file, from 1
  std::vector<std::string> words;  ///< the command and its arguments
};

/// One command per line; "#" begins a comment; arguments with blanks are in double quotes. Errors
/// begin with NAME:LINE. Commands and their arguments are checked before the first one runs.
Result<std::vector<ScriptLine>> parse_script(std::string_view text, std::string_view name);

/// A fact about the window as text; numbers in the shortest form that reads back. Empty for a name
/// that is not in docs/studio.md.
[[nodiscard]] std::optional<std::string> fact(const AppState& state, std::string_view name);
[[nodiscard]] bool is_fact(std::string_view name);

class ScriptRunner {
 public:
  ScriptRunner(OffscreenHost& host, Studio& studio) : host_(host), studio_(studio) {}

  /// Runs until the script or the window ends. A failed `expect` returns an `unsound` error with
  /// its line.
  Result<void> run(const std::vector<ScriptLine>& lines, std::string_view name);
  Result<void> screenshot(const std::string& path);

 private:
  using Words = std::vector<std::string>;  // a command and its arguments
  Result<void> act(const Words& words);
  Result<void> point(const Words& words);
  Result<void> button(const Words& words);
  Result<void> hold(const Words& words);
  Result<void> pressure(const Words& words);
  Result<void> gamepad(const Words& words);
  Result<void> stick(const Words& words);
  Result<void> trigger(const Words& words);
  Result<void> pad_button(const Words& words);
  Result<void> scroll(const Words& words);
  Result<void> key(const Words& words);
  Result<void> type(const Words& words);
  Result<void> run_command(const Words& words);
  Result<void> open(const Words& words);
  Result<void> save(const Words& words);
  Result<void> close(const Words& words);
  Result<void> wait(const Words& words);
  Result<void> picture(const Words& words) { return screenshot(words[1]); }
  Result<void> expect(const Words& words);
  void frames(int count);
  [[nodiscard]] Result<glm::vec2> place_of(const Words& words) const;
  Result<void> move(glm::vec2 to_px, double seconds);
  /// Sends a gamepad that goes to this state.
  void drive(const GamepadState& to, double seconds);

  OffscreenHost& host_;
  Studio& studio_;
  glm::vec2 pointer_px_{0.0f};
  unsigned mods_ = 0;               // modifier keys held during mouse events
  std::optional<double> pressure_;  // of a pen; none: a mouse
  GamepadState pad_;
};

}  // namespace clay::studio
