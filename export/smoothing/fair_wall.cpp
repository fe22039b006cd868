#include "export/smoothing/fair_wall.hpp"

#include "core/cancel.hpp"
#include "core/compensated_sum.hpp"
#include "export/section/simplify_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

double swept_over_pi(const Polygon& line) noexcept {
  CompensatedSum sum;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double a = line[i].rho, b = line[i + 1].rho;
    sum.add((line[i + 1].y - line[i].y) * (a * a + a * b + b * b));
  }
  return sum.value() / 3.0;
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
