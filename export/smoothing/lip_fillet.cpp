#include "export/smoothing/lip_fillet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace clay::solid::inline smoothing {
namespace {

constexpr double kLeastFlat = 1e-3;  ///< minimum flat between the arcs, in radii
constexpr double kHalf = 0.499;      ///< slightly below a half, so that a flat remains
constexpr int kHalvings = 40;        ///< in the search for the largest radius
/// Of the largest radius that fits, so that it still fits when the volume correction moved the
/// wall.
constexpr double kRoomToMove = 0.99;

/// A circle inside the clay that touches the top and the wall.
struct Fillet {
  double centre_rho = std::numeric_limits<double>::max();
  ProfilePoint touch;
  std::size_t below = 0;  ///< points of the line from the bottom to the touch
};

/// Of all circles that touch an edge or a bend, the one deepest in the clay. Radii are measured
/// towards the air, so that the clay is always at smaller radii.
class FilletSearch {
 public:
  FilletSearch(const Polygon& line, double radius_mm)
      : line_(line), radius_(radius_mm), centre_y_(line.back().y - radius_mm) {}

  Fillet run() {
    for (std::size_t i = line_.size(); i-- > 0;) {
      try_bend(i);
      if (i > 0) try_edge(i - 1);
      if (line_[i].y < centre_y_ - radius_) break;
    }
    return best_;
  }

 private:
  void keep(double centre_rho, const ProfilePoint& touch, std::size_t below) {
    if (centre_rho < best_.centre_rho) best_ = {centre_rho, touch, below};
  }

  void try_bend(std::size_t i) {
    const double up = line_[i].y - centre_y_;
    if (std::abs(up) > radius_) return;
    keep(line_[i].rho - std::sqrt(radius_ * radius_ - up * up), line_[i], i);
  }

  void try_edge(std::size_t i) {
    const ProfilePoint &a = line_[i], &b = line_[i + 1];
    const double length = std::hypot(b.rho - a.rho, b.y - a.y);
    const double out_rho = (b.y - a.y) / length, out_y = (a.rho - b.rho) / length;
    const double y = centre_y_ + radius_ * out_y;
    if (!(a.y < y && y < b.y)) return;
    const double rho = a.rho + (b.rho - a.rho) * (y - a.y) / (b.y - a.y);
    keep(rho - radius_ * out_rho, {rho, y}, i + 1);
  }

  const Polygon& line_;
  double radius_;
  double centre_y_;
  Fillet best_;
};

/// Empty if the arcs would meet.
std::optional<FilletedLip> fitting_lip(const WallLines& lines, double radius_mm,
                                       double tolerance_mm) {
  FilletedLip lip{{with_rounded_edge(lines.outer, radius_mm, tolerance_mm).line, lines.bore},
                  radius_mm};
  if (lines.bore.back().rho > 0.0)
    lip.lines.bore =
        mirrored(with_rounded_edge(mirrored(lines.bore), radius_mm, tolerance_mm).line);
  const double flat = lip.lines.outer.back().rho - lip.lines.bore.back().rho;
  if (flat <= kLeastFlat * radius_mm) return std::nullopt;
  return lip;
}

}  // namespace

RoundedEdge with_rounded_edge(const Polygon& line, double radius_mm, double tolerance_mm) {
  const Fillet fillet = FilletSearch(line, radius_mm).run();
  const double top = line.back().y, centre_y = top - radius_mm;
  Polygon result(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(fillet.below));
  result.push_back(fillet.touch);
  const double begin = std::atan2(fillet.touch.y - centre_y, fillet.touch.rho - fillet.centre_rho);
  const double turn = 0.5 * std::numbers::pi - begin;
  const double step = 2.0 * std::acos(1.0 - std::min(tolerance_mm / radius_mm, 0.5));
  const int steps = std::max(1, static_cast<int>(std::ceil(turn / step)));
  for (int k = 1; k < steps; ++k) {
    const double angle = begin + turn * k / steps;
    result.push_back(
        {fillet.centre_rho + radius_mm * std::cos(angle), centre_y + radius_mm * std::sin(angle)});
  }
  result.push_back({fillet.centre_rho, top});
  return {std::move(result), fillet.centre_rho};
}

FilletedLip with_lip_fillet(const WallLines& lines, double radius_mm, double tolerance_mm) {
  if (auto lip = fitting_lip(lines, radius_mm, tolerance_mm)) return *std::move(lip);
  double fits_mm = 0.0;
  for (int k = 0; k < kHalvings; ++k) {
    const double half_mm = 0.5 * (fits_mm + radius_mm);
    (fitting_lip(lines, half_mm, tolerance_mm) ? fits_mm : radius_mm) = half_mm;
  }
  if (auto lip =
          fits_mm > 0.0 ? fitting_lip(lines, kRoomToMove * fits_mm, tolerance_mm) : std::nullopt)
    return *std::move(lip);
  return {lines, 0.0};
}

double largest_fillet_mm(const PieceWalls& piece, const Cuts& cuts) {
  std::size_t run = piece.size() - 1;
  while (cuts.outer[run] == 0 && cuts.bore[run] == 0) --run;
  return kHalf * (piece.level.back() - piece.level[run]);
}

std::string_view reason_of(FilletLimit limit) {
  switch (limit) {
    case FilletLimit::lip_width:
      return "the arcs of inside and outside would meet in a larger one";
    case FilletLimit::height_below:
      return "half the height between the lip and the step below it does not allow more";
    case FilletLimit::none:
      break;
  }
  return "";
}

}  // namespace clay::solid::inline smoothing
