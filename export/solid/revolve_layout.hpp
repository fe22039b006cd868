#pragma once
// The layout of a revolve: its vertices, and the order of its triangles. Meshing, streaming and
// verification all use it.

#include "claystack/export/section.hpp"
#include "claystack/export/solid.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace clay::solid {

/// The surface between two consecutive points of a shell, numbered as in `Shell::points`. Clay lies
/// to the left of the direction from one to the other.
struct Band {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// A closed surface of the revolve. Its triangles are ordered by sector, then by band; in a band
/// from_s, from_s+1, to_s precedes from_s+1, to_s+1, to_s; degenerate triangles at a pole are
/// omitted. The diagonals suit Draco, which turns right at every new vertex: going around the pot
/// it then crosses a diagonal, where the parallelogram that predicts the vertex is nearly flat, and
/// not a meridian, where the wall bends.
struct Shell {
  std::vector<ProfilePoint> points;
  std::vector<Band> bands;

  [[nodiscard]] bool pole(std::size_t point) const noexcept { return points[point].rho == 0.0; }
  /// Number of triangles in one sector.
  [[nodiscard]] std::size_t triangles_per_sector() const noexcept;
};

class RevolveLayout {
 public:
  /// Requires a certified profile and kMinSegments <= segments <= kMaxSegments.
  RevolveLayout(const Profile& profile, std::size_t segments);

  [[nodiscard]] const std::vector<Shell>& shells() const noexcept { return shells_; }
  [[nodiscard]] std::size_t segments() const noexcept { return circle_.size(); }
  [[nodiscard]] std::size_t triangles() const noexcept;
  [[nodiscard]] std::size_t vertices() const noexcept;
  /// Directions of the sectors, times the equal-volume factor.
  [[nodiscard]] const std::vector<glm::dvec2>& circle() const noexcept { return circle_; }
  /// z up; no -0.
  [[nodiscard]] glm::dvec3 vertex(const ProfilePoint& point, std::size_t sector) const noexcept {
    const glm::dvec2& direction = circle_[sector];
    return {point.rho * direction.x + 0.0, point.rho * direction.y + 0.0, point.y + 0.0};
  }

 private:
  std::vector<Shell> shells_;
  std::vector<glm::dvec2> circle_;
};

/// Like the public `revolve`.
[[nodiscard]] TriangleMesh revolve(const RevolveLayout& rule);

/// sqrt((2 pi/n) / sin(2 pi/n)): an n-gon of that radius has the area of the unit circle.
[[nodiscard]] double equal_area_factor(std::size_t segments) noexcept;

/// Largest displacement [mm] of a vertex when its coordinates are rounded to float32.
[[nodiscard]] double float_rounding_mm(const RevolveLayout& rule) noexcept;

}  // namespace clay::solid
