#pragma once
#include "claystack/export/walls.hpp"
#include "export/smoothing/smoothing_plan.hpp"
#include "export/smoothing/wall_guard.hpp"

#include <optional>
#include <vector>

namespace clay::solid::inline smoothing {

/// The wall guard compares the outer wall with the bore. A flange, a ledge or the edge of a lip is
/// clay between two places of the same wall: smoothing turns its steps into a wedge. This guard
/// finds those that become thinner than the limit and than every wall of the steps, by the
/// definition of `min_wall`.
class FlangeGuard {
 public:
  FlangeGuard(const PieceWalls& piece, double limit_mm) : piece_(piece), limit_mm_(limit_mm) {}

  /// The rings of such flanges, from the bottom up; empty if there are none. After some calls the
  /// rings around them too, twice as far each time, so that the rounds grow with the logarithm of
  /// the number of rings. `profile` is the outline of the lines, and `thinnest` its minimum wall.
  [[nodiscard]] std::vector<ThinRing> thin_rings(const WallLines& lines, const Profile& profile,
                                                 const Wall& thinnest);

  /// The rings of walls of every kind that are thinner than `required_mm`, without those around
  /// them.
  [[nodiscard]] std::vector<ThinRing> rings_below(double required_mm, const Profile& profile,
                                                  const Wall& thinnest) const;

 private:
  /// The limit or the minimum wall of the steps, the smaller one [mm].
  double required_mm();
  [[nodiscard]] std::size_t ring_at(double y) const;
  [[nodiscard]] std::vector<double> walls_below(double required_mm, const Profile& profile,
                                                const Wall& thinnest) const;

  const PieceWalls& piece_;
  double limit_mm_;
  std::optional<double> required_mm_;
  std::size_t reach_ = 0;  ///< rings around a thin one
  int rounds_ = 0;
};

}  // namespace clay::solid::inline smoothing
