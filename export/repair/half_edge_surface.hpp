#pragma once
// CGAL's half-edge mesh. Requires CGAL's headers: for the sources of this room only.

#include "export/solid/mesh_topology.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Surface_mesh.h>
#include <vector>

namespace clay::solid::inline repair {

using SurfaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfacePoint = SurfaceKernel::Point_3;
using Surface = CGAL::Surface_mesh<SurfacePoint>;

inline glm::dvec3 point_of(const SurfacePoint& p) { return {p.x(), p.y(), p.z()}; }

/// The connected parts of a surface.
struct Shells {
  explicit Shells(const Surface& surface)
      : of_face(surface.number_of_faces()),
        count(CGAL::Polygon_mesh_processing::connected_components(
            surface,
            boost::make_iterator_property_map(of_face.begin(), get(boost::face_index, surface)))) {}
  std::vector<std::size_t> of_face;
  std::size_t count;
};

}  // namespace clay::solid::inline repair
