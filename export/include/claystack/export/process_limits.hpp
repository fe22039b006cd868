#pragma once
// What a way of making things asks of walls. Every figure says where it comes from.

#include "claystack/engine/result.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid {

/// Holds for objects whose width, depth and height add up to no more than this.
struct WallLimit {
  double up_to_size_sum_mm = 0.0;
  double min_wall_mm = 0.0;
  std::string source;
};

struct ProcessLimits {
  std::string name;
  std::vector<WallLimit> walls;  ///< by rising size; the last holds for all larger objects too

  [[nodiscard]] const WallLimit& wall_for(double size_sum_mm) const noexcept;
};

inline constexpr std::array<std::string_view, 5> kProcessNames{"fdm", "sla", "earthenware",
                                                               "stoneware", "porcelain"};

/// One of kProcessNames; any other name is an error that lists them.
Result<ProcessLimits> process_named(std::string_view name);

/// JSON as in samples/schema/process.schema.json; errors name the file and the field.
Result<ProcessLimits> parse_process(std::string_view bytes, std::string_view file_name);

}  // namespace clay::solid
