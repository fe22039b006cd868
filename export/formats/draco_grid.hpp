#pragma once
// The grid that Draco moves coordinates to: how coarse it may be for a promised error.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"

#include <glm/vec3.hpp>
#include <vector>

namespace clay::solid::inline formats {

/// 2^bits points along each side of a cube: the corner of least coordinates, and the side.
struct DracoGrid {
  glm::vec3 origin{0.0F};
  float side_mm = 1.0F;
  int bits = 1;
};

/// As coarse as the promise allows, for then the least is left to code: the fewest bits first
/// (from `settings.min_bits`), then the largest cube. With `min_bits` themselves the cube is no
/// larger than the points need. Errors (`bad_input`) name the least error that can be promised.
[[nodiscard]] Result<DracoGrid> choose_grid(const std::vector<glm::vec3>& points,
                                            const DracoSettings& settings);

}  // namespace clay::solid::inline formats
