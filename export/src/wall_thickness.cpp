#include "claystack/export/wall_thickness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace clay::solid {
namespace {

struct Edge {
  ProfilePoint low, high;  ///< by height
};

double distance(const ProfilePoint& p, const Edge& edge) {
  const double rho = edge.high.rho - edge.low.rho, y = edge.high.y - edge.low.y;
  const double along =
      ((p.rho - edge.low.rho) * rho + (p.y - edge.low.y) * y) / (rho * rho + y * y);
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.rho - edge.low.rho - t * rho, p.y - edge.low.y - t * y);
}

/// Of edges that do not cross: an end of one is nearest.
double distance(const Edge& a, const Edge& b) {
  return std::min(
      {distance(a.low, b), distance(a.high, b), distance(b.low, a), distance(b.high, a)});
}

/// A piece's edges by what they face. With clay to the left, edges that rise face outward and those
/// that fall face a bore; level ones that end on the axis are floors, lids, tops and bases.
struct Faces {
  std::vector<Edge> outer, bore;
  std::vector<double> up, down;  ///< heights of level faces at the axis
  std::vector<Edge> axis;        ///< where clay reaches it

  explicit Faces(const Polygon& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      add(polygon[i], polygon[i + 1 < polygon.size() ? i + 1 : 0]);
    // Each wall is a monotone chain; bores were met from the top down.
    std::reverse(bore.begin(), bore.end());
  }

 private:
  void add(const ProfilePoint& from, const ProfilePoint& to) {
    if (from.rho == 0.0 && to.rho == 0.0) {
      axis.push_back(from.y < to.y ? Edge{from, to} : Edge{to, from});
    } else if (to.y > from.y) {
      outer.push_back({from, to});
    } else if (to.y < from.y) {
      bore.push_back({to, from});
    } else if (from.rho == 0.0 || to.rho == 0.0) {
      (to.rho > from.rho ? down : up).push_back(from.y);
    }
  }
};

double through_walls(const Faces& faces, double least) {
  for (const Edge& inner : faces.bore) {
    const auto begin =
        std::partition_point(faces.outer.begin(), faces.outer.end(),
                             [&](const Edge& e) { return e.high.y < inner.low.y - least; });
    for (auto outer = begin; outer != faces.outer.end() && outer->low.y <= inner.high.y + least;
         ++outer)
      least = std::min(least, distance(*outer, inner));
  }
  return least;
}

/// From every face that looks down to the next one above it that looks up.
double through_floors(const Faces& faces, double least) {
  for (const double bottom : faces.down)
    for (const double top : faces.up)
      if (top > bottom) least = std::min(least, top - bottom);
  return least;
}

double radius_at(const Edge& edge, double y) {
  const double t = (y - edge.low.y) / (edge.high.y - edge.low.y);
  return edge.low.rho + t * (edge.high.rho - edge.low.rho);
}

/// Twice the radius wherever clay reaches the axis.
double across(const Faces& faces, double least) {
  for (const Edge& axis : faces.axis)
    for (const Edge& outer : faces.outer) {
      const double low = std::max(axis.low.y, outer.low.y),
                   high = std::min(axis.high.y, outer.high.y);
      if (low < high)
        least = std::min({least, 2.0 * radius_at(outer, low), 2.0 * radius_at(outer, high)});
    }
  return least;
}

}  // namespace

double min_wall_mm(const Profile& profile) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const Polygon& polygon : profile.pieces) {
    const Faces faces(polygon);
    least = through_walls(faces, through_floors(faces, across(faces, least)));
  }
  return least;
}

}  // namespace clay::solid
