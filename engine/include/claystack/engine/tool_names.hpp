#pragma once
// The names of tools in scene files, works and lists.

#include "claystack/engine/scene.hpp"

#include <array>
#include <cstddef>
#include <string_view>
#include <variant>

namespace clay {

/// In the order of `ToolSpec::shape`.
inline constexpr std::array<std::string_view, 4> kToolShapeNames = {"sphere", "ellipse", "rib",
                                                                    "sampled"};
/// In the order of `ToolMode`.
inline constexpr std::array<std::string_view, 7> kToolModeNames = {
    "press", "trim", "pinch", "smooth", "needle", "wire", "trim_foot"};

static_assert(kToolShapeNames.size() == std::variant_size_v<decltype(ToolSpec::shape)>);
static_assert(kToolModeNames.size() == static_cast<std::size_t>(ToolMode::trim_foot) + 1);

}  // namespace clay
