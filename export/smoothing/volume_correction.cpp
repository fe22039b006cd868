#include "export/smoothing/volume_correction.hpp"

#include "core/cancel.hpp"
#include "export/smoothing/fair_wall.hpp"
#include "export/smoothing/lip_fillet.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace clay::solid::inline smoothing {
namespace {

constexpr int kFilletRounds = 6;
constexpr int kCarefulRounds = 8;
constexpr double kSettledShare = 1e-14;     ///< relative change of radii that ends the rounds
constexpr double kInvisibleHeights = 0.01;  ///< of a ring

}  // namespace

double VolumeCorrection::allowed_move_mm() const {
  return std::max(tolerance_mm_, kInvisibleHeights * piece_.ring_height_mm);
}

VolumeCorrection::Found VolumeCorrection::find(const WallLines& lines) {
  Found found{corrected(lines, all_rings(), 0.0), all_rings()};
  const bool taken = found.walls.lacking_over_pi < 0.0;
  if (!taken || !WallGauge(piece_, found.walls.lines).thinner_than(limit_mm_)) return found;
  RingFlags rings = thick_rings(lines);
  CorrectedWalls careful = careful_correction(lines, rings);
  if (careful.moved_mm > 0.0) return {std::move(careful), std::move(rings)};
  found.taken_mm = found.walls.moved_mm;
  return found;
}

/// The fillet is applied after scaling, so that its arcs stay round; the clay that it removes
/// changes the scale a little. The last round only scales the small remainder.
CorrectedWalls VolumeCorrection::corrected(const WallLines& lines, const RingFlags& rings,
                                           double fillet_mm) const {
  CorrectedWalls made;
  WallLines scaled = lines;
  for (int round = 1;; ++round) {
    made.lines = scaled;
    if (fillet_mm > 0.0) {
      FilletedLip lip = with_lip_fillet(scaled, fillet_mm, 0.5 * tolerance_mm_);
      made.lines = std::move(lip.lines);
      made.fillet_mm = fillet_mm = lip.radius_mm;
    }
    const double wanted = piece_.clay_over_pi + swept_over_pi(made.lines.bore);
    made.lacking_over_pi += wanted - swept_over_pi(made.lines.outer);
    const std::vector<double> weights = weights_of(made.lines.outer, rings);
    const double share = scale_for(made.lines.outer, weights, wanted);
    made.moved_mm += scale(scaled.outer, weights_of(scaled.outer, rings), share);
    if (fillet_mm > 0.0 && std::abs(share) > kSettledShare && round < kFilletRounds) continue;
    scale(made.lines.outer, weights, share);
    return made;
  }
}

/// 1 for points whose edges all lie in flagged rings, else 0.
std::vector<double> VolumeCorrection::weights_of(const Polygon& line,
                                                 const RingFlags& rings) const {
  std::vector<double> weights(line.size(), 1.0);
  std::size_t first = 0;
  for (std::size_t e = 0; e + 1 < line.size(); ++e) {
    step_of_loop();
    while (first + 1 < piece_.size() && piece_.level[first + 1] < line[e].y) ++first;
    for (std::size_t i = first; i < piece_.size() && piece_.level[i] <= line[e + 1].y; ++i)
      if (rings[i] == 0) weights[e] = weights[e + 1] = 0.0;
  }
  return weights;
}

/// Rings that can be moved as far as allowed without approaching the limit of the guard.
RingFlags VolumeCorrection::thick_rings(const WallLines& lines) {
  const double spare = 2.0 * allowed_move_mm();  // across a solid both sides move
  const std::vector<double>& own = own_walls_.by_ring_mm(all_rings());
  const std::vector<double> now = walls_of(lines, limit_mm_ + spare);
  RingFlags thick(piece_.size());
  for (std::size_t i = 0; i < piece_.size(); ++i)
    thick[i] = now[i] >= (own[i] + spare) * kWallRounding ? 1 : 0;
  return thick;
}

/// Moves only the flagged rings, which must be thick. A wall runs from the outside of one ring to
/// the bore of another one: where the move thins a wall, the rings around it are unflagged. Moves
/// nothing if too few rings remain.
CorrectedWalls VolumeCorrection::careful_correction(const WallLines& lines, RingFlags& rings) {
  const std::vector<double>& own = own_walls_.by_ring_mm(all_rings());
  const std::vector<double> before = walls_of(lines, limit_mm_);
  for (int round = 0; round < kCarefulRounds; ++round) {
    CorrectedWalls made = corrected(lines, rings, 0.0);
    if (!(made.moved_mm <= allowed_move_mm())) break;
    const std::vector<double> now = walls_of(made.lines, limit_mm_);
    bool thinned = false;
    std::size_t done = 0;
    for (std::size_t i = 0; i < piece_.size(); ++i) {
      if (now[i] >= std::min(own[i], before[i]) * kWallRounding) continue;
      thinned = true;
      const auto [first, last] = plan_.rings_around({i, now[i]});
      for (done = std::max(done, first); done <= last; ++done) rings[done] = 0;
    }
    if (!thinned) return made;
  }
  return {};
}

std::vector<double> VolumeCorrection::walls_of(const WallLines& lines, double cap_mm) const {
  return WallGauge(piece_, lines).by_ring_mm(cap_mm, all_rings());
}

}  // namespace clay::solid::inline smoothing
