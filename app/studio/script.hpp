#pragma once
// Drives the window's own handlers from a file, on a clock of its own: the same every time, and
// without a screen. docs/studio.md lists the commands.

#include "app/studio/offscreen_host.hpp"
#include "app/studio/studio.hpp"
#include "claystack/core/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace clay::studio {

struct ScriptLine {
  std::size_t number = 0;          ///< in the file, from 1
  std::vector<std::string> words;  ///< the command and its arguments
};

/// A command a line, "#" begins a comment, words with blanks stand between double quotes. Errors
/// read "NAME:LINE: what was expected, what was found", for every command and number of arguments,
/// before any is run.
Result<std::vector<ScriptLine>> parse_script(std::string_view text, std::string_view name);

class ScriptRunner {
 public:
  ScriptRunner(OffscreenHost& host, Studio& studio) : host_(host), studio_(studio) {}

  /// Until the script or the window ends. What is expected and not so is `unsound`, at its line.
  Result<void> run(const std::vector<ScriptLine>& lines, std::string_view name);
  Result<void> screenshot(const std::string& path);

 private:
  Result<void> act(const std::vector<std::string>& words);
  Result<void> expect(const std::vector<std::string>& words);
  void frames(int count);
  void wait(double seconds);
  [[nodiscard]] Result<glm::vec2> place_of(const std::vector<std::string>& words) const;
  Result<void> move(glm::vec2 to_px, double seconds);

  OffscreenHost& host_;
  Studio& studio_;
  glm::vec2 pointer_px_{0.0f};
  unsigned mods_ = 0;  // that are held with the mouse
};

}  // namespace clay::studio
