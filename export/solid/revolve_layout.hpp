#pragma once
// How a profile becomes triangles: which vertices there are, and in which order triangles join
// them. Whoever meshes, streams or verifies a revolve goes by this rule.

#include "claystack/export/section.hpp"
#include "claystack/export/solid.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace clay::solid {

/// Between two points of a shell that follow each other, numbered as in `Shell::points`. Clay lies
/// to the left of the way from the one to the other.
struct Band {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// A closed surface of the revolve. Its triangles come sector by sector, in a sector band by band,
/// and in a band from_s, from_s+1, to_s before from_s+1, to_s+1, to_s; one that a pole leaves
/// without area is not there. The diagonals lean this way for Draco, which turns right at every
/// new vertex: going around the pot it then comes across a diagonal, where the parallelogram that
/// predicts the vertex is nearly flat, and not across a meridian, where the wall bends.
struct Shell {
  std::vector<ProfilePoint> points;
  std::vector<Band> bands;

  [[nodiscard]] bool pole(std::size_t point) const noexcept { return points[point].rho == 0.0; }
  /// Triangles in one sector.
  [[nodiscard]] std::size_t triangles_per_sector() const noexcept;
};

class RevolveLayout {
 public:
  /// Needs a certified profile and kMinSegments <= segments <= kMaxSegments.
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

/// As the public `revolve`.
[[nodiscard]] TriangleMesh revolve(const RevolveLayout& rule);

/// sqrt((2 pi/n) / sin(2 pi/n)): an n-gon of that radius has the area of the unit circle.
[[nodiscard]] double equal_area_factor(std::size_t segments) noexcept;

/// Largest move [mm] of a vertex when its coordinates are rounded to float32.
[[nodiscard]] double float_rounding_mm(const RevolveLayout& rule) noexcept;

}  // namespace clay::solid
