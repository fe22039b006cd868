#include "export/repair/repair_distance.hpp"

#include "core/cancel.hpp"
#include "core/parallel_parts.hpp"
#include "export/repair/soup_edges.hpp"
#include "export/solid/box_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
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

Corners sorted_corners(const TriangleMesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  Corners corners{mesh.points[a], mesh.points[b], mesh.points[c]};
  std::sort(corners.begin(), corners.end(), before_point);
  return corners;
}

/// A triangle and a number that triangles in one place share.
struct Placed {
  std::uint64_t hash;
  std::uint32_t triangle;
  friend auto operator<=>(const Placed&, const Placed&) = default;
};

std::vector<Placed> by_place(const TriangleMesh& mesh) {
  std::vector<Placed> all;
  all.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    step_of_loop();
    std::uint64_t hash = 0;
    for (const glm::dvec3& corner : sorted_corners(mesh, t))
      for (int axis = 0; axis < 3; ++axis) {
        hash ^= std::bit_cast<std::uint64_t>(corner[axis] + 0.0);  // without -0
        hash = (hash ^ (hash >> 29U)) * 0x9E3779B97F4A7C15U;
      }
    all.push_back({hash, t});
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The triangles that the other mesh does not have in the same place.
std::vector<Corners> changed_triangles(const TriangleMesh& mesh, const std::vector<Placed>& own,
                                       const TriangleMesh& other,
                                       const std::vector<Placed>& others) {
  std::vector<Corners> changed;
  auto at = others.begin();
  for (const Placed& placed : own) {
    step_of_loop();
    while (at != others.end() && at->hash < placed.hash) ++at;
    const Corners corners = sorted_corners(mesh, placed.triangle);
    bool same = false;
    for (auto like = at; !same && like != others.end() && like->hash == placed.hash; ++like)
      same = sorted_corners(other, like->triangle) == corners;
    if (!same) changed.push_back(corners);
  }
  // Neighbours in space one after another: the search for the nearest begins at the last one.
  std::sort(changed.begin(), changed.end(), [](const Corners& a, const Corners& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before_point);
  });
  return changed;
}

struct Piece {
  Corners corners;
  std::uint32_t nearest = 0;  ///< triangle of the other mesh
  double most_mm = 0.0;       ///< upper bound of the distance of its points
  bool operator<(const Piece& other) const { return most_mm < other.most_mm; }
};

double squared(double x) { return x * x; }
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

/// The triangle beside each edge of a triangle; at an open edge, the triangle itself.
class Neighbours {
 public:
  explicit Neighbours(const TriangleMesh& mesh) : beside_(mesh.triangles.size()) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) beside_[t].fill(t);
    for_each_edge(mesh, [&](std::span<const SoupEdge> edges) {
      for (std::size_t i = 0; i < edges.size(); ++i) {
        const Triangle& t = mesh.triangles[edges[i].triangle];
        std::size_t c = 0;
        while (std::minmax(t.at(c), t.at((c + 1) % 3)) != std::minmax(edges[i].low, edges[i].high))
          ++c;
        beside_[edges[i].triangle].at(c) = edges[(i + 1) % edges.size()].triangle;
      }
    });
  }
  [[nodiscard]] const Triangle& of(std::uint32_t t) const { return beside_[t]; }

 private:
  std::vector<Triangle> beside_;
};

class Farthest {
 public:
  Farthest(const TriangleMesh& to, double tolerance_mm)
      : to_(to), tree_(to), tolerance_mm_(tolerance_mm) {}

