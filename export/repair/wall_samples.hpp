#pragma once
#include "claystack/export/solid.hpp"

namespace clay::solid::inline repair {

/// The thickness of a wall at places of the surface inside it.
struct WallSamples {
  double low_mm = 0.0;     ///< 3 % of the places have less
  double median_mm = 0.0;  ///< half of the places have less
};

/// At 4,000 places spread evenly over the area of `surface`: the length of the line along the
/// normal through the place, between the two faces of `wall`, a closed mesh around the surface.
/// Beside a border, and beside sharp edges, a wrap is thinner, which is a matter of its shape and
/// not of its distance. Therefore the minimum is no measure of the distance. Zeros if no line
/// reaches both faces.
[[nodiscard]] WallSamples sample_wall(const TriangleMesh& surface, const TriangleMesh& wall);

}  // namespace clay::solid::inline repair
