#include "claystack/export/walls.hpp"

#include "core/json/json_fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clay::solid::inline walls {
namespace {

constexpr double kAnySize = std::numeric_limits<double>::infinity();
constexpr int kDeepest = 3;  // a field of a wall of the list
constexpr const char* kSchema = "claystack-process-1";
constexpr Interval kWallMm{0.0, 1e4, true}, kSizeSumMm{0.0, 1e7, true};

const std::vector<ProcessLimits>& built_in() {
  static const std::vector<ProcessLimits> processes{
      {"fdm",
       {{kAnySize, 0.8,
         "design guides of Hycubeworks, Layer-One and Neway: 0.8 mm at least, 1.2 mm usual"}}},
      {"sla",
       {{200.0, 1.0, "i.materialise, resin: up to 200 mm of width + depth + height"},
        {400.0, 2.0, "i.materialise, resin: 200 to 400 mm of width + depth + height"},
        {kAnySize, 3.0, "i.materialise, resin: above 400 mm of width + depth + height"}}},
      {"earthenware",
       {{kAnySize, 5.0, "CCL_Clay3DP, ClayPresets.cs: one bead, laboratory preset"}}},
      {"stoneware", {{kAnySize, 3.0, "CCL_Clay3DP, ClayPresets.cs: one bead, laboratory preset"}}},
      {"porcelain", {{kAnySize, 2.0, "CCL_Clay3DP, ClayPresets.cs: one bead, laboratory preset"}}},
  };
  return processes;
}

WallLimit wall_from(const Json& json) {
  expect_only(json, {"up_to_size_sum_mm", "min_wall_mm", "source"});
  WallLimit limit;
  limit.up_to_size_sum_mm = json.contains("up_to_size_sum_mm")
                                ? number_in(json, "up_to_size_sum_mm", kSizeSumMm)
                                : kAnySize;
  limit.min_wall_mm = number_in(json, "min_wall_mm", kWallMm);
  limit.source = text_in(json, "source");
  return limit;
}

ProcessLimits process_from(const Json& json) {
  expect_schema(json, kSchema);
  expect_only(json, {"schema", "name", "walls"});
  ProcessLimits process{text_in(json, "name"), {}};
  for (const Json& wall : array_in(json, "walls")) process.walls.push_back(wall_from(wall));
  if (process.walls.empty()) throw BadField("walls: expected at least one, found none");
  for (std::size_t i = 1; i < process.walls.size(); ++i)
    if (!(process.walls[i - 1].up_to_size_sum_mm < process.walls[i].up_to_size_sum_mm))
      throw BadField("walls: expected sizes that rise");
  return process;
}

}  // namespace

const WallLimit& ProcessLimits::wall_for(double size_sum_mm) const noexcept {
  const auto limit = std::find_if(walls.begin(), walls.end(), [&](const WallLimit& wall) {
    return size_sum_mm <= wall.up_to_size_sum_mm;
  });
  return limit == walls.end() ? walls.back() : *limit;
}

Result<ProcessLimits> process_named(std::string_view name) {
  for (const ProcessLimits& process : built_in())
    if (process.name == name) return process;
  std::string names;
  for (const std::string_view known : kProcessNames)
    names.append(names.empty() ? "" : ", ").append(known);
  return failure(ErrorKind::bad_input,
                 "process: expected one of " + names + " or a file, found " + std::string(name));
}

Result<ProcessLimits> parse_process(std::string_view bytes, std::string_view file_name) {
  return parsed_with(bytes, file_name, JsonLimits(kDeepest, kSchema), process_from);
}

}  // namespace clay::solid::inline walls
