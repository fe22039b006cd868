#pragma once
// What a script can ask the window.

#include "app/studio/app_state.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace clay::studio {

/// As text; numbers in the shortest form that reads back. Nothing for a name that is none of
/// docs/studio.md's.
[[nodiscard]] std::optional<std::string> fact(const AppState& shop, std::string_view name);

}  // namespace clay::studio
