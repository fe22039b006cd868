#pragma once
// The largest disc in a piece of clay: the thickness of a piece without a wall.

#include "export/walls/edge_tree.hpp"

namespace clay::solid::inline walls {

/// Maximum relative difference of the disc found from the largest one.
inline constexpr double kDiscTolerance = 1e-3;

struct Disc {
  Vec2 centre{0.0};
  Vec2 touches{0.0};  ///< the boundary's point nearest to the centre
  double radius = 0.0;
};

/// In the clay of the tree's pieces, mirrored at the axis. Subdivides squares, the most promising
/// first, until none can contain a disc that is larger by more than `kDiscTolerance`.
[[nodiscard]] Disc largest_disc(const EdgeTree& tree);

}  // namespace clay::solid::inline walls
