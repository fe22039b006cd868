#include "claystack/export/walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace clay::solid::inline walls {
namespace {

double distance(const ProfilePoint& a, const ProfilePoint& b) {
  return std::hypot(b.rho - a.rho, b.y - a.y);
}

/// The steepest mean angle over stretches that begin at each vertex of a polygon. Counterclockwise,
/// an underside runs away from the axis.
class Undersides {
 public:
  Undersides(const Polygon& polygon, double bed) : polygon_(polygon), bed_(bed) {}

  void search(Overhang& steepest) {
    double length = 0.0;
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < polygon_.size(); ++begin) {
      if (end < begin) end = begin, length = 0.0;
      while (length < kOverhangLengthMm && end < begin + polygon_.size())
        length += distance(at(end), at(end + 1)), ++end;
      measure(begin, end, length, steepest);
      length -= distance(at(begin), at(begin + 1));
    }
  }

 private:
  [[nodiscard]] const ProfilePoint& at(std::size_t i) const {
    return polygon_[i % polygon_.size()];
  }

  /// From vertex `begin` along kOverhangLengthMm of the `length` up to vertex `end`.
  void measure(std::size_t begin, std::size_t end, double length, Overhang& steepest) const {
    if (end == begin) return;
    const double last = distance(at(end - 1), at(end));
    const double part =
        last > 0.0 ? std::clamp((length - kOverhangLengthMm) / last, 0.0, 1.0) : 0.0;
    const ProfilePoint from = at(begin);
    const ProfilePoint to{std::lerp(at(end).rho, at(end - 1).rho, part),
                          std::lerp(at(end).y, at(end - 1).y, part)};
    if (from.y <= bed_ && at(begin + 1).y <= bed_) return;
    const double chord = distance(from, to);
    // A stretch around an edge or a lip is no underside.
    if (chord < 0.9 * std::min(length, kOverhangLengthMm)) return;
    const double angle = std::asin(std::clamp((to.rho - from.rho) / chord, -1.0, 1.0));
    const double angle_deg = angle * 180.0 / std::numbers::pi;
    if (angle_deg > steepest.angle_deg) steepest = {angle_deg, from, to};
  }

  const Polygon& polygon_;
  double bed_;
};

}  // namespace

Overhang steepest_overhang(const Profile& profile) {
  double bed = std::numeric_limits<double>::infinity(), top = -bed;
  for (const Polygon& polygon : profile.pieces)
    for (const ProfilePoint& point : polygon) {
      bed = std::min(bed, point.y);
      top = std::max(top, point.y);
    }
  Overhang steepest;
  const double rounding = 1e-9 * (top - bed);
  for (const Polygon& polygon : profile.pieces)
    Undersides(polygon, bed + rounding).search(steepest);
  return steepest;
}

}  // namespace clay::solid::inline walls
