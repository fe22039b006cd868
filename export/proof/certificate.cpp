#include "claystack/export/proof.hpp"

#include "core/cancel.hpp"
#include "core/text.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_2/Segment_2_Segment_2.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid::inline proof {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

Point exact(const ProfilePoint& p) { return {p.rho, p.y}; }

std::string place(const ProfilePoint& p) {
  return "(rho, y) = (" + nine_digit_text(p.rho) + ", " + nine_digit_text(p.y) + ") mm";
}

tl::unexpected<Error> unsound(std::size_t piece, const std::string& message) {
  return failure(ErrorKind::unsound, "profile, piece " + std::to_string(piece) + ": " + message);
}

std::size_t after(std::size_t vertex, std::size_t count) {
  return vertex + 1 < count ? vertex + 1 : 0;
}
std::size_t before(std::size_t vertex, std::size_t count) {
  return (vertex > 0 ? vertex : count) - 1;
}

Result<void> check_points(const Polygon& polygon, std::size_t piece) {
  if (polygon.size() < 3)
    return unsound(piece, "expected at least 3 vertices, found " + std::to_string(polygon.size()));
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ProfilePoint& p = polygon[i];
    if (!std::isfinite(p.rho) || !std::isfinite(p.y) || p.rho < 0.0)
      return unsound(piece, "expected finite vertices with rho >= 0, found " + place(p) +
                                " at vertex " + std::to_string(i));
    if (p == polygon[after(i, polygon.size())])
      return unsound(piece, "expected edges with a length, found none at " + place(p));
  }
  return {};
}

/// Counts the parts of a polygon along the axis. A vertex on the axis without an axis edge is a
/// pinch: the solid would be connected by a point only.
Result<std::size_t> check_axis(const Polygon& polygon, std::size_t piece) {
  std::size_t segments = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (polygon[i].rho != 0.0) continue;
    const bool axis_before = polygon[before(i, polygon.size())].rho == 0.0;
    const bool axis_after = polygon[after(i, polygon.size())].rho == 0.0;
    if (!axis_before && !axis_after)
      return unsound(piece, "expected the axis to be met along a length, found the single point " +
                                place(polygon[i]));
    if (axis_after && !axis_before) ++segments;
  }
  return segments;
}

/// The edge from `vertex` of `piece` to the next vertex.
struct Edge {
  double bottom = 0.0;
  double top = 0.0;
  std::size_t piece = 0;
  std::size_t vertex = 0;
};

/// Merges sorted runs pairwise. Walls rise and bores fall, so there are few runs.
void merge_runs(std::vector<Edge>& edges, std::vector<std::size_t> ends) {
  const auto lower = [](const Edge& a, const Edge& b) { return a.bottom < b.bottom; };
  std::vector<Edge> merged;
  while (ends.size() > 1) {
    merged.clear();
    merged.reserve(edges.size());
    std::vector<std::size_t> merged_ends;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      step_of_loop();
      const std::size_t middle = ends[i], end = ends[std::min(i + 1, ends.size() - 1)];
      const auto at = [&](std::size_t k) {
        return edges.cbegin() + static_cast<std::ptrdiff_t>(k);
      };
      std::merge(at(begin), at(middle), at(middle), at(end), std::back_inserter(merged), lower);
      merged_ends.push_back(end);
      begin = end;
    }
    edges.swap(merged);
    ends.swap(merged_ends);
  }
}

std::vector<Edge> edges_by_height(const Profile& profile) {
  std::size_t count = 0;
  for (const Polygon& polygon : profile.pieces) count += polygon.size();
  std::vector<Edge> edges;
  edges.reserve(count);
  for (std::size_t piece = 0; piece < profile.pieces.size(); ++piece) {
    const Polygon& polygon = profile.pieces[piece];
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      step_of_loop();
      const auto [bottom, top] = std::minmax({polygon[i].y, polygon[after(i, polygon.size())].y});
      edges.push_back({bottom, top, piece, i});
    }
  }
  std::vector<std::size_t> ends;
  for (std::size_t begin = 0; begin < edges.size(); begin = ends.back()) {
    std::size_t end = begin + 1;
    const auto goes_on = [&](auto ordered) {
      while (end < edges.size() && ordered(edges[end - 1].bottom, edges[end].bottom)) ++end;
    };
    goes_on([](double a, double b) { return a <= b; });
    if (edges[end - 1].bottom == edges[begin].bottom) {
      goes_on([](double a, double b) { return a >= b; });
      std::reverse(edges.begin() + static_cast<std::ptrdiff_t>(begin),
                   edges.begin() + static_cast<std::ptrdiff_t>(end));
    }
    ends.push_back(end);
  }
  merge_runs(edges, std::move(ends));
  return edges;
}

// Sections of stacks have few. The cost is quadratic in this number.
constexpr std::size_t kMostAbreast = 1000;

/// A sweep from the bottom up. An edge is compared with those that reach its lower end; for the
/// section of a stack these are few, so the sweep costs no more than the sort.
class UpwardSweep {
 public:
  explicit UpwardSweep(const Profile& profile)
      : profile_(profile), entered_(profile.pieces.size(), false) {}