  double bound(const std::vector<Corners>& triangles) {
    const std::size_t most_pieces =
        std::clamp<std::size_t>(8 * (triangles.size() + to_.triangles.size()), 20'000, 400'000);
    std::uint32_t hint = 0;
    for (const Corners& corners : triangles) {
      step_of_loop();
      hint = open_piece(corners, hint);
    }
    std::size_t pieces = 0;
    while (!open_.empty()) {
      step_of_loop();
      const Piece top = open_.top();
      if (near_enough(top) || ++pieces > most_pieces) return std::max(top.most_mm, settled_mm_);
      open_.pop();
      const auto& [a, b, c] = top.corners;
      const glm::dvec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
      for (const Corners& part :
           {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}})
        open_piece(part, top.nearest);
    }
    return std::max(least_mm_, settled_mm_);
  }

 private:
  /// No piece needs a closer bound.
  [[nodiscard]] bool near_enough(const Piece& piece) const {
    return piece.most_mm <= 1.02 * least_mm_ + tolerance_mm_;
  }

  /// Keeps a piece that needs a closer bound. Returns the triangle nearest to it.
  std::uint32_t open_piece(const Corners& corners, std::uint32_t hint) {
    const Piece made = piece(corners, hint);
    if (near_enough(made))
      settled_mm_ = std::max(settled_mm_, made.most_mm);
    else
      open_.push(made);
    return made.nearest;
  }

  /// Along a way, the distance changes by at most the length of the way. The distance to one
  /// triangle is convex, so it is largest at a corner.
  Piece piece(const Corners& corners, std::uint32_t hint) {
    const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const Near near = near_to(middle, hint);
    const std::uint32_t nearest = near.triangle;
    const double at_middle = std::sqrt(near.mm2);
    if (near.nearest) least_mm_ = std::max(least_mm_, at_middle);
    double way = 0.0, at_corner2 = 0.0;
    for (const glm::dvec3& corner : corners) {
      way = std::max(way, glm::distance(middle, corner));
      at_corner2 = std::max(at_corner2, squared_distance(corner, corners_of(nearest)));
    }
    return {corners, nearest, std::min(at_middle + way, std::sqrt(at_corner2))};
  }

  [[nodiscard]] Corners corners_of(std::uint32_t t) const {
    const auto& [a, b, c] = to_.triangles[t];
    return {to_.points[a], to_.points[b], to_.points[c]};
  }

  /// A triangle of the other mesh, and its squared distance.
  struct Near {
    std::uint32_t triangle = 0;
    double mm2 = 0.0;
    bool nearest = false;  ///< no other one is nearer
  };

  /// The search begins at the hint. If many boxes overlap, as those of long thin triangles in one
  /// plane, it walks over the surface first: where both meshes coincide, it needs no boxes then.
  [[nodiscard]] Near near_to(const glm::dvec3& p, std::uint32_t hint) {
    constexpr double kNear = 0.1;  // of the tolerance: near enough
    Near near{hint, squared_distance(p, corners_of(hint))};
    if (!neighbours_ && visits_ > 100'000 + 64 * to_.triangles.size()) neighbours_.emplace(to_);
    if (neighbours_) {
      walk(p, near);
      if (near.mm2 <= squared(kNear * tolerance_mm_)) return near;
    }
    search(p, near);
    return near;
  }

  /// From triangle to triangle, as long as the next one is nearer.
  void walk(const glm::dvec3& p, Near& near) const {
    for (std::uint32_t from = UINT32_MAX; from != near.triangle;) {
      from = near.triangle;
      for (const std::uint32_t t : neighbours_->of(from))
        if (const double to_t = squared_distance(p, corners_of(t)); to_t < near.mm2)
          near = {t, to_t};
    }
  }

  void search(const glm::dvec3& p, Near& near) {
    tree_.for_each_near(
        [&](const BoxTree::Box& box) {
          return squared(glm::max(glm::dvec3(0.0), glm::max(box.low - p, p - box.high)));
        },
        [&] { return near.mm2; },
        [&](std::span<const std::uint32_t> triangles) {
          visits_ += triangles.size();
          for (const std::uint32_t t : triangles)
            if (const double to_t = squared_distance(p, corners_of(t)); to_t < near.mm2)
              near = {t, to_t};
        });
    near.nearest = true;
  }

  const TriangleMesh& to_;
  BoxTree tree_;
  std::optional<Neighbours> neighbours_;  ///< only if the boxes alone are slow
  std::uint64_t visits_ = 0;              ///< of triangles, in all searches
  double tolerance_mm_;
  double least_mm_ = 0.0;            ///< the largest distance found at a point
  std::priority_queue<Piece> open_;  ///< pieces that need a closer bound
  double settled_mm_ = 0.0;          ///< the largest bound of all other pieces
};

double change_of(const std::vector<Corners>& changed, const TriangleMesh& to, double tolerance_mm) {
  return changed.empty() ? 0.0 : Farthest(to, tolerance_mm).bound(changed);
}

}  // namespace

SurfaceChange surface_change(const TriangleMesh& before, const TriangleMesh& after,
                             double tolerance_mm) {
  std::array<std::vector<Placed>, 2> placed;
  for_each_part(2,
                [&](std::size_t part) { placed.at(part) = by_place(part == 0 ? before : after); });
  SurfaceChange change;
  for_each_part(2, [&](std::size_t part) {
    if (part == 0)
      change.added_mm =
          change_of(changed_triangles(after, placed[1], before, placed[0]), before, tolerance_mm);
    else
      change.removed_mm =
          change_of(changed_triangles(before, placed[0], after, placed[1]), after, tolerance_mm);
  });
  return change;
}

}  // namespace clay::solid::inline repair
