#pragma once
// Input of the window, from GLFW callbacks or from a script, in one queue, so that a script
// exercises the same handlers as a person. Keys have names: "Ctrl+Shift+Z", "F", "[", "Home".

#include "app/studio/gamepad.hpp"

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clay::studio {

/// Modifier keys as bits.
enum Mods : unsigned { kNoMods = 0, kShift = 1, kControl = 2, kAlt = 4 };

enum class MouseButton { left, right, middle };

struct PointerMoved {
  glm::vec2 place_px{0.0f};  ///< of the framebuffer, from its upper left corner
  /// Pressure of a pen, 0 to 1; none: a mouse or a finger.
  std::optional<double> strength = std::nullopt;
};
struct ButtonChanged {
  MouseButton button = MouseButton::left;
  bool down = false;
  unsigned mods = kNoMods;
};
struct Scrolled {
  float steps = 0.0f;  ///< scroll steps, positive away from the user
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
/// A gamepad has been connected, or disconnected.
struct GamepadPlugged {
  std::string name;  ///< empty: disconnected
};
struct GamepadChanged {
  GamepadState state;
};

using Input = std::variant<PointerMoved, ButtonChanged, Scrolled, KeyChanged, TextTyped,
                           FilesDropped, CloseAsked, GamepadPlugged, GamepadChanged>;

struct KeyChord {
  int key = 0;  ///< GLFW's code; 0: none
  unsigned mods = 0;
  friend bool operator==(const KeyChord&, const KeyChord&) = default;
};

/// The key by the letter or sign that the user's layout prints on it, so that Ctrl+Z is at the Z of
/// every keyboard. `key`: GLFW's code, which is that of a place on an American keyboard; `printed`:
/// the text that the layout prints there, or empty. Keys of other signs keep their places. Enter,
/// and + and - with Ctrl, are also on the number pad.
[[nodiscard]] int key_of_layout(int key, std::string_view printed, unsigned mods) noexcept;

/// "Ctrl+Shift+Z"; empty for none.
[[nodiscard]] std::string text_of(const KeyChord& chord);

/// The inverse; nothing for an unknown name.
[[nodiscard]] std::optional<KeyChord> chord_of(std::string_view text);

}  // namespace clay::studio
