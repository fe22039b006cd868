#include "export/smoothing/fair_wall.hpp"

#include "core/cancel.hpp"
#include "export/section/simplify_line.hpp"

namespace clay::solid::inline smoothing {

Polygon fair_wall(const PieceWalls& piece, const WallRings& wall, const CutFlags& cut,
                  const std::vector<double>& tolerances_mm) {
  Polygon line;
  for_each_run(cut, [&](std::size_t first, std::size_t end) {
    Polygon run{{wall.radius[first], piece.level[first]}};
    std::vector<double> tolerances{0.0};
    for (std::size_t i = first; i < end; ++i) {
      run.push_back({wall.radius[i], piece.level[i] + 0.5 * piece.ring_height_mm});
      tolerances.push_back(tolerances_mm[i]);
    }
    run.push_back({wall.radius[end - 1], piece.level[end]});
    tolerances.push_back(0.0);
    const Polygon spared = simplified(run, tolerances);
    line.insert(line.end(), spared.begin(), spared.end());
  });
  return without_straight_points(line);
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

}  // namespace clay::solid::inline smoothing
