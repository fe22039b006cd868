#pragma once
// Approximates curves by chords within kFlatMm.

#include "app/import/drawing.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace clay::importing {

/// Each appends the points after the first, which is already there.
void append_cubic(std::vector<glm::dvec2>& points, glm::dvec2 a, glm::dvec2 b, glm::dvec2 c,
                  glm::dvec2 d);

/// The ellipse centre + cos(t) u + sin(t) v, from t = `from` to `to` [rad], in either direction.
void append_arc(std::vector<glm::dvec2>& points, glm::dvec2 centre, glm::dvec2 u, glm::dvec2 v,
                double from, double to);

/// A circular arc: centre + cos(t) u + sin(t) v, t from 0 to `turn` [rad].
struct BulgeArc {
  glm::dvec2 centre{0.0}, u{0.0}, v{0.0};
  double turn = 0.0;
};

/// The arc of a polyline's bulge: the tangent of a quarter of its angle, positive to the left; not
/// zero.
[[nodiscard]] BulgeArc bulge_arc(glm::dvec2 from, glm::dvec2 to, double bulge);

/// A rational B-spline: control points (x, y, weight), degree + points + 1 non-decreasing knots.
[[nodiscard]] std::vector<glm::dvec2> spline_points(std::size_t degree,
                                                    std::span<const glm::dvec3> control,
                                                    std::span<const double> knots);

}  // namespace clay::importing
