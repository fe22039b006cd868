#pragma once
// What reaches the window from outside: from GLFW's callbacks, or from a script. One queue, so that
// a script drives the very handlers that a hand does.

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
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

}  // namespace clay::studio
