#include "export/smoothing/exact_wall.hpp"

#include "core/cancel.hpp"
#include "export/section/simplify_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace clay::solid::inline smoothing {
namespace {

constexpr std::size_t kFrusta = 4;
/// A new cut can change the ends of runs up to this many rings back.
constexpr std::size_t kCutReach = 3;

using RingLine = std::array<ProfilePoint, kFrusta + 1>;

double fraction(std::size_t j) { return static_cast<double>(j) / kFrusta; }
double bulge(std::size_t j) { return 4.0 * fraction(j) * (1.0 - fraction(j)); }

/// 3 / pi times the volume of the frusta between points.
double frusta(const RingLine& line) {
  double sum = 0.0;
  for (std::size_t j = 0; j < kFrusta; ++j) {
    const ProfilePoint &a = line[j], &b = line[j + 1];
    sum += (b.y - a.y) * (a.rho * a.rho + a.rho * b.rho + b.rho * b.rho);
  }
  return sum;
}

/// Moves the points between the ends by s 4t(1 - t) so that the frusta hold `wanted`.
void hold_exactly(RingLine& line, double wanted) {
  double linear = 0.0, square = 0.0;
  for (std::size_t j = 0; j < kFrusta; ++j) {
    const double dy = line[j + 1].y - line[j].y, a = line[j].rho, b = line[j + 1].rho;
    const double s = bulge(j), t = bulge(j + 1);
    linear += dy * (2.0 * a * s + a * t + b * s + 2.0 * b * t);
    square += dy * (s * s + s * t + t * t);
  }
  const double lacking = wanted - frusta(line);
  const double s = 2.0 * lacking / (linear + std::sqrt(linear * linear + 4.0 * square * lacking));
  for (std::size_t j = 1; j < kFrusta; ++j) line[j].rho += s * bulge(j);
}

class ExactWallMaker {
 public:
  ExactWallMaker(const PieceWalls& piece, const WallRings& wall, CutFlags& cut)
      : piece_(piece), wall_(wall), cut_(cut) {}

  ExactWall run(double overshoot_limit_mm) {
    cut_overshoots(overshoot_limit_mm);
    for (std::size_t i = 0; i < piece_.size(); ++i) {
      step_of_loop();
      const RingLine line = ring_line(i);
      result_.line.insert(result_.line.end(), line.begin(), line.end());
      result_.overshoot_mm = std::max(result_.overshoot_mm, overshoot(i, line));
      result_.extrapolated_mm = std::max(result_.extrapolated_mm, extrapolated(i, line));
      const double wanted = 3.0 * wall_.square[i] * piece_.height_mm(i);
      if (wanted > 0.0)
        result_.largest_error =
            std::max(result_.largest_error, std::abs(frusta(line) / wanted - 1.0));
    }
    result_.line = without_straight_points(result_.line);
    return std::move(result_);
  }

 private:
  void cut_overshoots(double limit_mm) {
    for (std::size_t i = 0; i < piece_.size();) {
      step_of_loop();
      const double found = overshoot(i, ring_line(i));
      const std::optional<std::size_t> widest = found > limit_mm ? widest_open(i) : std::nullopt;
      if (!widest) {
        ++i;
        continue;
      }
      cut_[*widest] = 1;
      result_.cut.push_back({*widest, found});
      i -= std::min(i, kCutReach);
    }
  }

  double tread(std::size_t interface) const {
    return std::abs(wall_.radius[interface] - wall_.radius[interface - 1]);
  }

  std::optional<std::size_t> widest_open(std::size_t ring) const {
    std::optional<std::size_t> widest;
    for (const std::size_t k : {ring, ring + 1})
      if (cut_[k] == 0 && tread(k) >= piece_.least_step_mm &&
          (!widest || tread(k) > tread(*widest)))
        widest = k;
    return widest;
  }

