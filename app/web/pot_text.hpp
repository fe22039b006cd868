#pragma once
// The pot on the wheel in words, for people who do not see the picture.

#include "app/studio/app_state.hpp"

#include <optional>
#include <string>

namespace clay::web {

/// The notice that is shown, or the main figures and the verdict, in one sentence or two. Empty
/// optional: a stroke, a demonstration or a check is in progress, so the text would soon change.
[[nodiscard]] std::optional<std::string> summary_of(const studio::AppState& state);

/// The figures of the panels, one a line: pot, walls, proof, clay.
[[nodiscard]] std::string report_of(const studio::AppState& state);

}  // namespace clay::web
