#pragma once
// The solid of a section for CAD: few exact surfaces of revolution in place of triangles.

#include "claystack/core/result.hpp"
#include "claystack/export/section.hpp"
#include "claystack/export/solid.hpp"
#include "export/solid/wall_curve.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace clay::solid {

/// A part of a section, with clay on its left: straight, or a curve.
struct BrepWall {
  ProfilePoint from, to;
  std::optional<WallCurve> curve;

  /// Sweeps a part of a plane: one face; every other wall sweeps two halves.
  [[nodiscard]] bool flat() const noexcept { return !curve && from.y == to.y; }
};

/// Walls in order: from pole to pole, or all around.
using BrepShell = std::vector<BrepWall>;

/// The first shell bounds the clay from outside, the others are closed cavities.
using BrepBody = std::vector<BrepShell>;

struct RevolvedBrep {
  std::vector<BrepBody> bodies;  ///< one for each piece
  double deviation_mm = 0.0;     ///< proved bound of the distance from the section, either way
  double volume_mm3 = 0.0;       ///< by closed form, of the numbers as written

  [[nodiscard]] std::size_t faces() const noexcept;
  /// False if all walls are straight: then `flattened` is exact.
  [[nodiscard]] bool curved() const noexcept;
  /// The section with curves replaced by lines within `error_mm` of them.
  [[nodiscard]] Profile flattened(double error_mm) const;
};

/// Coordinates are multiples of this [mm], so that their decimals are exact enough.
inline constexpr double kBrepGridMm = 1e-9;
/// The inner control points of curves, whose places do not matter to that degree, are multiples of
/// this, or of a finer one for small tolerances, apart from the one that corrects the volume.
inline constexpr double kControlGridMm = 1e-4;

/// Requires a certified profile. With StepWalls::spline, walls between corners of more than 30
/// degrees become one curve each, and the largest curve of a piece is moved so that the piece holds
/// the volume of its polygon. Errors: `bad_input` if no curve is within the tolerance; `unsound`
/// for a surface that meets the axis in a point.
Result<RevolvedBrep> revolved_brep(const Profile& profile, StepWalls walls, double tolerance_mm);

}  // namespace clay::solid
