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

/// The tangent of kHeldDeg.
inline constexpr double kSteepestHeld = 10.0;

/// A small part of an underside.
template <class Place>
struct UndersidePart {
  double slope = 0.0;  ///< tangent of the angle from the vertical, infinite if level
  double area_mm2 = 0.0;
  Place place;
  [[nodiscard]] bool operator<(const UndersidePart& other) const { return slope < other.slope; }
};

/// The part at which the steepest ones together reach kOverhangAreaMm2; empty if all are smaller.
/// Parts have the slopes of their faces. `held(place)` returns the least slope of a line down to
/// clay, infinite if no clay holds the place. It is called only for parts whose faces are
/// steeper than the result.
template <class Place, class Held>
std::optional<UndersidePart<Place>> steepest_part(std::vector<UndersidePart<Place>> faces,
                                                  const Held& held) {
  std::priority_queue<UndersidePart<Place>> steepest(std::less<UndersidePart<Place>>(),
                                                     std::move(faces));
  std::priority_queue<UndersidePart<Place>> examined;
  double area_mm2 = 0.0;
  while (!steepest.empty() || !examined.empty()) {
    if (steepest.empty() || (!examined.empty() && !(examined.top() < steepest.top()))) {
      area_mm2 += examined.top().area_mm2;
      if (area_mm2 >= kOverhangAreaMm2) return examined.top();
      examined.pop();
      continue;
    }
    UndersidePart<Place> part = steepest.top();
    steepest.pop();
    if (const double slope = held(part.place); slope <= kSteepestHeld)
      part.slope = std::min(part.slope, slope);
    examined.push(part);
  }
  return std::nullopt;
}

}  // namespace clay::solid::inline walls
