#pragma once
// Ring-shaped openings, as between the two walls of a cup whose rim is missing. For the sources of
// this room only: it needs CGAL's headers.

#include "export/repair/half_edge_surface.hpp"

#include <vector>

namespace clay::solid::inline repair {

/// The border of a hole, in the direction of the triangles that fill it.
struct Border {
  std::vector<Surface::Halfedge_index> edges;
  std::vector<std::uint32_t> vertices;  ///< the sources of the edges
  std::vector<glm::dvec3> points;
  glm::dvec3 area{0.0};  ///< along the normal of those triangles [mm^2]
  glm::dvec3 low{0.0}, high{0.0};
};

Border border_from(const Surface& surface, Surface::Halfedge_index start);

/// The largest distance between two points of a border [mm]; of those with more than 10,000 points,
/// between a part of them.
double width_of(const Border& border);

/// By border: the number of the one around it, if both lie in one plane and the other one's patch
/// would face the opposite way; otherwise its own number.
std::vector<std::size_t> borders_around(const std::vector<Border>& borders);

/// Fills the ring between an outer border and those that it encloses. Returns the new triangles,
/// none if the borders cross each other in the plane.
std::vector<Surface::Face_index> fill_ring(Surface& surface, const Border& outer,
                                           const std::vector<const Border*>& inner);

}  // namespace clay::solid::inline repair