  /// The radius of a hypothetical ring below (or above) ring `i`, the last of its run.
  double virtual_radius(std::size_t i, bool below) const {
    const double own = wall_.radius[i];
    const bool ends_piece = below ? i == 0 : i + 1 == piece_.size();
    if (ends_piece && (below ? piece_.stands_on_piece : piece_.carries_piece)) return own;
    // The interfaces on the other side of the ring and of its neighbour.
    const std::size_t near = below ? i + 1 : i;
    if (cut_[near] != 0) return own;
    const std::size_t next = below ? i + 1 : i - 1, far = below ? i + 2 : i - 1;
    if (cut_[far] != 0) return own;
    const double step = own - wall_.radius[next];
    const double step_before = wall_.radius[next] - wall_.radius[below ? i + 2 : i - 2];
    if (step * step_before <= 0.0) return own;
    const double smaller = std::min(std::abs(step), std::abs(step_before));
    return std::max(own + std::copysign(smaller, step), own / std::numbers::sqrt2);
  }

  /// R^2 where two rings meet.
  double between(double lower, double lower_height, double upper, double upper_height) const {
    if (lower == upper) return lower;
    const double lower_weight = lower_height + 2.0 * upper_height;
    const double upper_weight = 2.0 * lower_height + upper_height;
    return (lower_weight + upper_weight) / (lower_weight / lower + upper_weight / upper);
  }

  /// R^2 of the wall of ring `i` where its run ends, below (or above) the ring.
  double end_square(std::size_t i, bool below) const {
    const double virtual_end = virtual_radius(i, below);
    return between(wall_.square[i], 1.0, virtual_end * virtual_end, 1.0);
  }

  /// R^2 at the interface on the lower (or upper) side of ring `i`.
  double square_at(std::size_t i, bool below) const {
    const std::size_t k = below ? i : i + 1;
    if (cut_[k] == 0)
      return between(wall_.square[k - 1], piece_.height_mm(k - 1), wall_.square[k],
                     piece_.height_mm(k));
    if (virtual_radius(i, below) == wall_.radius[i]) return wall_.square[i];
    if (k == 0 || k == piece_.size()) return end_square(i, below);
    // The two ends of a cut may come so close that no tread remains: then neither is extrapolated.
    const double lower = end_square(k - 1, false), upper = end_square(k, true);
    if (std::abs(std::sqrt(lower) - std::sqrt(upper)) < piece_.least_step_mm)
      return wall_.square[i];
    return below ? upper : lower;
  }

  RingLine ring_line(std::size_t i) const {
    const double bottom = piece_.level[i], top = piece_.level[i + 1], own = wall_.square[i];
    const double lower = square_at(i, true), upper = square_at(i, false);
    const double middle = 6.0 * (own - 0.5 * (lower + upper));
    RingLine line;
    for (std::size_t j = 0; j <= kFrusta; ++j) {
      const double t = fraction(j);
      const double square = lower + t * (upper - lower) + middle * t * (1.0 - t);
      line[j] = {std::sqrt(square), bottom + t * (top - bottom)};
    }
    line.front() = {std::sqrt(lower), bottom};
    line.back() = {std::sqrt(upper), top};
    if (lower == own && upper == own)
      for (ProfilePoint& p : line) p.rho = wall_.radius[i];
    else
      hold_exactly(line, 3.0 * own * piece_.height_mm(i));
    return line;
  }

  double overshoot(std::size_t i, const RingLine& line) const {
    const double below = cut_[i] == 0 ? wall_.radius[i - 1] : virtual_radius(i, true);
    const double above = cut_[i + 1] == 0 ? wall_.radius[i + 1] : virtual_radius(i, false);
    return beyond(std::minmax({below, wall_.radius[i], above}), line);
  }

  /// The distance from the radii of the ring and of those beside it in the piece.
  double extrapolated(std::size_t i, const RingLine& line) const {
    const double below = wall_.radius[i == 0 ? i : i - 1];
    const double above = wall_.radius[std::min(i + 1, piece_.size() - 1)];
    return beyond(std::minmax({below, wall_.radius[i], above}), line);
  }

  static double beyond(const std::pair<double, double>& range, const RingLine& line) {
    double most = 0.0;
    for (const ProfilePoint& p : line)
      most = std::max({most, range.first - p.rho, p.rho - range.second});
    return most;
  }

  const PieceWalls& piece_;
  const WallRings& wall_;
  CutFlags& cut_;
  ExactWall result_;
};

}  // namespace

ExactWall exact_wall(const PieceWalls& piece, const WallRings& wall, CutFlags& cut,
                     double overshoot_limit_mm) {
  return ExactWallMaker(piece, wall, cut).run(overshoot_limit_mm);
}

}  // namespace clay::solid::inline smoothing
