#pragma once
// Facts about the window, for the scripts' `expect`. docs/studio.md lists them.

#include "app/studio/app_state.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::studio {

/// A fact about the window as text; numbers in the shortest form that reads back. Empty for a name
/// that is not in docs/studio.md.
[[nodiscard]] std::optional<std::string> fact(const AppState& state, std::string_view name);
[[nodiscard]] std::vector<std::string_view> fact_names();

}  // namespace clay::studio
