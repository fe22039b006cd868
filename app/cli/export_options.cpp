#include "app/cli/export_options.hpp"

#include "app/cli/export_words.hpp"
#include "app/cli/finish_options.hpp"
#include "app/cli/pot_input.hpp"
#include "app/cli/quantity.hpp"
#include "app/cli/usage.hpp"

#include "core/material.hpp"
#include "core/number_parsing.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace clay::cli {
namespace {

/// "12%": a part, 0.12. Errors state what was expected.
Result<double> parse_percent(const std::string& text, double most) {
  double percent = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, problem] = from_chars(text.data(), end, percent);
  std::string_view rest(stop, static_cast<std::size_t>(end - stop));
  if (rest.starts_with(' ')) rest.remove_prefix(1);
  if (problem != std::errc() || rest != "%" || !(percent >= 0.0 && percent <= 100.0 * most))
    return failure(ErrorKind::bad_input,
                   fmt::format("expected a percentage from 0% to {:g}%, such as 12%, found {}",
                               100.0 * most, text));
  return 0.01 * percent;
}

/// "9mm", "9", "0"; "tool": empty.
Result<std::optional<double>> smooth_length_of(const std::string& text) {
  if (text == "tool") return std::optional<double>();
  return length_of(text, solid::kSmoothLengthRange.lowest, solid::kSmoothLengthRange.highest)
      .map([](double mm) { return std::optional<double>(mm); })
      .map_error([](const Error& error) { return or_else("tool", error); });
}

/// The pot and the files to write.
void add_files(CLI::App& sub, ExportCommand& command) {
  add_file(sub, "pot", command.pot,
           std::string("NAME") + std::string(kPotInputs) + ", or - for standard input")
      ->required();
  add_file(sub, "out", command.outputs,
           "Files to write: " + solid::format_endings(solid::FormatUse::write) + "; " +
               solid::section_endings() +
               "; .pot.json or .pot.cbor for the pot; - for a binary STL on standard output");
  add_file(sub, "-o,--output", command.named_outputs,
           "File to write, like the argument out; repeatable")
      ->allow_extra_args(false);
}

/// An option whose text is read by `parse`; `set` gets the number.
template <class Parse, class Set>
CLI::Option* add_parsed(CLI::App& sub, const std::string& name, const std::string& help,
                        Parse parse, Set set) {
  return sub
      .add_option_function<std::string>(
          name,
          [parse, set](const std::string& text) {
            if (const auto parsed = parse(text)) set(*parsed);
          },
          help)
      ->check([parse](const std::string& text) {
        const auto parsed = parse(text);
        return parsed ? std::string() : parsed.error().message;
      });
}

/// An option in percent, written "12%".
template <class Field>
void add_part(CLI::App& sub, ExportCommand& command, const std::string& name, double most,
              const std::string& help, Field field) {
  add_parsed(
      sub, name, help, [most](const std::string& text) { return parse_percent(text, most); },
      [&command, field](double part) { field(command.request.options) = part; })
      ->type_name("PERCENT");
}

/// Figures for weights and capacities.
void add_clay_options(CLI::App& sub, ExportCommand& command) {
  begin_group(sub, "Shrinkage, weight and capacity");
  add_part(sub, command, "--shrinkage", solid::kMostShrinkage,
           "Shrinkage in drying and firing, in percent of each length, such as 12%: the files are "
           "enlarged so that the fired piece has the size of the pot (default: 0%)",
           [](solid::ExportOptions& options) -> double& { return options.shrinkage; });
  add_part(sub, command, "--drying-shrinkage", solid::kMostShrinkage,
           "Part of --shrinkage that happens in drying, in percent of each length (default: half)",
           [](solid::ExportOptions& options) -> double& {
             return options.clay.drying_shrinkage.emplace();
           });
  add_part(sub, command, "--water", solid::kMostWeightLoss,
           "Water that leaves in drying, in percent of the wet weight (default: 20%)",
           [](solid::ExportOptions& options) -> double& { return options.clay.water; });
  add_part(sub, command, "--ignition-loss", solid::kMostWeightLoss,
           "Loss in firing, in percent of the dry weight (default: 9%)",
           [](solid::ExportOptions& options) -> double& { return options.clay.ignition_loss; });
  add_length(sub, "--fill-line", command.request.options.fill_line_mm,
             "Fill line, below the brim of the finished pot, fired and glazed [mm]; if it is given "
             "with --holds, the capacity of --holds is measured up to it, not to the brim",
             solid::kFillLineRange.lowest, solid::kFillLineRange.highest)
      ->capture_default_str();
}

/// An option in units, written "350ml".
CLI::Option* add_quantity(CLI::App& sub, const std::string& name, std::optional<double>& value,
                          std::span<const Unit> units, const std::string& help) {
  return add_parsed(
      sub, name, help, [units](const std::string& text) { return quantity_of(text, units); },
      [&value](double quantity) { value = quantity; });
}

/// Sizes to which the pot is scaled.
void add_goal_options(CLI::App& sub, ExportCommand& command) {
  // A goal for a length is above 0, like those for volume and weight.
  begin_group(sub, "Size of the pot");
  const auto add_size = [&](const std::string& name, std::optional<double>& value,
                            const std::string& help) {
    add_quantity(sub, name, value, kLengthUnits, help)->type_name(kLengthName);
  };
  add_quantity(
      sub, "--holds", command.goal.holds_ml, kVolumeUnits,
      "Scale the pot to this capacity, such as 350ml or 12oz (US fluid ounces): to the brim, "
      "or to --fill-line")
      ->type_name("VOLUME");
  add_quantity(sub, "--weighs", command.goal.weighs_g, kWeightUnits,
               "Scale the pot to this weight, such as 400g")
      ->type_name("WEIGHT");
  add_size("--height", command.goal.height_mm,
           "Scale the pot to this height, such as 120mm; with one more of these options, "
           "height and radius are scaled separately");
  add_size("--diameter", command.goal.diameter_mm, "Scale the pot to this largest diameter");
  sub.add_flag("--fired", command.goal.fired,
               "The goal applies to the finished pot: after --shrinkage, and with the glaze of "
               "--glaze-allowance, whose weight is not counted (default: to the wet pot)");
}

