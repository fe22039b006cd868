#include "export/repair/hole_filling.hpp"

#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/repair/border_rings.hpp"
#include "export/solid/cgal_versions.hpp"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <utility>

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
  bool ring = false;     ///< between two borders in one plane
  bool twisted = false;  ///< a border of a surface with one side, which was cut to orient it
};

/// Of the border, and of those inside it.
Patch patch_of(const Border& border) {
  Patch patch;
  patch.border = border.edges;
  patch.hole.edges = border.edges.size();
  patch.hole.extent_mm = width_of(border);
  patch.hole.place = 0.5 * (border.low + border.high);
  return patch;
}

void measure(const Surface& surface, Patch& patch) {
  for (const Face face : patch.faces)
    patch.hole.area_mm2 += 0.5 * glm::length(normal_of(surface, surface.halfedge(face)));
}

Patch filled(Surface& surface, const Border& border) {
  Patch patch = patch_of(border);
  if (patch.hole.edges > kMaxHoleEdges) return patch;
  const bool many = patch.hole.edges > kMostForCubicSearch;
  const auto close = [&, faces = std::back_inserter(patch.faces)](const auto& options) {
    if constexpr (cgal::kHoleFacesAreAnOption)
      pmp::triangulate_hole(surface, border.edges.front(), options.face_output_iterator(faces));
    else
      pmp::triangulate_hole(surface, border.edges.front(), faces, options);
  };
  close(
      CGAL::parameters::use_2d_constrained_delaunay_triangulation(many).do_not_use_cubic_algorithm(
          many));
  measure(surface, patch);
  return patch;
}

/// The ring between a border and those inside it. Without faces if they cross.
Patch filled_ring(Surface& surface, const Border& outer, const std::vector<const Border*>& inner) {
  Patch patch = patch_of(outer);
  patch.ring = true;
  for (const Border* border : inner) {
    patch.border.insert(patch.border.end(), border->edges.begin(), border->edges.end());
    patch.hole.edges += border->edges.size();
  }
  if (patch.hole.edges > kMaxHoleEdges) return patch;
  patch.faces = fill_ring(surface, outer, inner);
  measure(surface, patch);
  return patch;
}

/// Borders of surfaces with one side, as a Moebius strip. Such a surface was cut open to orient it,
/// and both sides of the cut run in one direction, so that they do not close each other.
std::vector<bool> twisted(const Surface& surface, const std::vector<Border>& borders) {
  using Edge = std::pair<SurfacePoint, SurfacePoint>;
  std::map<Edge, int> one_way, other_way;
  for (const Border& border : borders)
    for (const HalfEdge h : border.edges) {
      const SurfacePoint &from = surface.point(surface.source(h)),
                         &to = surface.point(surface.target(h));
      ++one_way[{from, to}];
      ++other_way[{to, from}];
    }
  std::vector<bool> found;
  for (const Border& border : borders)
    found.push_back(std::ranges::any_of(border.edges, [&](const HalfEdge h) {
      const Edge edge{surface.point(surface.source(h)), surface.point(surface.target(h))};
      return one_way.at(edge) == 2 && !other_way.contains(edge);
    }));
  return found;
}

/// Fills each border, or the ring between it and those inside it.
std::vector<Patch> filled_borders(Surface& surface) {
  std::vector<HalfEdge> holes;
  pmp::extract_boundary_cycles(surface, std::back_inserter(holes));
  std::vector<Border> borders;
  for (const HalfEdge start : holes) borders.push_back(border_from(surface, start));
  const std::vector<bool> one_sided = twisted(surface, borders);
  const std::vector<std::size_t> around = borders_around(borders);
  std::vector<std::vector<const Border*>> inside(borders.size());
  for (std::size_t i = 0; i < borders.size(); ++i)
    if (around[i] != i && around[around[i]] == around[i]) inside[around[i]].push_back(&borders[i]);
  std::vector<Patch> patches;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    stop_if_cancelled();
    if (around[i] != i && around[around[i]] == around[i]) continue;
    Patch ring;
    if (!inside[i].empty()) ring = filled_ring(surface, borders[i], inside[i]);
    if (!ring.faces.empty()) {
      patches.push_back(std::move(ring));
      continue;
    }
    patches.push_back(filled(surface, borders[i]));
    patches.back().twisted = one_sided[i];
    for (const Border* border : inside[i]) patches.push_back(filled(surface, *border));
  }
  return patches;
}