  Result<void> run() {
    for (const Edge& edge : edges_by_height(profile_)) {
      step_of_loop();
      std::erase_if(reached_, [&](const Edge& other) { return other.top < edge.bottom; });
      for (const Edge& other : reached_)
        if (meet(other, edge)) return crossing(other, edge);
      if (!entered_[edge.piece] && inside_another(lower_end(edge)))
        return unsound(edge.piece,
                       "expected pieces beside each other, found this one inside "
                       "another at " +
                           place(lower_end(edge)));
      entered_[edge.piece] = true;
      reached_.push_back(edge);
      if (reached_.size() > kMostAbreast) return crowd(edge);
    }
    return {};
  }

 private:
  const ProfilePoint& from(const Edge& edge) const {
    return profile_.pieces[edge.piece][edge.vertex];
  }
  const ProfilePoint& to(const Edge& edge) const {
    const Polygon& polygon = profile_.pieces[edge.piece];
    return polygon[after(edge.vertex, polygon.size())];
  }
  const ProfilePoint& lower_end(const Edge& edge) const {
    return from(edge).y <= to(edge).y ? from(edge) : to(edge);
  }
  const ProfilePoint& upper_end(const Edge& edge) const {
    return from(edge).y <= to(edge).y ? to(edge) : from(edge);
  }
  bool follows(const Edge& first, const Edge& second) const {
    return first.piece == second.piece &&
           after(first.vertex, profile_.pieces[first.piece].size()) == second.vertex;
  }

  /// Consecutive edges share a vertex. Where they fold back onto each other, one of them also meets
  /// the next edge, or there is none and the polygon is a degenerate triangle.
  bool meet(const Edge& a, const Edge& b) const {
    if (follows(a, b) || follows(b, a)) return false;
    const auto [a_near, a_far] = std::minmax({from(a).rho, to(a).rho});
    const auto [b_near, b_far] = std::minmax({from(b).rho, to(b).rho});
    return a_near <= b_far && b_near <= a_far &&
           CGAL::do_intersect(Kernel::Segment_2(exact(from(a)), exact(to(a))),
                              Kernel::Segment_2(exact(from(b)), exact(to(b))));
  }

  /// Whether `p`, a lowest vertex of its piece, lies in another piece: parity of the edges between
  /// it and the axis. Edges count without their lower end, so a vertex on the ray counts once.
  bool inside_another(const ProfilePoint& p) const {
    const auto left_of_p = [&](const Edge& edge) {
      return edge.bottom < p.y && CGAL::orientation(exact(lower_end(edge)), exact(upper_end(edge)),
                                                    exact(p)) == CGAL::RIGHT_TURN;
    };
    return std::count_if(reached_.begin(), reached_.end(), left_of_p) % 2 == 1;
  }

  tl::unexpected<Error> crowd(const Edge& edge) const {
    return unsound(edge.piece, "expected at most " + std::to_string(kMostAbreast) +
                                   " edges at one height, found more at " + place(lower_end(edge)));
  }

  tl::unexpected<Error> crossing(const Edge& a, const Edge& b) const {
    return unsound(a.piece, "expected edges that stay apart, found that the one from " +
                                place(from(a)) + " to " + place(to(a)) + " meets the one from " +
                                place(from(b)) + " to " + place(to(b)) + " of piece " +
                                std::to_string(b.piece));
  }

  const Profile& profile_;
  std::vector<Edge> reached_;  ///< begun, and not ended below the current edge
  std::vector<bool> entered_;  ///< by piece
};

/// The turn at the smallest vertex of a simple polygon gives its orientation.
Result<void> check_counterclockwise(const Polygon& polygon, std::size_t piece) {
  const auto least = std::min_element(
      polygon.begin(), polygon.end(),
      [](const auto& a, const auto& b) { return a.rho != b.rho ? a.rho < b.rho : a.y < b.y; });
  const auto i = static_cast<std::size_t>(least - polygon.begin());
  if (CGAL::orientation(exact(polygon[before(i, polygon.size())]), exact(*least),
                        exact(polygon[after(i, polygon.size())])) == CGAL::LEFT_TURN)
    return {};
  return unsound(
      piece, "expected vertices in counterclockwise order, found clockwise at " + place(*least));
}

}  // namespace

Result<PlanarCertificate> certify(const Profile& profile) {
  if (profile.pieces.empty())
    return failure(ErrorKind::unsound, "profile: expected at least one piece of clay, found none");
  PlanarCertificate certificate;
  for (std::size_t piece = 0; piece < profile.pieces.size(); ++piece) {
    const Polygon& polygon = profile.pieces[piece];
    const auto axis_segments =
        check_points(polygon, piece).and_then([&] { return check_axis(polygon, piece); });
    if (!axis_segments) return tl::make_unexpected(axis_segments.error());
    certificate.axis_segments += *axis_segments;
    certificate.vertices += polygon.size();
    ++certificate.polygons;
  }
  if (auto apart = UpwardSweep(profile).run(); !apart) return tl::make_unexpected(apart.error());
  for (std::size_t piece = 0; piece < profile.pieces.size(); ++piece)
    if (auto turn = check_counterclockwise(profile.pieces[piece], piece); !turn)
      return tl::make_unexpected(turn.error());
  return certificate;
}

}  // namespace clay::solid::inline proof
