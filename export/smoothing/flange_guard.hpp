#pragma once
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

  /// The rings of such flanges, from the bottom up; empty if there are none.
  [[nodiscard]] std::vector<ThinRing> thin_rings(const WallLines& lines);

 private:
  /// The limit, or the minimum wall of the steps, whichever is less.
  double required_mm();
  [[nodiscard]] std::size_t ring_at(double y) const;

  const PieceWalls& piece_;
  double limit_mm_;
  std::optional<double> required_mm_;
};

}  // namespace clay::solid::inline smoothing
