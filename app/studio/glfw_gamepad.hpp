#pragma once
// The gamepad of a window on a screen: the first that GLFW has a layout for.

#include "app/studio/gamepad.hpp"

#include <optional>
#include <string>

namespace clay::studio {

/// After glfwInit. One at a time.
class GlfwGamepad {
 public:
  GlfwGamepad();
  ~GlfwGamepad();
  GlfwGamepad(const GlfwGamepad&) = delete;
  GlfwGamepad& operator=(const GlfwGamepad&) = delete;

  [[nodiscard]] bool connected() const noexcept { return id_ >= 0; }
  /// The name of the gamepad if it has been connected or disconnected (empty) since the last call.
  [[nodiscard]] std::optional<std::string> news();
  /// Its state if it has changed since the last call. Reads nothing if none is connected.
  [[nodiscard]] std::optional<GamepadState> changed();

 private:
  int id_ = -1;  // of GLFW; below 0: none
  GamepadState last_;
};

}  // namespace clay::studio
