#pragma once
// The grid to which Draco rounds coordinates: the coarsest for a given error.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"

#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

/// 2^bits points along each side of a cube: the corner of smallest coordinates, and the side.
struct DracoGrid {
  glm::vec3 origin{0.0F};
  float side_mm = 1.0F;
  int bits = 1;
};

/// The file of a grid, for messages.
struct GridFile {
  std::string_view ending = ".drc";
  double unit_mm = 1.0;   ///< of the points and of the error in the settings
  double other_mm = 0.0;  ///< displacement of the file's vertices by other causes
};

/// Chooses the coarsest grid within the error, which takes the least bytes: the smallest number of
/// bits first (from `settings.min_bits`), then the largest cube. With `min_bits` the cube is no
/// larger than the points need. Errors (`bad_input`) name the smallest possible error [mm].
[[nodiscard]] Result<DracoGrid> choose_grid(const std::vector<glm::vec3>& points,
                                            const DracoSettings& settings,
                                            const GridFile& file = {});

}  // namespace clay::solid::inline formats
