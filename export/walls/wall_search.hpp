#pragma once
// Searches for the smallest ball: over all pairs of faces, or at one place.

#include "export/walls/tangent_ball.hpp"

#include <limits>

namespace clay::solid::inline walls {

/// Searches all pairs of faces of the same piece.
class WallSearch {
 public:
  explicit WallSearch(const EdgeTree& tree) : tree_(tree) {}

  [[nodiscard]] double bound(const EdgeNode& a, const EdgeNode& b) const;
  [[nodiscard]] double best() const { return least_.diameter; }
  void leaves(const EdgeNode& a, const EdgeNode& b);

  /// Also searches across the axis.
  void across(const AxisClay& axis, std::uint32_t piece, std::size_t node = 0);
  [[nodiscard]] const Ball& least() const { return least_; }

 private:
  void compare(const Face& a, const Face& b);

  const EdgeTree& tree_;
  Ball least_;
};

/// Searches the balls that touch a face at a place from 0 (its begin) to 1 (its end). `excluded` of
/// the result is the diameter of a smaller ball with too little boundary, or a lower bound of it.
class PlaceSearch {
 public:
  /// Finds only walls thinner than `below` [mm].
  PlaceSearch(const EdgeTree& tree, const Face& face, double place,
              double below = std::numeric_limits<double>::infinity())
      : tree_(tree),
        face_(face),
        place_(place),
        at_(face.edge.from + place * (face.edge.to - face.edge.from)),
        below_(below) {}

  [[nodiscard]] Ball run(const AxisClay& axis);

  [[nodiscard]] double bound(const EdgeNode& place, const EdgeNode& node);
  [[nodiscard]] double best() const { return least_.diameter; }
  void leaves(const EdgeNode& place, const EdgeNode& leaf);

 private:
  const EdgeTree& tree_;
  const Face& face_;
  double place_;
  Vec2 at_;
  double below_;
  Ball least_;
};

}  // namespace clay::solid::inline walls
