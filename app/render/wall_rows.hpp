#pragma once
// Wall thickness for the map on the pot, measured exactly as in the export.

#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/walls.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace clay::render {

/// The walls of a pot, as a picture shows them.
struct MappedWalls {
  std::vector<RowWall> rows;
  /// The wall that `claystack export` reports; of a collapsed pot that of its round parts, which
  /// facets, seam and files make thinner.
  double min_wall_mm = 0.0;
  std::optional<solid::WallLimit> limit;  ///< for a pot of this size
};

/// The walls in `rows` equal parts of the height of `pot`, by the export's job without a file. For
/// a collapsed pot, those of the section of both parts before the collapse. Errors as for
/// solid::run_export and solid::collapsed_parts.
Result<MappedWalls> map_walls(const Pot& pot, const solid::WallDemand& demand, std::size_t rows);

/// The top of the map in files, the same for every pot [mm].
inline constexpr double kFileMapTopMm = 10.0;
/// Measures the walls and colours the picture of the pot by them.
Result<MappedWalls> show_walls(const Pot& pot, const solid::WallDemand& demand, Picture& picture);

/// For each of `rows` equal parts of `height_mm`, the minimum thickness of the field on the outside
/// and on the bore.
[[nodiscard]] std::vector<RowWall> row_walls(std::span<const solid::WallSample> field,
                                             std::size_t rows, double height_mm);

}  // namespace clay::render
