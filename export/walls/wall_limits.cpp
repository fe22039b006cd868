#include "claystack/export/walls.hpp"

#include "claystack/core/atomic_file.hpp"
#include "core/json/object_reader.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace clay::solid::inline walls {
namespace {

constexpr std::array<std::string_view, 2> kNoYes = {"no", "yes"};
constexpr double kAnySize = std::numeric_limits<double>::infinity();
constexpr std::size_t kMaxProcessBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxValues = 10'000;  // of a process file: fields of some thousand walls
constexpr Range kWallMm = above(0.0).to(1e4), kSizeSumMm = above(0.0).to(1e7);
constexpr Range kOverhangDeg = from(0.0).to(90.0), kSizeMm = above(0.0).to(1e5);

std::vector<ProcessLimits> with_names(std::vector<ProcessLimits> processes) {
  for (ProcessLimits& process : processes)
    for (WallLimit& wall : process.walls) wall.process = process.name;
  return processes;
}

/// A clay that a printer lays in beads of the wall's width.
ProcessLimits clay(const char* name, double bead_mm, double overhang_deg) {
  return {
      name, {{kAnySize, bead_mm, "CCL_Clay3DP, ClayPresets.cs: one bead, laboratory preset", {}}},
      true, OverhangLimit{overhang_deg, "CCL_Clay3DP, ClayPresets.cs: laboratory preset"},
      {},   EdgeLimit{2.0, "i.materialise, ceramics: edges rounded by at least 2 mm"}};
}

const std::vector<ProcessLimits>& built_in() {
  static const std::vector<ProcessLimits> processes = with_names({
      {"fdm",
       {{kAnySize,
         0.8,
         "design guides of Hycubeworks, Layer-One and Neway: 0.8 mm at least, 1.2 mm usual",
         {}}},
       false,
       OverhangLimit{45.0, "design guides of Hycubeworks, Layer-One and Neway"},
       {},
       {}},
      {"sla",
       {{200.0, 1.0, "i.materialise, resin: up to 200 mm of width + depth + height", {}},
        {400.0, 2.0, "i.materialise, resin: 200 to 400 mm of width + depth + height", {}},
        {kAnySize, 3.0, "i.materialise, resin: above 400 mm of width + depth + height", {}}},
       false,
       {},
       {},
       {}},
      clay("earthenware", 5.0, 25.0),
      clay("stoneware", 3.0, 20.0),
      clay("porcelain", 2.0, 15.0),
  });
  return processes;
}

}  // namespace

static void describe(auto& io, Is<WallLimit> auto& wall) {
  io.require({"min_wall_mm", "source"});
  io.number("up_to_size_sum_mm", wall.up_to_size_sum_mm, kSizeSumMm);
  io.number("min_wall_mm", wall.min_wall_mm, kWallMm);
  io.text("source", wall.source);
}

static void describe(auto& io, Is<OverhangLimit> auto& overhang) {
  io.require({"max_deg", "source"});
  io.number("max_deg", overhang.max_deg, kOverhangDeg);
  io.text("source", overhang.source);
}

static void describe(auto& io, Is<EdgeLimit> auto& edges) {
  io.require({"min_radius_mm", "source"});
  io.number("min_radius_mm", edges.min_radius_mm, kWallMm);
  io.text("source", edges.source);
}

static void describe(auto& io, Is<SizeLimit> auto& size) {
  io.require({"width_mm", "depth_mm", "height_mm", "source"});
  io.number("width_mm", size.width_mm, kSizeMm);
  io.number("depth_mm", size.depth_mm, kSizeMm);
  io.number("height_mm", size.height_mm, kSizeMm);
  io.text("source", size.source);
}

static void describe(auto& io, Is<ProcessLimits> auto& process) {
  io.require({"schema", "name", "walls"});
  io.constant("schema", "claystack-process-1");
  io.text("name", process.name);
  io.parts("walls", process.walls);
  io.choice("fired", process.fired, kNoYes);
  io.part("overhang", process.overhang);
  io.part("size", process.size);
  io.part("edges", process.edges);
  io.check([&](auto& reader) {
    reader.expect(!process.walls.empty(), "walls", "at least one wall");
    for (std::size_t i = 1; i < process.walls.size(); ++i)
      reader.expect_element(
          process.walls[i - 1].up_to_size_sum_mm < process.walls[i].up_to_size_sum_mm, "walls", i,
          "a size that is larger than the one before");
  });
}