/// Four digits: the places of the points are known better, but a reader compares the sizes.
std::string four_digits(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return short_number_text(value);
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 3.0);
  return short_number_text(std::round(value / unit) * unit);
}

std::string size_and_place(const FilledHole& hole) {
  return four_digits(hole.extent_mm) + " mm wide at (" + nine_digit_text(hole.place.x) + ", " +
         nine_digit_text(hole.place.y) + ", " + nine_digit_text(hole.place.z) + ") mm";
}

tl::unexpected<Error> missing_part(const Patch& patch) {
  return failure(ErrorKind::unsound, "expected small holes, found one " +
                                         size_and_place(patch.hole) +
                                         " in a mesh with missing facets: read the complete file, "
                                         "or " +
                                         kCapping + " closes the hole by a cap");
}

tl::unexpected<Error> wide_opening(const Patch& patch) {
  const std::string place = size_and_place(patch.hole);
  if (patch.twisted)
    return failure(
        ErrorKind::unsound,
        "expected a surface with an inside and an outside, found one with a single side, "
        "as a Moebius strip, " +
            place + ": it is a surface without a wall; " + kThickening + " gives it one");
  if (patch.ring)
    return failure(
        ErrorKind::unsound,
        "expected small holes, found an opening between two borders in one plane, one "
        "around the other, " +
            place + ": the mesh may be a wall without its rim, which " + kCapping +
            " closes by a ring between the borders, or a surface without a wall, which " +
            kThickening + " gives one");
  return failure(ErrorKind::unsound, "expected small holes, found an opening " + place +
                                         ": the mesh may be a surface without a wall; " +
                                         kThickening + " gives it one, " + kCapping +
                                         " closes it by a cap");
}

}  // namespace

Result<FilledHoles> fill_holes(Surface& surface, Openings openings) {
  constexpr double kWideShare = 0.02, kRimShare = 0.75;
  const std::vector<Patch> patches = filled_borders(surface);
  double area = 0.0;
  for (const Face face : surface.faces())
    area += 0.5 * glm::length(normal_of(surface, surface.halfedge(face)));
  FilledHoles result;
  std::vector<Face> removed;
  for (const Patch& patch : patches) {
    if (patch.faces.empty()) {
      if (!result.left) result.left = patch.hole;
      continue;
    }
    const bool wide = patch.hole.edges > 3 && patch.hole.area_mm2 > kWideShare * area;
    if (wide && patch.twisted && openings != Openings::closed) return wide_opening(patch);
    const bool is_opening = wide && rim_of(surface, patch.border) > kRimShare;
    if (wide && openings == Openings::all_refused) return missing_part(patch);
    if (is_opening && openings == Openings::refused) return wide_opening(patch);
    if (is_opening && openings == Openings::kept)
      removed.insert(removed.end(), patch.faces.begin(), patch.faces.end());
    else
      result.filled.push_back(patch.hole);
  }
  for (const Face face : removed) CGAL::Euler::remove_face(surface.halfedge(face), surface);
  surface.collect_garbage();
  return result;
}

tl::unexpected<Error> unfilled(const FilledHole& hole) {
  const std::string found = "found one of " + counted(hole.edges, "edge") + ", " +
                            size_and_place(hole) + "; " + kWrapping + " makes a new surface";
  if (hole.edges > kMaxHoleEdges)
    return failure(ErrorKind::unsound, "expected holes of at most " +
                                           std::to_string(kMaxHoleEdges) + " edges, " + found);
  return failure(ErrorKind::unsound,
                 "expected holes that triangles between their vertices fill, " + found);
}

}  // namespace clay::solid::inline repair