/// Options of smoothing, which turns the steps of the rings into walls.
void add_smoothing_options(CLI::App& sub, ExportCommand& command) {
  sub.add_option("--smooth", command.smooth,
                 "fair: smooth walls; exact: smooth walls, every ring keeps its volume; none: the "
                 "steps of the rings remain")
      ->check(one_of(names_in(kSmoothings)))
      ->capture_default_str();
  sub.add_option_function<std::string>(
         "--smooth-length",
         [&command](const std::string& text) {
           if (const auto length = smooth_length_of(text)) {
             command.request.options.smooth_length_mm = *length;
             command.length_of_tool = !*length;
           }
         },
         "With --smooth fair: smooths away marks that are shorter along the height than this "
         "length, such as 9mm. tool: the radius of the pot's tool; 0: straight walls from ring to "
         "ring (default: tool; 0 for a pot without clay rules, or for a tolerance above 0.1 mm)")
      ->type_name(std::string(kLengthName) + "|tool")
      ->check([](const std::string& text) {
        const auto length = smooth_length_of(text);
        return length ? std::string() : length.error().message;
      });
}

/// Options of the solid.
void add_solid_options(CLI::App& sub, ExportCommand& command) {
  begin_group(sub, "Surface");
  add_length(sub, "--tolerance", command.request.options.tolerance_mm,
             "Maximum chordal error, vertex error in .drc and distance of curves in .step [mm]",
             solid::kToleranceRange.lowest, solid::kToleranceRange.highest)
      ->capture_default_str();
  add_smoothing_options(sub, command);
  sub.add_option("--segments", command.request.options.segments,
                 "Facets around the axis (default: chosen from the tolerance)")
      ->check(in_whole_range(solid::kMinSegments, solid::kMaxSegments));
  sub.add_option(
         "--max-triangles", command.request.options.max_triangles,
         "Maximum number of triangles (default: no limit); facets may then exceed the tolerance")
      ->check(in_whole_range(solid::kFewestOfPot, solid::kMaxTriangles));
  begin_group(sub, "Finish");
  add_finish_options(sub, command.request.options, command.glaze_mm);
  add_length(sub, "--drain", command.request.options.drain_mm,
             "Diameter of a hole along the axis that opens closed cavities, of the wet pot [mm] "
             "(default: none)",
             solid::kDrainRange.lowest, solid::kDrainRange.highest);
}

/// Requirements on the solid, and their proof.
void add_demand_options(CLI::App& sub, ExportCommand& command) {
  begin_group(sub, "Requirements and proof");
  command.walls.add_to(sub);
  sub.add_flag("--pieces", command.request.options.allow_pieces,
               "Accept a pot of several pieces that do not touch");
  sub.add_option("--verify", command.verify,
                 "margins: prove the rounding, read the file back; full: also check the file "
                 "like any foreign mesh, with the exact self-intersection test")
      ->check(one_of({"margins", "full"}))
      ->capture_default_str();
  sub.add_flag("--certificate", command.request.certificates,
               "Write OUT.certificate.json beside each mesh, for claystack check --certificate");
  add_file(sub, "--report", command.request.report_path,
           "File for the report: .html: a page to print; .json: what --json prints");
  sub.add_flag("--measure-left-out", command.request.options.measure_left_out,
               "Also run the skipped stages, and report the time [s] that skipping saves");
}

/// Choices within the formats.
void add_format_options(CLI::App& sub, ExportCommand& command) {
  begin_group(sub, "Formats");
  sub.add_option("--step", command.step,
                 "Walls in a .step: spline: one smooth surface for each wall, within the "
                 "tolerance; lines: cones, exactly (default: spline)")
      ->check(one_of(names_in(kStepWalls)));
  sub.add_option(
         "--glb", command.glb,
         "Mesh in a .glb: draco: compressed, within the tolerance; meshopt: compressed, larger, "
         "unpacked faster; core: plain, for readers without either (default: draco)")
      ->check(one_of(names_in(kGlbMeshes)));
  sub.add_option("--material", command.material,
                 "Clay or glaze of a .glb, as for render (default: terracotta)")
      ->check(one_of(material_ids()));
  sub.add_flag("--wall-map", command.request.options.wall_map,
               "Colour a .glb and a .3mf by the wall thickness, as the window does");
  sub.add_flag("--ascii", command.ascii, "Write .stl as text");
  sub.add_flag("--normals", command.request.options.normals,
               "Write .obj with normals, for shading");
  add_length(sub, "--precision", command.precision_mm,
             "Rounding of radii in pot files [mm] (default: exact); meshes keep the exact radii",
             1e-5, 1.0);
}

}  // namespace

void add_export_options(CLI::App& sub, ExportCommand& command) {
  command.line = &sub;
  add_files(sub, command);
  add_solid_options(sub, command);
  add_clay_options(sub, command);
  add_goal_options(sub, command);
  add_demand_options(sub, command);
  add_format_options(sub, command);
}

}  // namespace clay::cli
