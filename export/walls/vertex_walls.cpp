#include "export/walls/vertex_walls.hpp"

#include "claystack/export/walls.hpp"
#include "export/walls/wall_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace clay::solid::inline walls {
namespace {

constexpr double kNoWall = std::numeric_limits<double>::infinity();

/// By vertex of all pieces, in the order of the tree; `below` where there is no thinner wall.
std::vector<double> measured_walls(const EdgeTree& tree, double below) {
  std::vector<double> walls(tree.edge_count(), below);
  std::size_t node = 0;
  for (std::uint32_t piece = 0; piece < tree.piece_count(); ++piece) {
    const AxisClay axis(tree, piece);
    for (; node < tree.nodes().size(); ++node) {
      const EdgeNode& leaf = tree.nodes()[node];
      if (leaf.leaves > 1) continue;
      if (leaf.first_piece != piece) break;
      for (const Face& face : LeafFaces(tree, leaf)) {
        const std::uint32_t from = face.edge.index, to = tree.after(from, piece);
        walls[from] = PlaceSearch(tree, face, 0.0, walls[from]).run(axis).diameter;
        walls[to] = PlaceSearch(tree, face, 1.0, walls[to]).run(axis).diameter;
      }
    }
  }
  return walls;
}

/// Gives vertices without a wall that of the nearest vertex with one, along the closed polygon.
void fill_gaps(const Polygon& polygon, std::vector<double>& walls) {
  const std::size_t count = polygon.size();
  const std::vector<double> measured = walls;
  std::vector<double> nearest(count, kNoWall);  // distance along the polygon
  const auto sweep = [&](auto next) {
    double wall = kNoWall, away = 0.0;
    std::size_t at = 0;
    for (std::size_t step = 0; step < 2 * count; ++step) {
      const std::size_t before = at;
      at = next(at);
      away += std::hypot(polygon[at].rho - polygon[before].rho, polygon[at].y - polygon[before].y);
      if (std::isfinite(measured[at])) wall = measured[at], away = 0.0;
      if (!std::isfinite(wall) || away >= nearest[at]) continue;
      nearest[at] = away;
      walls[at] = wall;
    }
  };
  sweep([&](std::size_t at) { return (at + 1) % count; });
  sweep([&](std::size_t at) { return (at + count - 1) % count; });
}

}  // namespace

std::vector<std::vector<double>> vertex_walls(const Profile& profile) {
  const EdgeTree tree(profile, 1.0);
  const std::vector<double> measured = measured_walls(tree, kNoWall);
  std::vector<std::vector<double>> walls;
  auto next = measured.begin();
  for (const Polygon& polygon : profile.pieces) {
    const auto end = next + static_cast<std::ptrdiff_t>(polygon.size());
    std::vector<double>& piece = walls.emplace_back(next, end);
    next = end;
    fill_gaps(polygon, piece);
    if (!std::isfinite(piece.front()))
      std::ranges::fill(piece, min_wall(Profile{{polygon}}).thickness_mm);
  }
  return walls;
}

std::vector<double> thin_vertex_walls(const Polygon& polygon, double below_mm) {
  return measured_walls(EdgeTree({{polygon}}, 1.0), below_mm);
}

}  // namespace clay::solid::inline walls
