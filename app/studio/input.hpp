#pragma once
// What reaches the window from outside, from GLFW callbacks or from a script: one queue, so that a
// script drives the same handlers as a person. Keys have names: "Ctrl+Shift+Z", "F", "[", "Home".

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clay::studio {

/// Bits of what is held with a key or a button.
enum Mods : unsigned { kNoMods = 0, kShift = 1, kControl = 2, kAlt = 4 };

enum class MouseButton { left, right, middle };

struct PointerMoved {
  glm::vec2 place_px{0.0f};  ///< of the framebuffer, from its upper left corner
};
struct ButtonChanged {
  MouseButton button = MouseButton::left;
  bool down = false;
  unsigned mods = kNoMods;
};
struct Scrolled {
  float steps = 0.0f;  ///< of the wheel, away from the user
};
struct KeyChanged {
  int key = 0;  ///< GLFW's code
  bool down = false;
  bool repeated = false;
  unsigned mods = kNoMods;
};
struct TextTyped {
  char32_t character = 0;
};
struct FilesDropped {
  std::vector<std::string> paths;
};
struct CloseAsked {};

using Input = std::variant<PointerMoved, ButtonChanged, Scrolled, KeyChanged, TextTyped,
                           FilesDropped, CloseAsked>;

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
