#include "claystack/export/option_ranges.hpp"

#include "claystack/export/job.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace clay::solid::inline job {
namespace {

/// A number of the options with its range; empty if it is not given.
struct RangedOption {
  OptionRange range;
  std::optional<double> value;
};

std::optional<double> count_of(const std::optional<std::size_t>& count) {
  return count ? std::optional(static_cast<double>(*count)) : std::nullopt;
}

/// On the written solid, which is enlarged for its shrinkage.
OptionRange glaze_range(const ExportOptions& options) {
  OptionRange range = kGlazeRange;
  range.lowest = std::max(range.lowest, kGlazeOfTolerance * options.tolerance_mm);
  range.highest *= enlargement(options.shrinkage);
  if (options.shrinkage > 0.0) range.name = "glaze allowance, enlarged for the shrinkage";
  return range;
}

void add_foot(std::vector<RangedOption>& list, const std::optional<FootRing>& foot) {
  if (!foot) return;
  list.push_back({kFootWidthRange, foot->width_mm});
  list.push_back({kFootDepthRange, foot->depth_mm});
  list.push_back({kFootDiameterRange, foot->diameter_mm});
}

std::vector<RangedOption> ranged_options(const ExportOptions& options) {
  std::vector<RangedOption> list{{kToleranceRange, options.tolerance_mm},
                                 {kShrinkageRange, options.shrinkage},
                                 {kSmoothLengthRange, options.smooth_length_mm},
                                 {kMinWallRange, options.walls.min_wall_mm},
                                 {kLipFilletRange, options.lip_fillet_mm},
                                 {kFloorFilletRange, options.finish.floor_fillet_mm},
                                 {glaze_range(options), options.finish.glaze_mm},
                                 {kSegmentsRange, count_of(options.segments)},
                                 {kMaxTrianglesRange, count_of(options.max_triangles)},
                                 {kDrainRange, options.drain_mm},
                                 {kWallSpacingRange, options.wall_spacing_mm},
                                 {kFillLineRange, options.fill_line_mm}};
  add_foot(list, options.finish.foot);
  return list;
}

}  // namespace

Result<void> check_range(const OptionRange& range, double value) {
  const bool absent = range.or_zero && value == 0.0;
  if (absent || (value >= range.lowest && value <= range.highest)) return {};  // NaN is in none
  const std::string unit = range.unit.empty() ? "" : " " + std::string(range.unit);
  return failure(ErrorKind::bad_input,
                 std::string(range.name) + ": expected " + (range.or_zero ? "0, or " : "") +
                     nine_digit_text(range.lowest) + " to " + nine_digit_text(range.highest) +
                     unit + ", found " + nine_digit_text(value) + unit);
}

Result<void> check_ranges(const ExportOptions& options) {
  for (const auto& [range, value] : ranged_options(options))
    if (value)
      if (auto valid = check_range(range, *value); !valid) return valid;
  ClayFigures clay = options.clay;
  clay.shrinkage = options.shrinkage;
  clay.density_g_cm3 = ClayFigures{}.density_g_cm3;  // that of the pot counts
  return clay.check().and_then([&]() -> Result<void> {
    return options.walls.process ? options.walls.process->check() : Result<void>();
  });
}

}  // namespace clay::solid::inline job
