#pragma once
#include "export/section/line_tree.hpp"
#include "export/smoothing/piece_walls.hpp"

#include <optional>
#include <vector>

namespace clay::solid::inline smoothing {

/// A wall counts as thinner than another below this ratio; covers rounding.
inline constexpr double kWallRounding = 1.0 - 1e-9;

/// Both walls of a piece from the bottom up; the bore runs along the axis where there is none.
struct WallLines {
  Polygon outer, bore;
};

/// As one polygon, counterclockwise.
[[nodiscard]] Polygon outline_of(const WallLines& lines);

/// The reverse: the outer wall rises from the outermost of the lowest points to the outermost of
/// the highest.
[[nodiscard]] WallLines lines_of(const Polygon& outline);

/// With the clay on the other side: a bore as if it were an outer wall.
[[nodiscard]] Polygon mirrored(Polygon line);

/// The unsmoothed steps of a piece.
[[nodiscard]] WallLines stepped_lines(const PieceWalls& piece);

/// Minimum thickness [mm] of the steps: from the bore to the outside, including floors and lids;
/// across (2R) where there is no bore; and vertically through floors, lids and solids.
[[nodiscard]] double least_own_wall_mm(const PieceWalls& piece);

/// A flag for each ring.
using RingFlags = std::vector<char>;

/// Measures the walls between two lines. The piece outlives it.
class WallGauge {
 public:
  WallGauge(const PieceWalls& piece, const WallLines& lines)
      : piece_(piece), lines_(lines), outer_(lines.outer), bore_(lines.bore) {}

  /// True if the walls are thinner than `limit_mm` anywhere, apart from rounding. Vertical
  /// thickness is not checked, because smoothing keeps the levels.
  [[nodiscard]] bool thinner_than(double limit_mm) const;

  /// Flags the rings beside which an edge is thinner than the limit.
  [[nodiscard]] RingFlags rings_near_thin(double limit_mm) const;

  /// For each flagged ring the minimum distance [mm] from the points of either wall at its heights,
  /// both ends included, to the other wall at any height; twice the radius where clay reaches the
  /// axis. Larger values, and those of unflagged rings, are set to `cap_mm`. Exact: the walls are
  /// clipped ring by ring.
  [[nodiscard]] std::vector<double> by_ring_mm(double cap_mm, const RingFlags& rings) const;

 private:
  const PieceWalls& piece_;
  WallLines lines_;
  LineTree outer_, bore_;
};

/// The walls of the steps by ring, each measured once, when it is needed. The piece outlives it.
class OwnWalls {
 public:
  OwnWalls(const PieceWalls& piece, double cap_mm) : piece_(piece), cap_mm_(cap_mm) {}

  /// As `WallGauge::by_ring_mm` of the steps for the flagged rings. Others are any value.
  const std::vector<double>& by_ring_mm(const RingFlags& rings);

 private:
  const PieceWalls& piece_;
  double cap_mm_;
  std::optional<WallGauge> gauge_;
  RingFlags measured_;
  std::vector<double> walls_mm_;
};

}  // namespace clay::solid::inline smoothing
