#include "export/walls/clearance.hpp"

#include "export/walls/edge_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace clay::solid::inline walls {
namespace {

struct Corner {
  Vec2 from{0.0}, along{0.0};
  double square = 0.0;  ///< of the length
  std::uint32_t index = 0, next = 0;
};

double squared_distance(const Vec2& p, const Corner& edge) {
  const Vec2 way = p - edge.from;
  const double t = std::clamp(glm::dot(way, edge.along) / edge.square, 0.0, 1.0);
  const Vec2 left = way - t * edge.along;
  return glm::dot(left, left);
}

class ClearanceSearch {
 public:
  explicit ClearanceSearch(const EdgeTree& tree) : tree_(tree) {
    // The distance from a vertex to the edge after its own is at most the length of its own edge.
    for (std::uint32_t piece = 0; piece < tree.piece_count(); ++piece) start_with(piece);
    least_ = std::sqrt(least_square_);
  }

  [[nodiscard]] double bound(const EdgeNode& a, const EdgeNode& b) const {
    return &a == &b ? 0.0 : least_distance(a, b);
  }
  [[nodiscard]] double best() const { return least_; }

  void leaves(const EdgeNode& a, const EdgeNode& b) {
    const std::size_t first = load(a, first_), second = load(b, second_);
    for (std::size_t i = 0; i < first; ++i)
      for (std::size_t j = 0; j < second; ++j) {
        offer(first_[i], second_[j]);
        if (&a != &b) offer(second_[j], first_[i]);
      }
  }

  [[nodiscard]] const Vec2& at() const { return at_; }

 private:
  using Corners = std::array<Corner, EdgeTree::kLeafEdges>;

  void start_with(std::uint32_t piece) {
    for (std::uint32_t i = tree_.first_edge(piece);;) {
      const std::uint32_t next = tree_.after(i, piece);
      const Vec2 way = tree_.point(next) - tree_.point(i);
      keep(glm::dot(way, way), i);
      if (next <= i) return;
      i = next;
    }
  }

  std::size_t load(const EdgeNode& leaf, Corners& corners) const {
    for (std::uint32_t i = leaf.first; i < leaf.end; ++i) {
      const std::uint32_t next = tree_.after(i, leaf.first_piece);
      const Vec2 along = tree_.point(next) - tree_.point(i);
      corners[i - leaf.first] = {tree_.point(i), along, glm::dot(along, along), i, next};
    }
    return leaf.end - leaf.first;
  }

  void offer(const Corner& vertex, const Corner& edge) {
    if (vertex.index == edge.index || vertex.index == edge.next) return;
    keep(squared_distance(vertex.from, edge), vertex.index);
  }

  void keep(double square, std::uint32_t vertex) {
    if (square >= least_square_) return;
    least_square_ = square;
    least_ = std::sqrt(square);
    at_ = tree_.point(vertex);
  }

  const EdgeTree& tree_;
  double least_square_ = std::numeric_limits<double>::infinity();
  double least_ = std::numeric_limits<double>::infinity();
  Vec2 at_{0.0};
  Corners first_{}, second_{};
};

}  // namespace

Clearance clearance(const Profile& profile, double rho_scale) {
  const EdgeTree tree(profile, rho_scale);
  ClearanceSearch search(tree);
  search_pairs(tree, search);
  Clearance result;
  result.least_radius_mm = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::uint32_t i = 0; i < tree.edge_count(); ++i) {
    const Vec2& p = tree.point(i);
    largest = std::max({largest, p.x, std::abs(p.y)});
    if (p.x > 0.0) result.least_radius_mm = std::min(result.least_radius_mm, p.x);
  }
  const double rounding = std::ldexp(largest, -46);
  result.distance_mm = std::max(0.0, search.best() * (1.0 - std::ldexp(1.0, -46)) - rounding);
  result.at = {search.at().x / rho_scale, search.at().y};
  return result;
}

double clearance_mm(const Profile& profile, double rho_scale) {
  return clearance(profile, rho_scale).distance_mm;
}

}  // namespace clay::solid::inline walls
