#include "app/studio/gamepad.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

namespace clay::studio {
namespace {

using B = PadButton;

constexpr std::array kBindings = {
    PadBinding{B::a, "A", GLFW_KEY_SPACE, "help.show_step"},
    PadBinding{B::b, "B", GLFW_KEY_ESCAPE, "wheel.zero_force"},
    PadBinding{B::x, "X", 0, "view.cut_half"},
    PadBinding{B::y, "Y", 0, "view.home"},
    PadBinding{B::left_bumper, "LB", 0, "edit.undo"},
    PadBinding{B::right_bumper, "RB", 0, "edit.redo"},
    PadBinding{B::left, "Left", GLFW_KEY_LEFT, "tool.previous"},
    PadBinding{B::right, "Right", GLFW_KEY_RIGHT, "tool.next"},
    PadBinding{B::up, "Up", GLFW_KEY_UP, "tool.larger"},
    PadBinding{B::down, "Down", GLFW_KEY_DOWN, "tool.smaller"},
    PadBinding{B::start, "Start", 0, "wheel.pause"},
    PadBinding{B::back, "Back", GLFW_KEY_ESCAPE, "help.menu"},
    PadBinding{B::left_stick, "L3", 0, "view.farther"},
    PadBinding{B::right_stick, "R3", 0, "view.nearer"},
};

}  // namespace

std::span<const PadBinding> pad_bindings() { return kBindings; }

std::optional<PadButton> pad_button_of(std::string_view name) {
  const auto* found = std::ranges::find(kBindings, name, &PadBinding::name);
  if (found == kBindings.end()) return std::nullopt;
  return found->button;
}

}  // namespace clay::studio
