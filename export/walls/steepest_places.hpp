#pragma once
#include "claystack/export/walls.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

namespace clay::solid::inline walls {

/// A small part of an underside.
template <class Place>
struct UndersidePart {
  double slope = 0.0;  ///< tangent of the angle from the vertical, infinite if level
  double area_mm2 = 0.0;
  Place place;
  std::size_t order = 0;  ///< of parts with the same slope, the first comes first on every platform
  [[nodiscard]] bool operator<(const UndersidePart& other) const {
    return slope < other.slope || (slope == other.slope && order > other.order);
  }
};

/// The part at which the steepest ones together reach kOverhangAreaMm2; empty if all are smaller.
/// Faces have their own slopes. `examine(face, found)` calls `found(part)` for each part of a face;
/// parts are at most as steep as it. Only faces steeper than the result are examined.
template <class Place, class Examine>
std::optional<UndersidePart<Place>> steepest_part(std::vector<UndersidePart<Place>> faces,
                                                  const Examine& examine) {
  std::size_t order = 0;
  for (UndersidePart<Place>& face : faces) face.order = order++;
  std::priority_queue<UndersidePart<Place>> steepest(std::less<UndersidePart<Place>>(),
                                                     std::move(faces));
  std::priority_queue<UndersidePart<Place>> examined;
  double area_mm2 = 0.0;
  while (!steepest.empty() || !examined.empty()) {
    if (steepest.empty() || (!examined.empty() && !(examined.top().slope < steepest.top().slope))) {
      area_mm2 += examined.top().area_mm2;
      if (area_mm2 >= kOverhangAreaMm2) return examined.top();
      examined.pop();
      continue;
    }
    examine(steepest.top(), [&](UndersidePart<Place> part) {
      part.order = order++;
      examined.push(part);
    });
    steepest.pop();
  }
  return std::nullopt;
}

}  // namespace clay::solid::inline walls
