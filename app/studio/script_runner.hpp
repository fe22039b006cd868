#pragma once
// Runs a script in a window without a screen, on a virtual clock, so that every run gives the same
// result.

#include "app/studio/offscreen_host.hpp"
#include "app/studio/script.hpp"
#include "app/studio/studio.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay::studio {

class ScriptRunner {
 public:
  ScriptRunner(OffscreenHost& host, Studio& studio) : host_(host), studio_(studio) {}

  /// All commands of scripts.
  [[nodiscard]] static std::span<const ScriptCommand> commands() noexcept;

  /// Runs until the script or the window ends. A failed `expect` returns an `unsound` error with
  /// its line.
  Result<void> run(const std::vector<ScriptLine>& lines, std::string_view name);
  Result<void> screenshot(const std::string& path);

 private:
  using Words = std::vector<std::string>;  // a command and its arguments
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
  /// One step per frame, like a hand.
  void move(glm::vec2 to_px, double seconds);
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
