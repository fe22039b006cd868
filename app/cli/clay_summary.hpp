#pragma once
// A summary of the clay after throwing, for people and for scripts.

#include "app/cli/console.hpp"
#include "app/cli/json_output.hpp"
#include "claystack/engine/wheel.hpp"

#include <string_view>

namespace clay::cli {

/// Printed after a throw without -o.
inline constexpr std::string_view kPotNotWritten = "pot: not written; -o NAME.pot.json writes it";

[[nodiscard]] const char* name_of(Model model);

/// Rings, height, volume and its error, minimum wall, the numbers of a maker, the pieces and the
/// heights at which they part, collapse. Wall, numbers and pieces are those of the default export
/// with --pieces; null for a pot that cannot be exported, and the wall of one that collapsed.
[[nodiscard]] Json clay_json(const Pot& pot);

/// Size, weight, capacity, wall and verdict, and how it fell. `summary` has the fields of
/// clay_json.
void print_clay(const Console& console, const Json& summary);

}  // namespace clay::cli
