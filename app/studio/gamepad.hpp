#pragma once
// A gamepad with the layout of an Xbox controller: its state, and the effects of its buttons.

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string_view>

namespace clay::studio {

/// In the order of GLFW.
enum class PadButton : unsigned {
  a,
  b,
  x,
  y,
  left_bumper,
  right_bumper,
  back,
  start,
  guide,
  left_stick,
  right_stick,
  up,
  right,
  down,
  left
};
inline constexpr std::size_t kPadButtons = 15;

[[nodiscard]] constexpr unsigned bit_of(PadButton button) noexcept {
  return 1u << static_cast<unsigned>(button);
}

struct GamepadState {
  glm::dvec2 left_stick{0.0}, right_stick{0.0};    ///< x to the right, y up, within +-1
  double left_trigger = 0.0, right_trigger = 0.0;  ///< 0 to 1
  unsigned buttons = 0;                            ///< bit_of each pressed button
  friend bool operator==(const GamepadState&, const GamepadState&) = default;
};

/// The effect of a button.
struct PadBinding {
  PadButton button;
  std::string_view name;     ///< "LB"
  int key;                   ///< in menus and dialogs: the key of GLFW that it stands for; 0: none
  std::string_view command;  ///< over the clay: an id of the table of commands
};
[[nodiscard]] std::span<const PadBinding> pad_bindings();
/// Nothing for an unknown name.
[[nodiscard]] std::optional<PadButton> pad_button_of(std::string_view name);

}  // namespace clay::studio
