#pragma once
#include "export/smoothing/piece_walls.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline smoothing {

/// Rings of one wall of a piece, from `first` up to but not including `end`.
struct RunOfRings {
  const PieceWalls& piece;
  const WallRings& wall;
  std::size_t first = 0, end = 0;

  [[nodiscard]] std::size_t size() const noexcept { return end - first; }
  [[nodiscard]] double bottom_mm() const { return piece.level[first]; }
  [[nodiscard]] double top_mm() const { return piece.level[end]; }
  [[nodiscard]] double middle_mm(std::size_t ring) const {
    return piece.level[ring] + 0.5 * piece.ring_height_mm;
  }
};

/// Fewer rings have no curvature that changes.
inline constexpr std::size_t kLeastFairedRings = 4;
/// Steps cannot show a ripple that is shorter [rings].
inline constexpr double kLeastFairedLength = 2.0;

/// The wall of a run with continuous curvature. u is the cubic spline of the height, on uniform
/// knots, that minimises
///
///   sum over the rings of h (u - R)^2, at their middles
///   + integral of (l / 2 pi)^6 (d^3 u / dy^3)^2 dy.
///
/// A ripple of wavelength l keeps 1/2 of its height, of 2 l 98 %, of l / 2 less than 2 %. Quadratic
/// functions of the height do not change: cylinders, cones, paraboloids. The length l is that of
/// the ring, but at most the distance to the nearer end of the run, so that foot, lip and corners
/// stay, and at least two rings. The matrix has seven diagonals: linear time.
class FairedCurve {
 public:
  /// At least kLeastFairedRings; `lengths_mm`: above 0, for each ring of the piece.
  FairedCurve(const RunOfRings& run, const std::vector<double>& lengths_mm);

  /// The radius at a height of the run [mm].
  [[nodiscard]] double at(double y) const;

  /// Points on the curve from the bottom of the run to its top, whose chords are within
  /// `sagitta_mm` of it. A curve that would need more than kMostPoints gets about kMostPoints and
  /// one for each knot, with longer chords.
  [[nodiscard]] Polygon points(double sagitta_mm) const;

 private:
  static constexpr double kMostPoints = 1 << 22;
  struct Place {
    std::size_t interval = 0;
    double t = 0.0;  ///< 0 to 1 within it
  };

  [[nodiscard]] Place place_of(double y) const;
  [[nodiscard]] double radius(Place place) const;
  [[nodiscard]] std::vector<double> stiffness(const std::vector<double>& lengths_mm) const;
  void fit(const std::vector<double>& stiffness);
  [[nodiscard]] std::vector<std::size_t> chords_of_intervals(double sagitta_mm) const;

  RunOfRings run_;
  std::size_t intervals_ = 1;
  double spacing_mm_ = 0.0;     ///< of the knots
  double base_mm_ = 0.0;        ///< radius that the coefficients are relative to
  std::vector<double> coeffs_;  ///< of the B-splines [mm]
};

}  // namespace clay::solid::inline smoothing
