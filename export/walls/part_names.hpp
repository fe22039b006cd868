#pragma once
// The part of a section to which a wall belongs.

#include "claystack/export/walls.hpp"
#include "export/walls/edge_tree.hpp"

#include <cstdint>
#include <vector>

namespace clay::solid::inline walls {

/// Of one piece. Arcs are those of the tree, which is not scaled.
class PartNames {
 public:
  PartNames(const EdgeTree& tree, std::uint32_t piece);

  /// Of a disc that touches the boundary at two arcs.
  [[nodiscard]] WallPart of(double from_arc, double to_arc, double diameter_mm) const;
  /// Of a disc between two points of the boundary; across the axis, the second has a negative rho.
  [[nodiscard]] WallPart of(const Vec2& from, const Vec2& to) const;
  /// The distance of a point from the boundary.
  [[nodiscard]] double distance_to(const Vec2& point) const { return nearest(point).distance; }

 private:
  struct Place {
    double distance = 0.0, arc = 0.0;
  };
  [[nodiscard]] Place nearest(const Vec2& point) const;

  const EdgeTree& tree_;
  std::uint32_t piece_;
  double foot_arc_ = 0.0, rim_arc_ = 0.0;  ///< the outermost of the lowest and highest points
};

/// Of the disc of a minimum wall.
[[nodiscard]] WallPart part_of(const Profile& profile, const Wall& wall);

}  // namespace clay::solid::inline walls
