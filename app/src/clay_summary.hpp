#pragma once
// What is on the wheel when the throwing is over, for people and for scripts.

#include "claystack/engine/wheel.hpp"
#include "console.hpp"

namespace clay::app {

[[nodiscard]] const char* name_of(Model model);

/// Rings, height, volume and its error, thinnest wall, collapse.
[[nodiscard]] Json clay_json(const Wheel& wheel, const Pot& pot);

/// `summary`: with the fields of clay_json.
void tell_collapse(const Console& console, const Json& summary);

}  // namespace clay::app
