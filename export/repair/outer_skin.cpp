#include "export/repair/outer_skin.hpp"

#include "core/cancel.hpp"
#include "export/repair/winding_ray.hpp"
#include "export/solid/disjoint_sets.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace clay::solid::inline repair {
namespace {

/// A triangle at an edge.
struct Wing {
  std::uint32_t low, high;  ///< the edge
  std::uint32_t triangle;
  std::uint32_t apex;
  bool rising;  ///< the triangle follows the edge from low to high
};

/// The side of a triangle: its front has the even number.
std::uint32_t side(std::uint32_t triangle, bool front) { return 2 * triangle + (front ? 0 : 1); }

class Regions {
 public:
  Regions(const ExactSoup& soup, const TriangleMesh& original)
      : soup_(soup), original_(original), regions_(2 * soup.triangles.size()) {}

  Result<OuterSkin> skin() {
    if (!join_sides()) return open();
    if (!number_regions()) return open();
    OuterSkin result;
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      const int front = winding_of(t, true), back = winding_of(t, false);
      result.reversed = result.reversed || front < 0 || back < 0;
      if (front <= 0 && back > 0)
        result.triangles.push_back(soup_.triangles[t]);
      else
        ++result.inner;
    }
    return result;
  }

 private:
  static tl::unexpected<Error> open() {
    return failure(ErrorKind::unsound, "expected closed sheets, found one that ends");
  }

  int winding_of(std::uint32_t t, bool front) { return *winding_[regions_.of(side(t, front))]; }

  /// Joins the sides that face each other across the edges. Returns false at an open edge.
  bool join_sides() {
    std::vector<Wing> wings;
    wings.reserve(3 * soup_.triangles.size());
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t a = soup_.triangles[t].at(c), b = soup_.triangles[t].at((c + 1) % 3);
        wings.push_back(
            {std::min(a, b), std::max(a, b), t, soup_.triangles[t].at((c + 2) % 3), a < b});
      }
    std::sort(wings.begin(), wings.end(), [](const Wing& a, const Wing& b) {
      return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    for (std::size_t begin = 0; begin < wings.size();) {
      step_of_loop();
      std::size_t end = begin;
      int sheets = 0;
      for (; end < wings.size() && wings[end].low == wings[begin].low &&
             wings[end].high == wings[begin].high;
           ++end)
        sheets += (wings[end].rising ? 1 : -1) * soup_.sheets[wings[end].triangle];
      if (sheets != 0) return false;
      const auto about = std::span(wings).subspan(begin, end - begin);
      if (about.size() > 2) sort_around(about);
      for (std::size_t i = 0; i < about.size(); ++i) {
        const Wing &wing = about[i], &next = about[(i + 1) % about.size()];
        regions_.unite(side(wing.triangle, wing.rising), side(next.triangle, !next.rising));
      }
      begin = end;
    }
    return true;
  }

  /// Counterclockwise about the edge, from its first wing on.
  void sort_around(std::span<Wing> wings) const {
    const ExactPoint low = soup_.point(wings[0].low), high = soup_.point(wings[0].high);
    struct PlacedWing {
      Wing wing;
      ExactPoint apex;
      int quarter;
    };
    std::vector<PlacedWing> placed;
    const ExactPoint first = soup_.point(wings[0].apex);
    for (std::size_t i = 0; i < wings.size(); ++i) {
      const ExactPoint apex = soup_.point(wings[i].apex);
      const CGAL::Orientation turn = CGAL::orientation(low, high, first, apex);
      const int quarter = i == 0 ? 0 : turn == CGAL::POSITIVE ? 1 : turn == CGAL::COPLANAR ? 2 : 3;
      placed.push_back({wings[i], apex, quarter});
    }
    std::sort(placed.begin(), placed.end(), [&](const PlacedWing& a, const PlacedWing& b) {
      if (a.quarter != b.quarter) return a.quarter < b.quarter;
      return a.wing.triangle != b.wing.triangle &&
             CGAL::orientation(low, high, a.apex, b.apex) == CGAL::POSITIVE;
    });
    std::transform(placed.begin(), placed.end(), wings.begin(),
                   [](const PlacedWing& p) { return p.wing; });
  }

  /// One ray for each set of regions that triangles connect. Returns false for a contradiction.
  bool number_regions() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_region;  // region, triangle
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t)
      for (const bool front : {true, false}) by_region.emplace_back(regions_.of(side(t, front)), t);
    std::sort(by_region.begin(), by_region.end());
    winding_.assign(2 * soup_.triangles.size(), std::nullopt);
    const WindingRay ray(original_);
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      if (winding_[regions_.of(side(t, true))]) continue;
      const auto& [a, b, c] = soup_.triangles[t];
      const auto count = ray.from_middle_of({soup_.point(a), soup_.point(b), soup_.point(c)});
      const std::uint32_t first = regions_.of(side(t, count.front));
      winding_[first] = count.winding;
      if (!spread_from(first, by_region)) return false;
    }
    return true;
  }

  /// From a triangle's front to its back, the winding number grows by its sheets.
  bool spread_from(std::uint32_t first,
                   const std::vector<std::pair<std::uint32_t, std::uint32_t>>& by_region) {
    std::vector<std::uint32_t> open{first};
    while (!open.empty()) {
      const std::uint32_t region = open.back();
      open.pop_back();
      auto at = std::lower_bound(by_region.begin(), by_region.end(), std::pair(region, 0U));
      for (; at != by_region.end() && at->first == region; ++at) {
        const std::uint32_t t = at->second;
        const std::uint32_t front = regions_.of(side(t, true)), back = regions_.of(side(t, false));
        if (front == back) return false;
        const int step = soup_.sheets[t];
        const bool from_front = front == region;
        const std::uint32_t other = from_front ? back : front;
        const int winding = *winding_[region] + (from_front ? step : -step);
        if (!winding_[other]) {
          winding_[other] = winding;
          open.push_back(other);
        } else if (*winding_[other] != winding) {
          return false;
        }
      }
    }
    return true;
  }

  const ExactSoup& soup_;
  const TriangleMesh& original_;
  DisjointSets regions_;
  std::vector<std::optional<int>> winding_;  ///< by region
};

}  // namespace

Result<OuterSkin> outer_skin(const ExactSoup& soup, const TriangleMesh& original) {
  return Regions(soup, original).skin();
}

}  // namespace clay::solid::inline repair
