#include "export/repair/repair_distance.hpp"

#include "core/cancel.hpp"
#include "export/solid/box_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <queue>
#include <span>
#include <tuple>
#include <vector>

namespace clay::solid::inline repair {
namespace {

using Corners = std::array<glm::dvec3, 3>;

bool before_point(const glm::dvec3& p, const glm::dvec3& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

bool before_corners(const Corners& a, const Corners& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before_point);
}

/// With sorted corners, in ascending order.
std::vector<Corners> sorted_triangles(const TriangleMesh& mesh) {
  std::vector<Corners> all;
  all.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    step_of_loop();
    Corners& corners = all.emplace_back(Corners{mesh.points[a], mesh.points[b], mesh.points[c]});
    std::sort(corners.begin(), corners.end(), before_point);
  }
  std::sort(all.begin(), all.end(), before_corners);
  return all;
}

struct Piece {
  Corners corners;
  double most_mm = 0.0;  ///< upper bound of the distance of its points
  bool operator<(const Piece& other) const { return most_mm < other.most_mm; }
};

double squared(const glm::dvec3& v) { return glm::dot(v, v); }

double squared_distance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 way = b - a;
  const double length2 = squared(way);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, way) / length2, 0.0, 1.0) : 0.0;
  return squared(p - a - t * way);
}

double squared_distance(const glm::dvec3& p, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double area2 = squared(normal);
  const auto within = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, p - from), normal) >= 0.0;
  };
  if (area2 > 0.0 && within(a, b) && within(b, c) && within(c, a)) {
    const double height = glm::dot(p - a, normal);
    return height * height / area2;
  }
  return std::min(
      {squared_distance(p, a, b), squared_distance(p, b, c), squared_distance(p, c, a)});
}

class Farthest {
 public:
  explicit Farthest(const TriangleMesh& to) : to_(to), tree_(to) {}

  double bound(const std::vector<Corners>& triangles, double tolerance_mm) {
    constexpr std::size_t kMostPieces = 20'000;
    std::priority_queue<Piece> open;
    for (const Corners& corners : triangles) open.push(piece(corners));
    std::size_t pieces = 0;
    while (!open.empty()) {
      step_of_loop();
      const Piece top = open.top();
      if (top.most_mm <= 1.02 * least_mm_ + tolerance_mm || ++pieces > kMostPieces)
        return top.most_mm;
      open.pop();
      const auto& [a, b, c] = top.corners;
      const glm::dvec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
      for (const Corners& part :
           {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}})
        open.push(piece(part));
    }
    return least_mm_;
  }

 private:
  /// The distance changes by no more than the way.
  Piece piece(const Corners& corners) {
    const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const double at_middle = distance_mm(middle);
    least_mm_ = std::max(least_mm_, at_middle);
    double way = 0.0;
    for (const glm::dvec3& corner : corners) way = std::max(way, glm::distance(middle, corner));
    return {corners, at_middle + way};
  }

  [[nodiscard]] double distance_mm(const glm::dvec3& p) const {
    double nearest2 = std::numeric_limits<double>::max();
    tree_.for_each_near(
        [&](const BoxTree::Box& box) {
          return squared(glm::max(glm::dvec3(0.0), glm::max(box.low - p, p - box.high)));
        },
        [&] { return nearest2; },
        [&](std::span<const std::uint32_t> triangles) {
          for (const std::uint32_t t : triangles) {
            const auto& [a, b, c] = to_.triangles[t];
            nearest2 =
                std::min(nearest2,
                         squared_distance(p, Corners{to_.points[a], to_.points[b], to_.points[c]}));
          }
        });
    return std::sqrt(nearest2);
  }

  const TriangleMesh& to_;
  BoxTree tree_;
  double least_mm_ = 0.0;  ///< the largest distance found at a point
};

double change_of(const std::vector<Corners>& from, const std::vector<Corners>& others,
                 const TriangleMesh& to, double tolerance_mm) {
  std::vector<Corners> changed;
  std::set_difference(from.begin(), from.end(), others.begin(), others.end(),
                      std::back_inserter(changed), before_corners);
  return changed.empty() ? 0.0 : Farthest(to).bound(changed, tolerance_mm);
}

}  // namespace

SurfaceChange surface_change(const TriangleMesh& before, const TriangleMesh& after,
                             double tolerance_mm) {
  const std::vector<Corners> old = sorted_triangles(before), fresh = sorted_triangles(after);
  return {change_of(fresh, old, before, tolerance_mm), change_of(old, fresh, after, tolerance_mm)};
}

}  // namespace clay::solid::inline repair
