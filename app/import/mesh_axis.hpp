#pragma once
// The axis of a mesh that is nearly a surface of revolution.

#include "claystack/export/solid.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace clay::importing {

struct MeshAxis {
  glm::dvec3 through{0.0};              ///< a point on it, beside the middle of the mesh [mm]
  glm::dvec3 direction{0.0, 0.0, 1.0};  ///< unit, upward
};

/// The line that the normals of the triangles meet best, weighted by area, with those that miss it
/// by far left out step by step (Pottmann, Wallner, "Computational Line Geometry", 2001: normals of
/// a surface of revolution meet its axis). The largest component of its direction is positive;
/// z wins a tie.
[[nodiscard]] MeshAxis fitted_axis(const solid::TriangleMesh& mesh);

/// Right-angled coordinates with the axis as z; x is as near as possible to the file's x, or to its
/// y if the axis is nearly x.
[[nodiscard]] glm::dmat3 frame_of(const MeshAxis& axis);

/// The points in that frame, from the axis.
[[nodiscard]] std::vector<glm::dvec3> about_axis(const solid::TriangleMesh& mesh,
                                                 const MeshAxis& axis);

}  // namespace clay::importing
