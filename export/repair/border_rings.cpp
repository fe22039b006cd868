#include "export/repair/border_rings.hpp"

#include "core/cancel.hpp"
#include "export/formats/polygon_split.hpp"

#include <CGAL/box_intersection_d.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>
#include <utility>

namespace clay::solid::inline repair {
namespace {

double size_of(const Border& border) { return glm::distance(border.low, border.high); }

/// Rounding to float32 moves the points of a plane out of it.
double plane_tolerance_mm(const Border& border) {
  const glm::dvec3 reach = glm::max(glm::abs(border.low), glm::abs(border.high));
  return 1e-5 * size_of(border) + 0x1p-21 * std::max({reach.x, reach.y, reach.z});
}

bool in_plane_of(const Border& plane, const Border& border) {
  const glm::dvec3 normal = glm::normalize(plane.area);
  const double tolerance_mm = plane_tolerance_mm(plane);
  return std::ranges::all_of(border.points, [&](const glm::dvec3& p) {
    return std::abs(glm::dot(p - plane.points.front(), normal)) <= tolerance_mm;
  });
}

/// Whether a border goes around a point in its plane.
bool encloses(const Border& border, const glm::dvec3& place) {
  int axis = 0;
  for (const int other : {1, 2})
    if (std::abs(border.area[other]) > std::abs(border.area[axis])) axis = other;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  bool inside = false;
  for (std::size_t i = 0; i < border.points.size(); ++i) {
    const glm::dvec3 &a = border.points[i], &b = border.points[(i + 1) % border.points.size()];
    if ((a[v] > place[v]) == (b[v] > place[v])) continue;
    if (place[u] < a[u] + (place[v] - a[v]) * (b[u] - a[u]) / (b[v] - a[v])) inside = !inside;
  }
  return inside;
}

/// A border as one that may lie around others.
struct Outer {
  glm::dvec3 low{0.0}, high{0.0};  ///< of its box, with the tolerance of its plane [mm]
  double size_mm = 0.0;
  bool level = false;  ///< it lies in one plane
};

Outer outer_of(const Border& border) {
  const double tolerance_mm = plane_tolerance_mm(border);
  const bool encloses_area = border.area != glm::dvec3(0.0);
  return {border.low - tolerance_mm, border.high + tolerance_mm, size_of(border),
          encloses_area && in_plane_of(border, border)};
}

/// Of borders whose boxes lie in one another, the outer one in one plane.
bool is_ring(const Border& outer, const Border& inner) {
  const double area = glm::length(outer.area), hole = glm::length(inner.area);
  constexpr double kParallel = 0.999;
  if (!(hole > 0.0) || hole >= area) return false;
  if (glm::dot(outer.area, inner.area) > -kParallel * area * hole) return false;
  return in_plane_of(outer, inner) && encloses(outer, inner.points.front());
}

/// Adds triangles beside those that are there, so that no vertex becomes non-manifold meanwhile.
std::vector<Surface::Face_index> add_faces(Surface& surface,
                                           std::vector<std::array<std::uint32_t, 3>> triangles) {
  using Vertex = Surface::Vertex_index;
  const auto beside = [&](const std::array<std::uint32_t, 3>& t) {
    for (std::size_t i = 0; i < 3; ++i)
      if (const auto h = surface.halfedge(Vertex(t.at(i)), Vertex(t.at((i + 1) % 3)));
          h != Surface::null_halfedge() && surface.is_border(h))
        return true;
    return false;
  };
  std::vector<Surface::Face_index> faces;
  for (bool grows = true; grows && !triangles.empty();) {
    grows = false;
    stop_if_cancelled();
    std::erase_if(triangles, [&](const auto& t) {
      if (!beside(t)) return false;
      const auto face = surface.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2]));
      if (face == Surface::null_face()) return false;
      faces.push_back(face);
      return grows = true;
    });
  }
  if (triangles.empty()) return faces;
  for (const auto face : faces) CGAL::Euler::remove_face(surface.halfedge(face), surface);
  return {};
}

}  // namespace

Border border_from(const Surface& surface, Surface::Halfedge_index start) {
  Border border;
  border.low = glm::dvec3(INFINITY);
  border.high = glm::dvec3(-INFINITY);
  for (const auto h : surface.halfedges_around_face(start)) {
    const glm::dvec3 p = point_of(surface.point(surface.source(h)));
    border.edges.push_back(h);
    border.vertices.push_back(surface.source(h));
    border.points.push_back(p);
    border.low = glm::min(border.low, p);
    border.high = glm::max(border.high, p);
  }
  for (std::size_t i = 1; i + 1 < border.points.size(); ++i)
    border.area += 0.5 * glm::cross(border.points[i] - border.points[0],
                                    border.points[i + 1] - border.points[0]);
  return border;
}

double width_of(const Border& border) {
  constexpr std::size_t kMostPoints = 10'000;
  const std::size_t step = (border.points.size() + kMostPoints - 1) / kMostPoints;
  double widest2 = 0.0;
  for (std::size_t i = 0; i < border.points.size(); i += step)
    for (std::size_t j = 0; j < i; j += step) {
      const glm::dvec3 way = border.points[i] - border.points[j];
      widest2 = std::max(widest2, glm::dot(way, way));
    }
  return std::sqrt(widest2);
}

std::vector<std::size_t> borders_around(const std::vector<Border>& borders) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  const auto box = [](const glm::dvec3& low, const glm::dvec3& high, std::size_t i) {
    return Box(CGAL::Bbox_3(low.x, low.y, low.z, high.x, high.y, high.z), i);
  };
  std::vector<Outer> outer;
  std::vector<Box> inner_boxes, outer_boxes;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    stop_if_cancelled();
    outer.push_back(outer_of(borders[i]));
    inner_boxes.push_back(box(borders[i].low, borders[i].low, i));  // a corner, to meet fewer
    if (outer[i].level) outer_boxes.push_back(box(outer[i].low, outer[i].high, i));
  }
  std::vector<std::size_t> around(borders.size());
  std::iota(around.begin(), around.end(), std::size_t{0});
  const auto before = [&](std::size_t i, std::size_t j) {
    return std::pair(outer[i].size_mm, i) < std::pair(outer[j].size_mm, j);
  };
  CGAL::box_intersection_d(
      inner_boxes.begin(), inner_boxes.end(), outer_boxes.begin(), outer_boxes.end(),
      [&](const Box& inside, const Box& outside) {
        step_of_loop();
        const std::size_t i = inside.info(), j = outside.info();
        if (i == j || !glm::all(glm::lessThanEqual(outer[j].low, borders[i].low)) ||
            !glm::all(glm::greaterThanEqual(outer[j].high, borders[i].high)))
          return;
        if ((around[i] == i || before(j, around[i])) && is_ring(borders[j], borders[i]))
          around[i] = j;
      });
  return around;
}

std::vector<Surface::Face_index> fill_ring(Surface& surface, const Border& outer,
                                           const std::vector<const Border*>& inner) {
  std::vector<std::uint32_t> vertices = outer.vertices;
  std::vector<glm::dvec3> points = outer.points;
  std::vector<std::size_t> ends{vertices.size()};
  for (const Border* border : inner) {
    vertices.insert(vertices.end(), border->vertices.begin(), border->vertices.end());
    points.insert(points.end(), border->points.begin(), border->points.end());
    ends.push_back(vertices.size());
  }
  return add_faces(surface, formats::split_around_holes(vertices, points, ends, outer.area));
}

}  // namespace clay::solid::inline repair
