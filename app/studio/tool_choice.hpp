#pragma once
// The tool chosen in the window. Each shape keeps its size, so that switching between shapes loses
// nothing.

#include "claystack/engine/scene.hpp"

#include <optional>

namespace clay::studio {

enum class Shape { sphere, ellipse, rib, own };

struct ToolChoice {
  Shape shape = Shape::sphere;
  ToolMode mode = ToolMode::press;
  SphereSpec sphere;
  EllipseSpec ellipse;
  RibSpec rib;
  SampledSpec own;  ///< from the scene that was opened; without points there is none
  double gap_mm = 6.0;
  /// Part of the wall where a pinch of the mouse begins, instead of gap_mm; 0: gap_mm.
  double gap_share = 0.0;
  friend bool operator==(const ToolChoice&, const ToolChoice&) = default;
};

inline constexpr double kSmallestToolMm = 0.5, kLargestToolMm = 60.0;
inline constexpr double kNarrowestGapMm = 0.5, kWidestPinchMm = 40.0;
inline constexpr double kLeastGapShare = 0.3, kMostGapShare = 0.95;

/// Name of a mode in the window.
[[nodiscard]] const char* name_of(ToolMode mode) noexcept;

/// The tool for a scene. A needle and a wire are as thin as tools can be. `inverted`: press instead
/// of trim, and trim instead of the other modes; needle, wire and foot trimming stay.
[[nodiscard]] ToolSpec tool_of(const ToolChoice& choice, bool inverted = false);

/// The tool of a scene; shapes that the scene does not use keep their sizes.
void choose(const ToolSpec& tool, ToolChoice& choice);

/// The size of the selected shape [mm]: radius of a sphere, half height of an ellipse, height of a
/// rib. None for a custom shape.
[[nodiscard]] std::optional<double> size_mm(const ToolChoice& choice);

/// Multiplies the size of the selected shape, within its limits.
void resize(ToolChoice& choice, double factor);

}  // namespace clay::studio
