#pragma once
#include "export/smoothing/piece_walls.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline smoothing {

/// A wall counts as thinner than another below this ratio: what rounding may do.
inline constexpr double kWallRounding = 1.0 - 1e-9;

/// Both walls of a piece from the bottom up; the bore runs along the axis where there is none.
struct WallLines {
  Polygon outer, bore;
};

/// The steps of a piece as they are.
[[nodiscard]] WallLines stepped_lines(const PieceWalls& piece);

/// Least thickness [mm] of the steps: from the bore to the outside, floors and lids included,
/// across (2R) where there is no bore, and from level to level through floors, lids and solids.
[[nodiscard]] double least_own_wall_mm(const PieceWalls& piece);

/// Whether some place of these walls is thinner than `limit_mm`, rounding aside. Thickness from
/// level to level is not looked at: smoothing leaves the levels as they are.
[[nodiscard]] bool thinner_than(const PieceWalls& piece, const WallLines& lines, double limit_mm);

/// A flag for each ring, set where an edge that is thinner than that runs past it.
using RingFlags = std::vector<char>;
[[nodiscard]] RingFlags rings_near_thin(const PieceWalls& piece, const WallLines& lines,
                                        double limit_mm);

/// For each flagged ring the least distance [mm] from the points of either wall at its heights,
/// both ends included, to the other wall at any height; twice the radius where clay reaches the
/// axis. Distances beyond `cap_mm`, and those of other rings, count as that. Exact: the walls are
/// clipped ring by ring.
[[nodiscard]] std::vector<double> walls_by_ring_mm(const PieceWalls& piece, const WallLines& lines,
                                                   double cap_mm, const RingFlags& rings);

}  // namespace clay::solid::inline smoothing
