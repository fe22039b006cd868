#include "export/formats/polygon_split.hpp"

#include "core/cancel.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace clay::solid::inline formats {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using FlatPoint = Kernel::Point_2;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_between(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

enum class Side : std::uint8_t { unknown, outside, inside };

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<Side, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

using NearFirst =
    CGAL::Spatial_sort_traits_adapter_2<Kernel, CGAL::Pointer_property_map<FlatPoint>::const_type>;

/// Counterclockwise, without the axis that the normal is nearest to. Coordinates are kept, so that
/// predicates on them are exact.
std::vector<FlatPoint> seen_along(const glm::dvec3& normal, const std::vector<glm::dvec3>& points) {
  int axis = 0;
  for (const int other : {1, 2})
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(u, v);
  std::vector<FlatPoint> flat;
  flat.reserve(points.size());
  for (const glm::dvec3& p : points) flat.emplace_back(p[u], p[v]);
  return flat;
}

/// Whether the fan from the first corner covers the polygon once: its triangles turn left, and less
/// than a full turn together.
bool is_fan(const std::vector<FlatPoint>& p) {
  bool beyond_half = false;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    if (CGAL::orientation(p[0], p[i], p[i + 1]) != CGAL::LEFT_TURN) return false;
    const bool right = CGAL::orientation(p[0], p[1], p[i + 1]) == CGAL::RIGHT_TURN;
    if (beyond_half && !right) return false;
    beyond_half = right;
  }
  return true;
}

class PolygonTriangulation {
 public:
  /// `ends`: of the outlines in the list of corners.
  PolygonTriangulation(const std::vector<std::uint32_t>& corners,
                       const std::vector<FlatPoint>& flat, const std::vector<std::size_t>& ends)
      : corners_(corners), flat_(flat), ends_(ends) {}

  std::optional<Triangles> run() {
    if (!insert_corners() || !insert_edges()) return std::nullopt;
    colour_faces();
    Triangles inside;
    for (const auto face : made_.finite_face_handles())
      if (face->info() == Side::inside)
        inside.push_back(
            {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    const std::size_t holes = ends_.size() - 1;
    if (inside.size() != corners_.size() + 2 * holes - 2) return std::nullopt;
    // A fixed order: that of the library is not documented.
    for (auto& t : inside) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::ranges::sort(inside);
    return inside;
  }

 private:
  /// Returns false if two points of the mesh are at one place. Each corner is searched for from the
  /// one before: in the order of the file, a zigzag of n corners would take n^2 steps.
  bool insert_corners() {
    std::vector<std::size_t> near_one_another(flat_.size());
    std::iota(near_one_another.begin(), near_one_another.end(), 0);
    CGAL::spatial_sort(near_one_another.begin(), near_one_another.end(),
                       NearFirst(CGAL::make_property_map(flat_)));
    vertices_.resize(flat_.size());
    Triangulation::Face_handle hint;
    for (const std::size_t i : near_one_another) {
      step_of_loop();
      const std::size_t before = made_.number_of_vertices();
      const auto vertex = made_.insert(flat_[i], hint);
      if (made_.number_of_vertices() > before)
        vertex->info() = corners_[i];
      else if (vertex->info() != corners_[i])
        return false;
      vertices_[i] = vertex;
      hint = vertex->face();
    }
    return true;
  }

  /// Returns false if edges cross, or pass through corners.
  bool insert_edges() try {
    std::vector<std::pair<Triangulation::Vertex_handle, Triangulation::Vertex_handle>> ways;
    for (std::size_t begin = 0; const std::size_t end : ends_) {
      for (std::size_t i = begin; i < end; ++i)
        ways.emplace_back(vertices_[i], vertices_[i + 1 < end ? i + 1 : begin]);
      begin = end;
    }
    for (const auto& [from, to] : ways) {
      step_of_loop();
      if (from == to) return false;
      made_.insert_constraint(from, to);
      edges_.push_back(edge_between(from->info(), to->info()));
    }
    std::ranges::sort(edges_);
    return std::ranges::all_of(
        ways, [&](const auto& way) { return made_.is_edge(way.first, way.second); });
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    return false;
  }

  /// An edge that the polygon passes along there and back is no border.
  [[nodiscard]] bool is_border(std::uint32_t a, std::uint32_t b) const {
    const auto [first, last] = std::equal_range(edges_.begin(), edges_.end(), edge_between(a, b));
    return (last - first) % 2 == 1;
  }

  /// From the outside, the side changes at each border.
  void colour_faces() {
    for (const auto face : made_.all_face_handles()) face->info() = Side::unknown;
    std::vector<Triangulation::Face_handle> open{made_.infinite_face()};
    open.front()->info() = Side::outside;
    while (!open.empty()) {
      const auto face = open.back();
      open.pop_back();
      for (int i = 0; i < 3; ++i) {
        const auto next = face->neighbor(i);
        if (next->info() != Side::unknown) continue;
        const bool crosses =
            face->is_constrained(i) &&
            is_border(face->vertex(face->cw(i))->info(), face->vertex(face->ccw(i))->info());
        const bool outside = (face->info() == Side::outside) != crosses;
        next->info() = outside ? Side::outside : Side::inside;
        open.push_back(next);
      }
    }
  }

  const std::vector<std::uint32_t>& corners_;
  const std::vector<FlatPoint>& flat_;
  const std::vector<std::size_t>& ends_;
  Triangulation made_;
  std::vector<Triangulation::Vertex_handle> vertices_;  ///< by corner
  std::vector<Edge> edges_;
};

}  // namespace

bool split_polygon(const std::vector<std::uint32_t>& corners, const std::vector<glm::dvec3>& points,
                   const glm::dvec3& area, std::span<std::array<std::uint32_t, 3>> triangles) {
  if (area == glm::dvec3(0.0)) return false;
  const std::vector<FlatPoint> flat = seen_along(area, points);
  if (is_fan(flat)) return true;
  const std::vector<std::size_t> ends{corners.size()};
  const auto made = PolygonTriangulation(corners, flat, ends).run();
  if (made) std::ranges::copy(*made, triangles.begin());
  return made.has_value();
}

std::vector<std::array<std::uint32_t, 3>> split_around_holes(
    const std::vector<std::uint32_t>& corners, const std::vector<glm::dvec3>& points,
    const std::vector<std::size_t>& ends, const glm::dvec3& area) {
  if (area == glm::dvec3(0.0)) return {};
  return PolygonTriangulation(corners, seen_along(area, points), ends).run().value_or(Triangles());
}

}  // namespace clay::solid::inline formats
