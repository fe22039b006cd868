#pragma once
// Gives the outer wall of a piece the clay that smoothing and fillet have added or removed.

#include "export/smoothing/smoothing_plan.hpp"
#include "export/smoothing/wall_guard.hpp"

#include <vector>

namespace clay::solid::inline smoothing {

/// Walls that hold the counted clay.
struct CorrectedWalls {
  WallLines lines;
  double lacking_over_pi = 0.0;  ///< volume added, negative if removed [mm^3]
  double moved_mm = 0.0;         ///< largest displacement of a wall
  double fillet_mm = 0.0;        ///< radius of the lip fillet as made
};

class VolumeCorrection {
 public:
  /// `limit_mm`: the minimum wall that the correction keeps. All are of the same piece; `plan` and
  /// `own_walls` may change between the calls.
  VolumeCorrection(const PieceWalls& piece, double tolerance_mm, double limit_mm,
                   const SmoothingPlan& plan, OwnWalls& own_walls)
      : piece_(piece),
        tolerance_mm_(tolerance_mm),
        limit_mm_(limit_mm),
        plan_(plan),
        own_walls_(own_walls) {}

  /// The largest displacement of a wall: that of the simplification, or an invisible fraction of a
  /// ring [mm].
  [[nodiscard]] double allowed_move_mm() const;

  struct Found {
    CorrectedWalls walls;
    RingFlags rings;        ///< those that moved
    double taken_mm = 0.0;  ///< see SmoothedProfile
  };
  /// Moves all rings alike; where clay must be removed and that thins a wall, only rings that are
  /// thick enough, if there are any. The displacement may exceed the allowed one.
  [[nodiscard]] Found find(const WallLines& lines);

  /// Moves the flagged rings, and rounds the lip if the radius is above 0.
  [[nodiscard]] CorrectedWalls corrected(const WallLines& lines, const RingFlags& rings,
                                         double fillet_mm) const;

 private:
  [[nodiscard]] std::vector<double> weights_of(const Polygon& line, const RingFlags& rings) const;
  [[nodiscard]] RingFlags thick_rings(const WallLines& lines);
  [[nodiscard]] CorrectedWalls careful_correction(const WallLines& lines, RingFlags& rings);
  [[nodiscard]] std::vector<double> walls_of(const WallLines& lines, double cap_mm) const;
  [[nodiscard]] RingFlags all_rings() const { return RingFlags(piece_.size(), 1); }

  const PieceWalls& piece_;
  double tolerance_mm_, limit_mm_;
  const SmoothingPlan& plan_;
  OwnWalls& own_walls_;
};

}  // namespace clay::solid::inline smoothing
