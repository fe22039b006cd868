#pragma once
// Converts values of the engine to views for drawing.

#include "app/render/picture.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/collapse.hpp"
#include "claystack/engine/tool.hpp"

namespace clay::render {

inline constexpr std::size_t kMaxRows = 2048;

/// One row per ring, crown included; above kMaxRows - 1 rings that many rows, with radii
/// interpolated between the nearest two rings.
[[nodiscard]] PotView view_of(const ClayStack& stack);
/// With the fallen part at its resting place.
[[nodiscard]] PotView view_of(const Pot& pot);

/// The same pot standing upside down.
[[nodiscard]] PotView turned(PotView view);

/// The rows of a view above the failed ring of `pot`.
[[nodiscard]] FallenView fallen_view(const Collapse& collapse, const PotView& view,
                                     const ClayStack& stack);
/// At a moment of the collapse (FallFrame).
[[nodiscard]] FallenView fallen_view(const Collapse& collapse, const FallFrame& frame,
                                     const PotView& view, const ClayStack& stack);

/// ToolView::half_profile_mm.
[[nodiscard]] std::vector<glm::vec2> half_profile_of(const Tool& tool);

}  // namespace clay::render
