#include "export/repair/hole_filling.hpp"

#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/solid/cgal_versions.hpp"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <set>

namespace clay::solid::inline repair {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Face = Surface::Face_index;
using HalfEdge = Surface::Halfedge_index;

/// Above this, the search for the best triangles between n vertices, which takes n^3 steps, is
/// replaced by one in the plane, or by a faster one.
constexpr std::size_t kMostForCubicSearch = 200;

glm::dvec3 normal_of(const Surface& surface, HalfEdge h) {
  const glm::dvec3 a = point_of(surface.point(surface.source(h)));
  const glm::dvec3 b = point_of(surface.point(surface.target(h)));
  const glm::dvec3 c = point_of(surface.point(surface.target(surface.next(h))));
  return glm::cross(b - a, c - a);
}

/// The part of the border [0, 1] where the patch and the surface meet at more than 60 degrees.
double rim_of(const Surface& surface, const std::vector<HalfEdge>& border) {
  double length = 0.0, rim = 0.0;
  for (const HalfEdge h : border) {
    const double side = glm::distance(point_of(surface.point(surface.source(h))),
                                      point_of(surface.point(surface.target(h))));
    const glm::dvec3 cap = normal_of(surface, h), wall = normal_of(surface, surface.opposite(h));
    length += side;
    if (glm::dot(cap, wall) < 0.5 * glm::length(cap) * glm::length(wall)) rim += side;
  }
  return length > 0.0 ? rim / length : 0.0;
}

struct Patch {
  FilledHole hole;
  std::vector<Face> faces;
  std::vector<HalfEdge> border;
};

Patch fill(Surface& surface, HalfEdge start) {
  Patch patch;
  glm::dvec3 low(INFINITY), high(-INFINITY);
  for (const HalfEdge h : surface.halfedges_around_face(start)) {
    patch.border.push_back(h);
    const glm::dvec3 p = point_of(surface.point(surface.target(h)));
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  patch.hole.edges = patch.border.size();
  patch.hole.extent_mm = glm::distance(low, high);
  patch.hole.place = 0.5 * (low + high);
  if (patch.hole.edges > kMaxHoleEdges) return patch;
  const bool many = patch.hole.edges > kMostForCubicSearch;
  const auto close = [&, faces = std::back_inserter(patch.faces)](const auto& options) {
    if constexpr (cgal::kHoleFacesAreAnOption)
      pmp::triangulate_hole(surface, start, options.face_output_iterator(faces));
    else
      pmp::triangulate_hole(surface, start, faces, options);
  };
  close(
      CGAL::parameters::use_2d_constrained_delaunay_triangulation(many).do_not_use_cubic_algorithm(
          many));
  for (const Face face : patch.faces)
    patch.hole.area_mm2 += 0.5 * glm::length(normal_of(surface, surface.halfedge(face)));
  return patch;
}

std::string size_and_place(const FilledHole& hole) {
  return in_mm(hole.extent_mm) + " mm wide at (" + in_mm(hole.place.x) + ", " +
         in_mm(hole.place.y) + ", " + in_mm(hole.place.z) + ") mm";
}

tl::unexpected<Error> wide_opening(const FilledHole& hole) {
  return failure(ErrorKind::unsound, "expected small holes, found an opening " +
                                         size_and_place(hole) +
                                         ": the mesh may be a surface without a wall. "
                                         "--thicken MM gives it one, --cap closes it by a cap");
}

}  // namespace

Result<FilledHoles> fill_holes(Surface& surface, bool cap_openings) {
  constexpr double kWideShare = 0.02, kRimShare = 0.75;
  std::vector<HalfEdge> holes;
  pmp::extract_boundary_cycles(surface, std::back_inserter(holes));
  std::vector<Patch> patches;
  for (const HalfEdge start : holes) {
    stop_if_cancelled();
    patches.push_back(fill(surface, start));
  }
  double area = 0.0;
  for (const Face face : surface.faces())
    area += 0.5 * glm::length(normal_of(surface, surface.halfedge(face)));
  FilledHoles result;
  for (const Patch& patch : patches) {
    if (patch.faces.empty()) {
      if (!result.left) result.left = patch.hole;
      continue;
    }
    if (!cap_openings && patch.hole.edges > 3 && patch.hole.area_mm2 > kWideShare * area &&
        rim_of(surface, patch.border) > kRimShare)
      return wide_opening(patch.hole);
    result.filled.push_back(patch.hole);
  }
  return result;
}

tl::unexpected<Error> unfilled(const FilledHole& hole) {
  const std::string found = "found one of " + counted(hole.edges, "edge") + ", " +
                            size_and_place(hole) + "; --wrap MM makes a new surface";
  if (hole.edges > kMaxHoleEdges)
    return failure(ErrorKind::unsound, "expected holes of at most " +
                                           std::to_string(kMaxHoleEdges) + " edges, " + found);
  return failure(ErrorKind::unsound,
                 "expected holes that triangles between their vertices fill, " + found);
}

}  // namespace clay::solid::inline repair