std::string process_title(std::string_view name) {
  if (name == "fdm") return "FDM (filament)";
  if (name == "sla") return "SLA (resin)";
  const bool known = std::ranges::find(kProcessNames, name) != kProcessNames.end();
  return known ? sentence(std::string(name)) : std::string(name);
}

std::string WallLimit::asked_by() const {
  return process.empty() ? source : process_title(process) + ": " + source;
}

const WallLimit& ProcessLimits::wall_for(double size_sum_mm) const noexcept {
  const auto limit = std::find_if(walls.begin(), walls.end(), [&](const WallLimit& wall) {
    return size_sum_mm <= wall.up_to_size_sum_mm + 3.0 * kSizeAllowanceMm;
  });
  return limit == walls.end() ? walls.back() : *limit;
}

Result<void> ProcessLimits::check() const {
  const auto wrong = [](const std::string& what) {
    return failure(ErrorKind::bad_input, "process: expected " + what);
  };
  struct Number {
    const char* what;
    double value;
    Range range;
  };
  std::vector<Number> numbers;
  double smaller = 0.0;
  for (const WallLimit& wall : walls) {
    if (!(wall.up_to_size_sum_mm > smaller)) return wrong("walls by increasing size");
    smaller = wall.up_to_size_sum_mm;
    numbers.push_back({"walls", wall.min_wall_mm, kWallMm});
  }
  if (walls.empty()) return wrong("at least one wall, found none");
  if (overhang) numbers.push_back({"an overhang", overhang->max_deg, kOverhangDeg});
  if (edges) numbers.push_back({"radii of edges", edges->min_radius_mm, kWallMm});
  if (size)
    for (const double mm : {size->width_mm, size->depth_mm, size->height_mm})
      numbers.push_back({"sizes", mm, kSizeMm});
  for (const auto& [what, value, range] : numbers)
    if (!range.holds(value))
      return wrong(std::string(what) + " " + range.text() + ", found " + number_text(value));
  return {};
}

Result<ProcessLimits> process_named(std::string_view name) {
  for (const ProcessLimits& process : built_in())
    if (name.size() == process.name.size() && ends_ignoring_case(name, process.name))
      return process;
  std::string names;
  for (const std::string_view known : kProcessNames)
    names.append(names.empty() ? "" : ", ").append(known);
  return failure(ErrorKind::bad_input,
                 "process: expected " + names + ", or a .json file, found " + std::string(name));
}

double smallest_allowed_wall_mm() {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ProcessLimits& process : built_in())
    for (const WallLimit& wall : process.walls) smallest = std::min(smallest, wall.min_wall_mm);
  return smallest;
}

Result<ProcessLimits> parse_process(std::string_view bytes, std::string_view file_name) {
  const std::string_view text = without_byte_order_mark(bytes);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || (text[first] != '{' && text[first] != '['))
    return failure(
        ErrorKind::bad_input,
        std::string(file_name) + ": expected a JSON object, found " + kind_of_file(text));
  return LocatedJson::from_json(text, file_name, kMaxValues)
      .and_then(
          [](const LocatedJson& document) { return ObjectReader::read(document, ProcessLimits{}); })
      .map([](ProcessLimits process) { return with_names({std::move(process)}).front(); })
      .map_error([&](Error error) {
        return kind_error(std::move(error), text, file_name, "a process (.process.json)");
      });
}

Result<ProcessLimits> read_process(const std::string& name) {
  if (!ends_ignoring_case(name, ".json")) return process_named(name);
  return read_file(name, kMaxProcessBytes).and_then([&](const std::string& bytes) {
    return parse_process(bytes, name);
  });
}

bool SizeLimit::fits(const glm::dvec3& size_mm) const noexcept {
  const auto within = [](double mm, double limit_mm) { return mm <= limit_mm + kSizeAllowanceMm; };
  const auto [least, most] = std::minmax(size_mm.x, size_mm.y);
  return within(least, std::min(width_mm, depth_mm)) &&
         within(most, std::max(width_mm, depth_mm)) && within(size_mm.z, height_mm);
}

std::optional<WallLimit> WallDemand::for_size(double size_sum_mm) const {
  std::optional<WallLimit> limit;
  if (min_wall_mm) limit = WallLimit{kAnySize, *min_wall_mm, min_wall_source, {}};
  if (!process) return limit;
  const WallLimit& asked = process->wall_for(size_sum_mm);
  return limit && limit->min_wall_mm >= asked.min_wall_mm ? limit : asked;
}

}  // namespace clay::solid::inline walls
