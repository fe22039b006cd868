#include "claystack/export/walls.hpp"

#include "export/walls/largest_disc.hpp"
#include "export/walls/wall_search.hpp"

namespace clay::solid::inline walls {
namespace {

Wall wall_of_piece(const Profile& piece, double rho_scale, double arc_scale) {
  const EdgeTree tree(piece, rho_scale, arc_scale);
  WallSearch search(tree);
  search.across(AxisClay(tree, 0), 0);
  search_pairs(tree, search);
  const auto place = [&](const Vec2& p) { return ProfilePoint{p.x / rho_scale, p.y}; };
  const Ball& ball = search.least();
  if (std::isfinite(ball.diameter)) return {ball.diameter, place(ball.from), place(ball.to), false};
  const Disc disc = largest_disc(tree);
  return {2.0 * disc.radius, place(disc.touches), place(2.0 * disc.centre - disc.touches), true};
}

Wall least_wall(const Profile& profile, double rho_scale, double arc_scale) {
  Wall least;
  least.thickness_mm = std::numeric_limits<double>::infinity();
  const auto measure = [&](const Profile& piece) {
    const Wall wall = wall_of_piece(piece, rho_scale, arc_scale);
    if (wall.thickness_mm < least.thickness_mm) least = wall;
  };
  if (profile.pieces.size() == 1)
    measure(profile);
  else
    for (const Polygon& polygon : profile.pieces) measure({{polygon}});
  return least;
}

}  // namespace

Wall min_wall(const Profile& profile, double rho_scale) {
  return least_wall(profile, rho_scale, rho_scale);
}

double min_wall_mm(const Profile& profile) { return min_wall(profile).thickness_mm; }

WallBounds wall_bounds(const Profile& profile, double least_scale, double greatest_scale) {
  const Wall least = least_wall(profile, least_scale, greatest_scale);
  const Wall greatest = min_wall(profile, greatest_scale);
  const double upper = greatest.thickness_mm * (greatest.compact ? 1.0 + kDiscTolerance : 1.0);
  return {std::min(least.thickness_mm, upper), upper};
}

}  // namespace clay::solid::inline walls
