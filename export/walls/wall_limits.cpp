#include "claystack/export/walls.hpp"

#include "claystack/core/atomic_file.hpp"
#include "core/json/json_fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clay::solid::inline walls {
namespace {

constexpr double kAnySize = std::numeric_limits<double>::infinity();
constexpr std::size_t kMaxProcessBytes = std::size_t{1} << 20;
constexpr int kDeepest = 3;  // the depth of a field of a wall
constexpr const char* kSchema = "claystack-process-1";
constexpr Range kWallMm = above(0.0).to(1e4), kSizeSumMm = above(0.0).to(1e7);

std::vector<ProcessLimits> with_names(std::vector<ProcessLimits> processes) {
  for (ProcessLimits& process : processes)
    for (WallLimit& wall : process.walls) wall.process = process.name;
  return processes;
}

const std::vector<ProcessLimits>& built_in() {
  static const std::vector<ProcessLimits> processes = with_names({
      {"fdm",
       {{kAnySize,
         0.8,
         "design guides of Hycubeworks, Layer-One and Neway: 0.8 mm at least, 1.2 mm usual",
         {}}}},
      {"sla",
       {{200.0, 1.0, "i.materialise, resin: up to 200 mm of width + depth + height", {}},
        {400.0, 2.0, "i.materialise, resin: 200 to 400 mm of width + depth + height", {}},
        {kAnySize, 3.0, "i.materialise, resin: above 400 mm of width + depth + height", {}}}},
      {"earthenware",
       {{kAnySize, 5.0, "CCL_Clay3DP, ClayPresets.cs: one bead, laboratory preset", {}}}},
      {"stoneware",
       {{kAnySize, 3.0, "CCL_Clay3DP, ClayPresets.cs: one bead, laboratory preset", {}}}},
      {"porcelain",
       {{kAnySize, 2.0, "CCL_Clay3DP, ClayPresets.cs: one bead, laboratory preset", {}}}},
  });
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
  return with_names({std::move(process)}).front();
}

}  // namespace

std::string WallLimit::asked_by() const {
  return process.empty() ? source : process + ": " + source;
}

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

Result<ProcessLimits> read_process(const std::string& name) {
  if (!name.ends_with(".json")) return process_named(name);
  return read_file(name, kMaxProcessBytes).and_then([&](const std::string& bytes) {
    return parse_process(bytes, name);
  });
}

std::optional<WallLimit> WallDemand::for_size(double size_sum_mm) const {
  std::optional<WallLimit> limit;
  if (min_wall_mm) limit = WallLimit{kAnySize, *min_wall_mm, "--min-wall", {}};
  if (!process) return limit;
  const WallLimit& asked = process->wall_for(size_sum_mm);
  return limit && limit->min_wall_mm >= asked.min_wall_mm ? limit : asked;
}

}  // namespace clay::solid::inline walls
