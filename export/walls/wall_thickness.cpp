#include "claystack/export/walls.hpp"

#include "export/walls/wall_search.hpp"

namespace clay::solid::inline walls {

Wall min_wall(const Profile& profile, double rho_scale) {
  const EdgeTree tree(profile, rho_scale);
  WallSearch search(tree);
  for (std::uint32_t piece = 0; piece < tree.piece_count(); ++piece)
    search.across(AxisClay(tree, piece), piece);
  search_pairs(tree, search);
  const Ball& ball = search.least();
  return {
      ball.diameter, {ball.from.x / rho_scale, ball.from.y}, {ball.to.x / rho_scale, ball.to.y}};
}

double min_wall_mm(const Profile& profile) { return min_wall(profile).thickness_mm; }

}  // namespace clay::solid::inline walls
