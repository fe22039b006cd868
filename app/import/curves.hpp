#pragma once
// Curves as chords that stay within kFlatMm of them.

#include "app/import/drawing.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace clay::importing {

/// Each appends the points after the first, which is there already.
void append_cubic(std::vector<glm::dvec2>& points, glm::dvec2 a, glm::dvec2 b, glm::dvec2 c,
                  glm::dvec2 d);

/// Of the ellipse centre + cos(t) u + sin(t) v, from t = `from` to `to` [rad], either way round.
void append_arc(std::vector<glm::dvec2>& points, glm::dvec2 centre, glm::dvec2 u, glm::dvec2 v,
                double from, double to);

/// The circular arc of a polyline's bulge: the tangent of a quarter of its angle, left turns
/// positive.
void append_bulge(std::vector<glm::dvec2>& points, glm::dvec2 from, glm::dvec2 to, double bulge);

/// A rational B-spline: control points (x, y, weight), degree + points + 1 knots that never fall.
[[nodiscard]] std::vector<glm::dvec2> spline_points(std::size_t degree,
                                                    std::span<const glm::dvec3> control,
                                                    std::span<const double> knots);

}  // namespace clay::importing
