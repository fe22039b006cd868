#pragma once
// Keys by name, as shortcuts are shown and scripts press them: "Ctrl+Shift+Z", "F", "[", "Home".

#include <optional>
#include <string>
#include <string_view>

namespace clay::studio {

struct KeyChord {
  int key = 0;  ///< GLFW's code; 0: none
  unsigned mods = 0;
  friend bool operator==(const KeyChord&, const KeyChord&) = default;
};

/// "Ctrl+Shift+Z"; empty for none.
[[nodiscard]] std::string text_of(const KeyChord& chord);

/// Its inverse; nothing for what names no key.
[[nodiscard]] std::optional<KeyChord> chord_of(std::string_view text);

}  // namespace clay::studio
