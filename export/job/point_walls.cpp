#include "export/job/point_walls.hpp"

#include "export/walls/vertex_walls.hpp"

#include <cstddef>
#include <map>
#include <utility>

namespace clay::solid::inline job {

std::vector<float> walls_of_points(const RevolveLayout& rule, const Profile& profile) {
  // The polygons of a certified profile are simple and disjoint: no point occurs twice.
  std::map<std::pair<double, double>, float> wall_at;
  const std::vector<std::vector<double>> walls = vertex_walls(profile);
  for (std::size_t piece = 0; piece < walls.size(); ++piece)
    for (std::size_t i = 0; i < walls[piece].size(); ++i) {
      const ProfilePoint& point = profile.pieces[piece][i];
      wall_at[{point.rho, point.y}] = static_cast<float>(walls[piece][i]);
    }
  std::vector<float> points;
  points.reserve(rule.vertices());
  for (const Shell& shell : rule.shells())
    for (const bool pole : {false, true})
      for (std::size_t i = 0; i < shell.points.size(); ++i)
        if (shell.pole(i) == pole)
          points.insert(points.end(), pole ? 1 : rule.segments(),
                        wall_at.at({shell.points[i].rho, shell.points[i].y}));
  return points;
}

}  // namespace clay::solid::inline job
