#include "app/studio/glfw_gamepad.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

namespace clay::studio {
namespace {

bool devices_changed = false;  // callbacks of GLFW have no pointer to user data

static_assert(static_cast<int>(PadButton::left) == GLFW_GAMEPAD_BUTTON_DPAD_LEFT &&
              static_cast<int>(PadButton::back) == GLFW_GAMEPAD_BUTTON_BACK &&
              kPadButtons == GLFW_GAMEPAD_BUTTON_LAST + 1);

GamepadState state_of(const GLFWgamepadstate& glfw) {
  const auto axis = [&](int index) { return static_cast<double>(glfw.axes[index]); };
  GamepadState state;
  state.left_stick = {axis(GLFW_GAMEPAD_AXIS_LEFT_X), -axis(GLFW_GAMEPAD_AXIS_LEFT_Y)};
  state.right_stick = {axis(GLFW_GAMEPAD_AXIS_RIGHT_X), -axis(GLFW_GAMEPAD_AXIS_RIGHT_Y)};
  state.left_trigger = 0.5 * (axis(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER) + 1.0);
  state.right_trigger = 0.5 * (axis(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER) + 1.0);
  for (std::size_t i = 0; i < kPadButtons; ++i)
    if (glfw.buttons[i] == GLFW_PRESS) state.buttons |= 1u << i;
  return state;
}

}  // namespace

GlfwGamepad::GlfwGamepad() {
  devices_changed = true;  // those that were connected before
  glfwSetJoystickCallback([](int, int) { devices_changed = true; });
}

GlfwGamepad::~GlfwGamepad() { glfwSetJoystickCallback(nullptr); }

std::optional<std::string> GlfwGamepad::news() {
  if (!std::exchange(devices_changed, false)) return std::nullopt;
  if (id_ >= 0 && glfwJoystickIsGamepad(id_) == GLFW_TRUE) return std::nullopt;
  const bool lost = id_ >= 0;
  id_ = -1;
  last_ = {};
  for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST && id_ < 0; ++id)
    if (glfwJoystickIsGamepad(id) == GLFW_TRUE) id_ = id;
  if (id_ >= 0) return std::string(glfwGetGamepadName(id_));
  return lost ? std::optional(std::string()) : std::nullopt;
}

std::optional<GamepadState> GlfwGamepad::changed() {
  GLFWgamepadstate glfw;
  if (id_ < 0 || glfwGetGamepadState(id_, &glfw) != GLFW_TRUE) return std::nullopt;
  const GamepadState now = state_of(glfw);
  if (now == last_) return std::nullopt;
  return last_ = now;
}

}  // namespace clay::studio
