#pragma once
// The half section that the cuts of a mesh have in common.

#include "app/import/half_section.hpp"
#include "app/import/mesh_axis.hpp"
#include "app/import/mesh_cuts.hpp"

namespace clay::importing {

/// Moves the axis so that the outside is centred about it at all heights, except where it is far
/// from the middle of all azimuths, as a handle is.
[[nodiscard]] MeshAxis refined_axis(const solid::TriangleMesh& mesh, MeshAxis axis);

/// A half section, and the place of its foot on the axis.
struct RevolvedSection {
  HalfSection section;
  double foot_mm = 0.0;
};

/// At each height between the levels of the mesh's points: the mean of the squared radii of all
/// cuts that agree with the middle one. `noise_mm`: standard deviation of the points of a scan,
/// within which faces are level; 0: the points have no noise. Refuses meshes with a height at which
/// most cuts have no clay.
Result<RevolvedSection> revolved_section(std::span<const glm::dvec3> points,
                                         const std::vector<std::vector<Segment>>& cuts,
                                         double noise_mm, const std::string& name);

}  // namespace clay::importing
