#pragma once
// Smooth walls for CAD: a cubic B-spline in the half-plane, fitted to a line of points within a
// distance that is proved.

#include "claystack/export/section.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace clay::solid {

/// Begins at the first control point and ends at the last.
struct WallCurve {
  std::vector<double> knots;          ///< 0, ..., 1: dyadic, simple; the ends count fourfold
  std::vector<ProfilePoint> control;  ///< two more than knots

  [[nodiscard]] std::size_t spans() const noexcept { return knots.size() - 1; }
  /// The Bezier points of the part from `a` to `b` of one span.
  [[nodiscard]] std::array<ProfilePoint, 4> bezier(std::size_t span, double a, double b) const;
};

/// The curve of least squares from the first to the last point, with as few knots as halving spans
/// finds for this distance. Where a knot for every 2^-20 of the length is too few, the distance is
/// larger; `distance_bound` computes it.
[[nodiscard]] WallCurve fitted(const Polygon& line, double tolerance_mm);

/// Upper bound of the distance [mm] between points of the curve and of the line at equal shares of
/// its length, and so of the distance between both, either way: the difference is a cubic between
/// knots and points, and lies within the hull of its Bezier points.
[[nodiscard]] double distance_bound(const WallCurve& curve, const Polygon& line);

/// Volume [mm^3] between the curve and the axis, revolved once, positive upward; exact up to
/// rounding, because Gauss' rule integrates the polynomial of degree 8 exactly.
[[nodiscard]] double swept_volume(const WallCurve& curve);

/// Points on the curve whose line is within `error_mm` of it; the ends included.
[[nodiscard]] Polygon flattened(const WallCurve& curve, double error_mm);

}  // namespace clay::solid
