#pragma once
// From the engine's values to what is drawn of them.

#include "app/render/picture.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/collapse.hpp"
#include "claystack/engine/tool.hpp"

namespace clay::render {

inline constexpr std::size_t kMaxRows = 2048;

/// A row for each ring, crown included; of more than kMaxRows - 1 rings so many rows, radii in
/// between taken from the nearest two rings.
[[nodiscard]] PotView view_of(const ClayStack& stack);
/// With the fallen part where it came to rest.
[[nodiscard]] PotView view_of(const Pot& pot);

/// Where rows of a view are that stood above the failed ring of `pot`.
[[nodiscard]] FallenView fallen_view(const Collapse& collapse, const PotView& view,
                                     const ClayStack& stack);
/// At a moment of the fall (engine/fall.hpp).
[[nodiscard]] FallenView fallen_view(const Collapse& collapse, const FallFrame& frame,
                                     const PotView& view, const ClayStack& stack);

/// ToolView::half_profile_mm.
[[nodiscard]] std::vector<glm::vec2> half_profile_of(const Tool& tool);

}  // namespace clay::render
