#pragma once
// Edges and surfaces of a solid of revolution, from the entities of a STEP file.

#include "export/formats/step_entities.hpp"
#include "export/solid/wall_curve.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

/// A circle around the axis, or a point of a meridian: distance from the axis and height [mm].
struct StepLevel {
  double rho = 0.0, z = 0.0;
  /// Within 1e-6 mm.
  [[nodiscard]] bool is(const StepLevel& other) const noexcept;
};

struct StepEdge {
  std::array<std::string_view, 2> vertices;  ///< references
  bool circle = false;
  std::vector<StepLevel> levels;  ///< the circle; the ends of a line; the control points of a curve
  std::vector<double> knots;      ///< of a curve
};

/// A surface around the axis.
struct StepSurface {
  bool plane = false;
  double up = 1.0;  ///< direction of the normal of a plane, and of the axis of a cone
  StepLevel at;     ///< height of a plane; a circle of a cone or cylinder
  double slope = 0.0;
  std::optional<WallCurve> curve;

  /// Within 1e-6 mm.
  [[nodiscard]] bool has(const StepEdge& edge) const noexcept;
  /// The first or last circle of a curve.
  [[nodiscard]] StepLevel end(bool last) const noexcept;
};

/// An edge between its two vertices. Throws `BadStep`.
[[nodiscard]] StepEdge step_edge(const StepEntities& step, std::string_view ref);

/// A plane, cylinder, cone or half a turn of a curve. Throws `BadStep`.
[[nodiscard]] StepSurface step_surface(const StepEntities& step, std::string_view ref);

}  // namespace clay::solid::inline formats
