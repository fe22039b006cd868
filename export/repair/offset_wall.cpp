#include "export/repair/offset_wall.hpp"

#include "core/cancel.hpp"
#include "export/formats/file_floats.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace clay::solid::inline repair {
namespace {

using Vertex = Surface::Vertex_index;
using HalfEdge = Surface::Halfedge_index;

/// The plane of a triangle at a vertex, and its angle there: many narrow triangles of one face
/// count as much as a single one.
struct Facet {
  glm::dvec3 normal;
  double angle = 0.0;
};

std::vector<Facet> facets_at(const Surface& surface, Vertex v) {
  std::vector<Facet> facets;
  for (const HalfEdge h : surface.halfedges_around_target(surface.halfedge(v))) {
    if (surface.is_border(h)) continue;
    const glm::dvec3 at = point_of(surface.point(v));
    const glm::dvec3 to = point_of(surface.point(surface.target(surface.next(h)))) - at;
    const glm::dvec3 from = point_of(surface.point(surface.source(h))) - at;
    const glm::dvec3 across = glm::cross(to, from);
    const double length = glm::length(across);
    // The direction of a needle's normal is that of its rounding.
    constexpr double kNeedle = 1e-6;
    if (length <= kNeedle * glm::length(to) * glm::length(from)) continue;
    facets.push_back({across / length, std::atan2(length, glm::dot(to, from))});
  }
  return facets;
}

/// The move that brings a vertex to the distance 1 from the planes of its facets: the shortest one
/// that has the least squares of the errors. Directions in which no plane decides are damped.
glm::dvec3 even_move(const std::vector<Facet>& facets) {
  constexpr double kDamping = 1e-7;
  glm::dmat3 matrix(0.0);
  glm::dvec3 right(0.0);
  double weight = 0.0;
  for (const auto& [normal, angle] : facets) {
    matrix += angle * glm::outerProduct(normal, normal);
    right += angle * normal;
    weight += angle;
  }
  matrix += kDamping * weight * glm::dmat3(1.0);
  return glm::inverse(matrix) * right;
}

/// The move at a vertex per mm of distance. Above a length, as at a sharp edge, it is cut.
glm::dvec3 move_at(const Surface& surface, Vertex v) {
  constexpr double kLongest = 3.0;
  const std::vector<Facet> facets = facets_at(surface, v);
  if (facets.empty()) return {};
  glm::dvec3 move = even_move(facets);
  double least = std::numeric_limits<double>::infinity();
  for (const Facet& facet : facets) least = std::min(least, glm::dot(facet.normal, move));
  // More than three planes have no common point, so one of them may be too near.
  move *= std::clamp(least > 0.0 ? 1.0 / least : 1.0, 1.0, kMostOffsetShare);
  const double length = glm::length(move);
  return length > kLongest ? move * (kLongest / length) : move;
}

bool has_closed_part(const Surface& surface) {
  const Shells shells(surface);
  std::vector<bool> is_open(shells.count, false);
  for (const HalfEdge h : surface.halfedges())
    if (surface.is_border(h)) is_open[shells.of_face[surface.face(surface.opposite(h))]] = true;
  return std::ranges::find(is_open, false) != is_open.end();
}

}  // namespace

std::optional<TriangleMesh> offset_wall(const Surface& surface, double half_mm) {
  if (has_closed_part(surface)) return std::nullopt;
  TriangleMesh wall;
  wall.points.resize(2 * surface.number_of_vertices());
  // The point on the side of the normals, and the one on the other side.
  const auto front = [](Vertex v) { return 2 * static_cast<std::uint32_t>(v); };
  const auto back = [&](Vertex v) { return front(v) + 1; };
  for (const Vertex v : surface.vertices()) {
    step_of_loop();
    const glm::dvec3 at = point_of(surface.point(v)), move = half_mm * move_at(surface, v);
    wall.points[front(v)] = file_point(at + move);
    wall.points[back(v)] = file_point(at - move);
  }
  for (const auto face : surface.faces()) {
    const HalfEdge h = surface.halfedge(face);
    const Vertex a = surface.source(h), b = surface.target(h), c = surface.target(surface.next(h));
    wall.triangles.push_back({front(a), front(b), front(c)});
    wall.triangles.push_back({back(a), back(c), back(b)});
  }
  for (const HalfEdge h : surface.halfedges()) {
    if (!surface.is_border(h)) continue;
    const Vertex from = surface.source(h), to = surface.target(h);
    wall.triangles.push_back({front(from), front(to), back(to)});
    wall.triangles.push_back({front(from), back(to), back(from)});
  }
  return wall;
}

}  // namespace clay::solid::inline repair
