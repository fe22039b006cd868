#include "export/job/point_walls.hpp"

#include "core/colour_scale.hpp"
#include "export/walls/vertex_walls.hpp"

#include <cstddef>
#include <map>
#include <utility>

namespace clay::solid::inline job {

PointWalls walls_of_points(const RevolveLayout& rule, const Profile& profile) {
  // The polygons of a certified profile are simple and disjoint: no point occurs twice.
  std::map<std::pair<double, double>, float> wall_at;
  std::vector<float> section;
  const std::vector<std::vector<double>> walls = vertex_walls(profile);
  for (std::size_t piece = 0; piece < walls.size(); ++piece)
    for (std::size_t i = 0; i < walls[piece].size(); ++i) {
      const ProfilePoint& point = profile.pieces[piece][i];
      section.push_back(static_cast<float>(walls[piece][i]));
      wall_at[{point.rho, point.y}] = section.back();
    }
  PointWalls result{{}, scale_top_mm(std::move(section))};
  std::vector<float>& points = result.mm;
  points.reserve(rule.vertices());
  for (const Shell& shell : rule.shells())
    for (const bool pole : {false, true})
      for (std::size_t i = 0; i < shell.points.size(); ++i)
        if (shell.pole(i) == pole)
          points.insert(points.end(), pole ? 1 : rule.segments(),
                        wall_at.at({shell.points[i].rho, shell.points[i].y}));
  return result;
}

}  // namespace clay::solid::inline job
