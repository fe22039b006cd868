#pragma once
// A ray inside a mesh, from a point of its surface or in its clay.

#include "claystack/export/solid.hpp"
#include "export/solid/box_tree.hpp"
#include "export/solid/cgal_versions.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>

namespace clay::solid::inline check {

class WallRay {
 public:
  WallRay(const TriangleMesh& mesh, const glm::dvec3& begin, const glm::dvec3& inward)
      : mesh_(mesh),
        begin_(begin),
        inward_(inward),
        ray_(point(begin), point(begin + inward)),
        along_(begin + inward - begin) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(along_[axis]) > std::abs(along_[longest_])) longest_ = axis;
      // Not infinite, because infinity times 0 is NaN.
      per_mm_[axis] = along_[axis] == 0.0 ? std::numeric_limits<double>::max() : 1.0 / along_[axis];
    }
  }

  struct Hit {
    std::uint32_t triangle = 0;
    double facing = 0.0;       ///< cosine between its normal and the ray
    std::optional<double> mm;  ///< empty if the ray lies in the triangle's plane
  };

  /// Finds the first back face. Decrements `steps` for each visited box and triangle; stops at 0.
  std::optional<Hit> first_hit(const BoxTree& tree, std::size_t& steps) {
    const auto step = [&] { steps -= steps > 0 ? 1 : 0; };
    tree.for_each_near(
        [&](const BoxTree::Box& box) {
          step();
          return entry(box);
        },
        [&] { return steps > 0 ? nearest_ : -1.0; },
        [&](std::span<const std::uint32_t> triangles) {
          for (const std::uint32_t t : triangles) {
            step();
            look_at(t);
          }
        });
    return hit_;
  }

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_3;

  static Point point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

  [[nodiscard]] double entry(const BoxTree::Box& box) const {
    const glm::dvec3 a = (box.low - begin_) * per_mm_, b = (box.high - begin_) * per_mm_;
    const glm::dvec3 in = glm::min(a, b), out = glm::max(a, b);
    double first = std::max({0.0, in.x, in.y, in.z});
    double last = std::min({out.x, out.y, out.z});
    if (!(first <= last)) return BoxTree::kNever;
    const glm::dvec3 across(box.across);
    const double rise = glm::dot(across, along_), begin = glm::dot(across, begin_);
    // Nearly parallel to the planes, rounding decides on which side the ray meets them.
    if (std::abs(rise) > 1e-6) {
      const double from = (box.from - begin) / rise, to = (box.to - begin) / rise;
      first = std::max(first, std::min(from, to));
      last = std::min(last, std::max(from, to));
    } else if (begin < box.from - 2e-6 * last || begin > box.to + 2e-6 * last) {
      return BoxTree::kNever;
    }
    return first <= last ? first : BoxTree::kNever;
  }

  /// True if the line passes the triangle on one side by more than the rounding error.
  [[nodiscard]] bool passes(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) const {
    const double farthest2 = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
    const double margin = 1e-14 * farthest2;  // 90 roundings
    const auto differ = [&](double x, double y) {
      return std::max(x, y) > margin && std::min(x, y) < -margin;
    };
    const double ab = glm::dot(along_, glm::cross(a, b)), bc = glm::dot(along_, glm::cross(b, c));
    if (differ(ab, bc)) return true;
    const double ca = glm::dot(along_, glm::cross(c, a));
    return differ(ab, ca) || differ(bc, ca);
  }

  void look_at(std::uint32_t triangle) {
    const auto& [i, j, k] = mesh_.triangles[triangle];
    const glm::dvec3 &a = mesh_.points[i], &b = mesh_.points[j], &c = mesh_.points[k];
    // Both tests exclude most triangles from the exact tests, and decide no close case.
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double size = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    if (glm::dot(inward_, normal) < -1e-12 * size) return;
    if (passes(a - begin_, b - begin_, c - begin_)) return;
    const double facing = glm::dot(inward_, glm::normalize(normal));
    if (!(facing > 0.0)) return;  // a front face
    const Kernel::Triangle_3 whole(point(a), point(b), point(c));
    if (whole.is_degenerate()) return;
    const auto met = CGAL::intersection(ray_, whole);
    if (!met) return;
    // A ray that is not in the plane of a triangle meets it in a point.
    if (const auto* at = cgal::get_if<Point>(*met)) {
      const glm::dvec3 place(at->x(), at->y(), at->z());
      keep({triangle, facing, glm::length(place - begin_)}, share_of_ray(*at));
    } else {
      const auto& in_plane = *cgal::get_if<Kernel::Segment_3>(*met);
      keep({triangle, facing, {}},
           std::min(share_of_ray(in_plane.source()), share_of_ray(in_plane.target())));
    }
  }

  [[nodiscard]] double share_of_ray(const Point& p) const {
    return (p[longest_] - begin_[longest_]) / along_[longest_];
  }

  void keep(const Hit& hit, double share) {
    if (share > nearest_ || (share == nearest_ && hit_ && hit_->triangle < hit.triangle)) return;
    nearest_ = share;
    hit_ = hit;
  }

  const TriangleMesh& mesh_;
  glm::dvec3 begin_, inward_;
  Kernel::Ray_3 ray_;
  glm::dvec3 along_, per_mm_;
  int longest_ = 0;
  double nearest_ = std::numeric_limits<double>::max();
  std::optional<Hit> hit_;
};

}  // namespace clay::solid::inline check
