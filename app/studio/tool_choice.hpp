#pragma once
// The tool as it is chosen at the window: each shape keeps its own size, so that changing to and
// fro loses nothing.

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
  SampledSpec own;  ///< of the scene that was opened; without points there is none
  double gap_mm = 6.0;
  friend bool operator==(const ToolChoice&, const ToolChoice&) = default;
};

inline constexpr double kSmallestToolMm = 0.5, kLargestToolMm = 60.0;
inline constexpr double kNarrowestGapMm = 0.5, kWidestPinchMm = 40.0;

/// For a scene. `inverted`: press instead of trim, and trim instead of the others.
[[nodiscard]] ToolSpec tool_of(const ToolChoice& choice, bool inverted = false);

/// From a scene, keeping the sizes of the shapes that it has not.
void choose(const ToolSpec& tool, ToolChoice& choice);

/// What names the present shape's size [mm]: a sphere's radius, an ellipse's half height, a rib's
/// height. None for points of a scene's own.
[[nodiscard]] std::optional<double> size_mm(const ToolChoice& choice);

/// Multiplies the present shape's size, within its limits.
void resize(ToolChoice& choice, double factor);

}  // namespace clay::studio
