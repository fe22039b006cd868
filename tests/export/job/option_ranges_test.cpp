#include "claystack/export/option_ranges.hpp"

#include "claystack/export/job.hpp"
#include "tests/export/formats/refused.hpp"
#include "tests/export/job/exported.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace clay::solid {
namespace {

using samples::exported;
using samples::refused;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A number of the options, the name of it in messages, and values at both ends of its range.
struct NumberCase {
  std::string name;
  double lowest, highest, too_large;
  void (*set)(ExportOptions& options, double value);
};

FootRing& foot_of(ExportOptions& options) {
  if (!options.finish.foot) options.finish.foot = FootRing{6.0, 4.0, 60.0};
  return *options.finish.foot;
}

ProcessLimits& process_of(ExportOptions& options) {
  if (!options.walls.process) {
    ProcessLimits process = process_named("stoneware").value();
    process.size = SizeLimit{300.0, 300.0, 300.0, "a kiln"};
    options.walls.process = process;
  }
  return *options.walls.process;
}

std::vector<NumberCase> lengths_of_files() {
  using Options = ExportOptions;
  return {
      {"tolerance: ", 1e-5, 10, 10.1, [](Options& o, double v) { o.tolerance_mm = v; }},
      {"smooth length: ", 0, 1e4, 10001, [](Options& o, double v) { o.smooth_length_mm = v; }},
      {"minimum wall: ", 1e-6, 1e4, 10001, [](Options& o, double v) { o.walls.min_wall_mm = v; }},
      {"lip fillet: ", 0, 1000, 1001, [](Options& o, double v) { o.lip_fillet_mm = v; }},
      {"floor fillet: ", 0, 1000, 1001, [](Options& o, double v) { o.finish.floor_fillet_mm = v; }},
      {"glaze allowance: ", 0, 10, 10.1, [](Options& o, double v) { o.finish.glaze_mm = v; }},
      {"foot ring width: ", 1e-3, 1e4, 10001,
       [](Options& o, double v) { foot_of(o).width_mm = v; }},
      {"foot ring depth: ", 1e-3, 1e4, 10001,
       [](Options& o, double v) { foot_of(o).depth_mm = v; }},
      {"foot ring diameter: ", 1e-3, 1e4, 10001,
       [](Options& o, double v) { foot_of(o).diameter_mm = v; }},
      {"drain: ", 1e-3, 1e4, 10001, [](Options& o, double v) { o.drain_mm = v; }},
      {"wall spacing: ", 1e-5, 1e4, 10001, [](Options& o, double v) { o.wall_spacing_mm = v; }},
      {"fill line: ", 0, 1e4, 10001, [](Options& o, double v) { o.fill_line_mm = v; }}};
}

std::vector<NumberCase> figures_of_clay_and_process() {
  using Options = ExportOptions;
  return {
      {"shrinkage: ", 0, 0.5, 0.51, [](Options& o, double v) { o.shrinkage = v; }},
      {"drying shrinkage: ", 0, 0, 0.1, [](Options& o, double v) { o.clay.drying_shrinkage = v; }},
      {"water: ", 0, 0.9, 0.91, [](Options& o, double v) { o.clay.water = v; }},
      {"loss on ignition: ", 0, 0.9, 0.91, [](Options& o, double v) { o.clay.ignition_loss = v; }},
      {"process: expected walls ", 1e-9, 1e4, 10001,
       [](Options& o, double v) { process_of(o).walls[0].min_wall_mm = v; }},
      {"process: expected walls by increasing size", 1.0, kNever, std::nan(""),
       [](Options& o, double v) { process_of(o).walls[0].up_to_size_sum_mm = v; }},
      {"process: expected an overhang ", 0, 90, 91,
       [](Options& o, double v) { process_of(o).overhang->max_deg = v; }},
      {"process: expected radii of edges ", 1e-9, 1e4, 10001,
       [](Options& o, double v) { process_of(o).edges->min_radius_mm = v; }},
      {"process: expected sizes ", 1e-9, 1e5, 100001,
       [](Options& o, double v) { process_of(o).size->height_mm = v; }}};
}

TEST(OptionRanges, RefuseNumbersOutOfRangeByName) {
  std::vector<NumberCase> cases = lengths_of_files();
  for (NumberCase& one : figures_of_clay_and_process()) cases.push_back(std::move(one));
  for (const NumberCase& one : cases) {
    const auto checked = [&](double value) {
      ExportOptions options;
      one.set(options, value);
      return check_ranges(options);
    };
    for (const double bad : {std::nan(""), -1.0, -1e-9, kNever, -kNever, one.too_large})
      if (bad != one.highest) {
        EXPECT_TRUE(refused(checked(bad), ErrorKind::bad_input, one.name)) << one.name << bad;
      }
    for (const double good : {one.lowest, one.highest}) {
      const auto valid = checked(good);
      EXPECT_TRUE(valid) << one.name << good << ": " << valid.error().message;
    }
  }
}

TEST(OptionRanges, RefuseCountsOutOfRangeByName) {
  const auto checked = [](auto set) {
    ExportOptions options;
    set(options);
    return check_ranges(options);
  };
  for (const std::size_t bad : {std::size_t{0}, std::size_t{2}, (std::size_t{1} << 20) + 1})
    EXPECT_TRUE(refused(checked([&](ExportOptions& o) { o.segments = bad; }), ErrorKind::bad_input,
                        "segments: expected 3 to 1048576, found " + std::to_string(bad)));
  for (const std::size_t bad : {std::size_t{0}, std::size_t{7}, std::size_t{20'000'001}})
    EXPECT_TRUE(refused(checked([&](ExportOptions& o) { o.max_triangles = bad; }),
                        ErrorKind::bad_input,
                        "max triangles: expected 8 to 20000000, found " + std::to_string(bad)));
  EXPECT_TRUE(checked([](ExportOptions& o) { o.max_triangles = 20'000'000; }));
  EXPECT_TRUE(checked([](ExportOptions& o) { o.segments = 3; }));
  EXPECT_TRUE(refused(checked([](ExportOptions& o) { process_of(o).walls.clear(); }),
                      ErrorKind::bad_input, "process: expected at least one wall, found none"));
}

TEST(OptionRanges, StateRangeUnitAndFoundValue) {
  ExportOptions options;
  options.fill_line_mm = -2.5;
  EXPECT_EQ(check_ranges(options).error().message,
            "fill line: expected 0 to 10000 mm, found -2.5 mm");
  options = {};
  options.finish.glaze_mm = std::nan("");
  EXPECT_EQ(check_ranges(options).error().message,
            "glaze allowance: expected 0, or 0.002 to 10 mm, found nan mm");
  options = {};
  options.shrinkage = 0.75;
  EXPECT_EQ(check_ranges(options).error().message, "shrinkage: expected 0 to 0.5, found 0.75");
}

/// 10 mm of fired glaze are 12.5 mm on a solid that loses a fifth of its lengths.
TEST(OptionRanges, TakeTenMillimetresOfFiredGlaze) {
  ExportOptions options;
  options.shrinkage = 0.2;
  options.finish.glaze_mm = 10.0 * enlargement(options.shrinkage);
  EXPECT_TRUE(check_ranges(options));
  options.finish.glaze_mm = 12.6;
  EXPECT_EQ(check_ranges(options).error().message,
            "glaze allowance, enlarged for the shrinkage: expected 0, or 0.002 to 12.5 mm, found "
            "12.6 mm");
}

/// The options alone are at fault, not the pot whose name they carry.
TEST(OptionRanges, AreCheckedByEveryEntryBeforeAnyWork) {
  const Pot pot = shapes::pot_of(shapes::vase(100));
  ExportRequest request;
  request.options.source = "vase.pot.json";
  request.options.fill_line_mm = -1.0;
  request.files = {{"no/such/folder/vase.stl", FileKind::mesh}};
  const std::string expected = "fill line: expected 0 to 10000 mm, found -1 mm";
  int stages = 0;
  const auto count = [&](std::string_view) { ++stages; };
  EXPECT_EQ(run_export(pot, {}, request.options, count).error().message, expected);
  EXPECT_EQ(export_files(pot, request, count).error().message, expected);
  EXPECT_EQ(preview_export(pot, request, count).error().message, expected);
  Goal goal;
  goal.height_mm = 100.0;
  EXPECT_EQ(scaled_to(pot, goal, request.options).error().message, expected);
  EXPECT_EQ(stages, 0);
}

}  // namespace
}  // namespace clay::solid
