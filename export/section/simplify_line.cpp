#include "export/section/simplify_line.hpp"

#include "core/cancel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace clay::solid::inline section {
namespace {

/// The search continues this far past the last valid point, beyond the length found so far: this
/// bounds the total cost to a multiple of the points.
constexpr std::size_t kLookAhead = 32;

struct Direction {
  double rho = 0.0, y = 0.0;
};

double cross(const Direction& a, const Direction& b) { return a.rho * b.y - a.y * b.rho; }
double dot(const Direction& a, const Direction& b) { return a.rho * b.rho + a.y * b.y; }

/// The directions from an apex that pass every point so far within its tolerance.
class Cone {
 public:
  explicit Cone(const ProfilePoint& apex) : apex_(apex) {}

  /// Whether an edge from the apex to `p` passes all added points within their tolerances. No added
  /// point is farther from the apex, so their nearest points on the line are on the edge.
  [[nodiscard]] bool allows(const ProfilePoint& p) const {
    const Direction way{p.rho - apex_.rho, p.y - apex_.y};
    if (std::sqrt(dot(way, way)) < farthest_) return false;
    return open_ ||
           (dot(middle_, way) > 0.0 && cross(low_, way) >= 0.0 && cross(way, high_) >= 0.0);
  }

  /// Returns false when no direction is left.
  bool add(const ProfilePoint& p, double tolerance_mm) {
    Direction way{p.rho - apex_.rho, p.y - apex_.y};
    const double length = std::sqrt(dot(way, way));
    farthest_ = std::max(farthest_, length);
    if (length <= tolerance_mm) return true;
    way = {way.rho / length, way.y / length};
    const double sine = tolerance_mm / length, cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    const Direction low{way.rho * cosine + way.y * sine, way.y * cosine - way.rho * sine};
    const Direction high{way.rho * cosine - way.y * sine, way.y * cosine + way.rho * sine};
    if (open_) {
      open_ = false;
      middle_ = way, low_ = low, high_ = high;
      return true;
    }
    // Gives up on points at right angles to the first, seen from the apex: then everything that can
    // narrow the cone lies within a right angle of its middle, and the signs below decide.
    if (dot(middle_, way) <= 0.0) return false;
    if (dot(middle_, low) > 0.0 && cross(low_, low) > 0.0) low_ = low;
    if (dot(middle_, high) > 0.0 && cross(high_, high) < 0.0) high_ = high;
    return cross(low_, high_) >= 0.0;
  }

 private:
  ProfilePoint apex_;
  bool open_ = true;  ///< not yet narrowed by a point
  Direction middle_, low_, high_;
  double farthest_ = 0.0;
};

std::size_t next_point(const Polygon& line, const std::vector<double>& tolerances_mm,
                       std::size_t apex) {
  Cone cone(line[apex]);
  std::size_t next = apex + 1;
  for (std::size_t i = next; i < line.size(); ++i) {
    step_of_loop();
    if (cone.allows(line[i])) next = i;
    if (tolerances_mm[i] <= 0.0 || i - next > next - apex + kLookAhead ||
        !cone.add(line[i], tolerances_mm[i]))
      break;
  }
  return next;
}

}  // namespace

Polygon simplified(const Polygon& line, const std::vector<double>& tolerances_mm) {
  Polygon result{line.front()};
  for (std::size_t i = 0; i + 1 < line.size();) {
    step_of_loop();
    i = next_point(line, tolerances_mm, i);
    result.push_back(line[i]);
  }
  return result;
}

Polygon without_straight_points(const Polygon& line) {
  Polygon result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    step_of_loop();
    if (!result.empty() && line[i] == result.back()) continue;
    if (!result.empty() && i + 1 < line.size() && result.back().rho == line[i].rho &&
        line[i + 1].rho == line[i].rho)
      continue;
    result.push_back(line[i]);
  }
  return result;
}

}  // namespace clay::solid::inline section
