#include "export/smoothing/fair_wall.hpp"

#include "core/cancel.hpp"
#include "core/compensated_sum.hpp"
#include "export/section/simplify_line.hpp"
#include "export/section/swept_volume.hpp"
#include "export/smoothing/faired_curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace clay::solid::inline smoothing {
namespace {

constexpr double kLeastShare = 0.5;  ///< of the smallest radius of a stretch
/// Part of the tolerance for the chords of a curve; the rest is for omitting their points. The
/// smaller the part, the fewer edges remain.
constexpr double kChordShare = 0.125;

class FairWallMaker {
 public:
  FairWallMaker(const PieceWalls& piece, const WallRings& wall, const FairRings& rings)
      : piece_(piece), wall_(wall), rings_(rings) {}

  FairWall run(const CutFlags& cut) {
    for_each_run(cut, [&](std::size_t first, std::size_t end) {
      run_.clear();
      tolerances_.clear();
      for (std::size_t i = first; i < end;) i = add_stretch({piece_, wall_, first, end}, i);
      const Polygon spared = simplified(run_, tolerances_);
      made_.line.insert(made_.line.end(), spared.begin(), spared.end());
    });
    made_.line = without_straight_points(made_.line);
    return std::move(made_);
  }

 private:
  [[nodiscard]] bool faired(std::size_t ring) const {
    return !rings_.lengths_mm.empty() && rings_.lengths_mm[ring] > 0.0;
  }

  /// Adds the rings from `first` on that are all faired or all not. Returns the first one after
  /// them.
  std::size_t add_stretch(const RunOfRings& run, std::size_t first) {
    std::size_t end = first + 1;
    while (end < run.end && faired(end) == faired(first)) ++end;
    const RunOfRings stretch{piece_, wall_, first, end};
    const bool solid = wall_.radius[first] == 0.0;
    if (solid || !faired(first) || stretch.size() < kLeastFairedRings || !add_curve(stretch))
      add_chords(run, stretch);
    return end;
  }

  void add_chords(const RunOfRings& run, const RunOfRings& stretch) {
    if (stretch.first == run.first) add({wall_.radius[stretch.first], stretch.bottom_mm()}, 0.0);
    for (std::size_t i = stretch.first; i < stretch.end; ++i)
      add({wall_.radius[i], stretch.middle_mm(i)}, rings_.tolerances_mm[i]);
    if (stretch.end == run.end) add({wall_.radius[stretch.end - 1], stretch.top_mm()}, 0.0);
  }

  /// False if the curve comes too close to the axis.
  bool add_curve(const RunOfRings& stretch) {
    const FairedCurve curve(stretch, rings_.lengths_mm);
    const Polygon points = curve.points(kChordShare * rings_.tolerance_mm);
    const auto begin = wall_.radius.begin();
    const double least = *std::min_element(begin + std::ptrdiff_t(stretch.first),
                                           begin + std::ptrdiff_t(stretch.end));
    if (std::ranges::min(points, {}, &ProfilePoint::rho).rho < kLeastShare * least) return false;
    for (std::size_t i = stretch.first, p = 0; p < points.size(); ++p) {
      while (i + 1 < stretch.end && piece_.level[i + 1] < points[p].y) ++i;
      const bool end = p == 0 || p + 1 == points.size();
      add(points[p], end ? 0.0 : (1.0 - kChordShare) * rings_.tolerances_mm[i]);
    }
    for (std::size_t i = stretch.first; i < stretch.end; ++i) {
      const double y = stretch.middle_mm(i), moved = std::abs(curve.at(y) - wall_.radius[i]);
      if (moved > made_.most.mm) made_.most = {moved, y};
    }
    return true;
  }

  void add(const ProfilePoint& point, double tolerance_mm) {
    run_.push_back(point);
    tolerances_.push_back(tolerance_mm);
  }

  const PieceWalls& piece_;
  const WallRings& wall_;
  const FairRings& rings_;
  Polygon run_;                     ///< the current one
  std::vector<double> tolerances_;  ///< of its points
  FairWall made_;
};

}  // namespace

FairWall fair_wall(const PieceWalls& piece, const WallRings& wall, const CutFlags& cut,
                   const FairRings& rings) {
  return FairWallMaker(piece, wall, rings).run(cut);
}

Polygon stepped_wall(const PieceWalls& piece, const WallRings& wall) {
  Polygon line;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    step_of_loop();
    line.push_back({wall.radius[i], piece.level[i]});
    line.push_back({wall.radius[i], piece.level[i + 1]});
  }
  return without_straight_points(line);
}

double swept_over_pi(const Polygon& line) noexcept {
  return thrice_squared_radii(line, false) / 3.0;
}

double scale_for(const Polygon& line, const std::vector<double>& weights,
                 double wanted_over_pi) noexcept {
  CompensatedSum linear, square;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double dy = line[i + 1].y - line[i].y, a = line[i].rho, b = line[i + 1].rho;
    const double moved_a = weights[i] * a, moved_b = weights[i + 1] * b;
    linear.add(dy * (2.0 * a * moved_a + a * moved_b + b * moved_a + 2.0 * b * moved_b));
    square.add(dy * (moved_a * moved_a + moved_a * moved_b + moved_b * moved_b));
  }
  const double lacking = 3.0 * (wanted_over_pi - swept_over_pi(line));
  const double under_root = linear.value() * linear.value() + 4.0 * square.value() * lacking;
  if (!(linear.value() > 0.0) || under_root < 0.0) return 0.0;
  return 2.0 * lacking / (linear.value() + std::sqrt(under_root));
}

double scale(Polygon& line, const std::vector<double>& weights, double share) noexcept {
  double most = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double move = line[i].rho * weights[i] * share;
    line[i].rho += move;
    most = std::max(most, std::abs(move));
  }
  return most;
}

}  // namespace clay::solid::inline smoothing
