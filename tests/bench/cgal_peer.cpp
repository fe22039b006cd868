#include "tests/bench/cgal_peer.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <vector>

namespace clay::bench {

namespace pmp = CGAL::Polygon_mesh_processing;

bool cgal_finds_defect(const solid::TriangleMesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> points;
  points.reserve(mesh.points.size());
  for (const glm::dvec3& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  pmp::polygon_soup_to_polygon_mesh(points, mesh.triangles, surface);
  return pmp::does_self_intersect(surface);
}

}  // namespace clay::bench
