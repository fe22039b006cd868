#include "app/cli/commands.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/quantity.hpp"
#include "app/cli/usage.hpp"
#include "app/import/drawing_warnings.hpp"
#include "app/import/drawn_pot.hpp"
#include "app/import/pot_ranges.hpp"
#ifdef CLAYSTACK_EXPORT
#include "app/cli/import_mesh.hpp"
#include "claystack/export/formats.hpp"
#endif

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "core/size_text.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::cli {
namespace {

using namespace importing;

struct ImportOptions {
  std::string drawing, pot, axis, layer;
  HalfSectionSettings section;
  DrawnPotSettings pot_settings;
};

Result<void> set_axis(ImportOptions& options) {
  HalfSectionSettings& section = options.section;
  if (options.axis.empty()) return {};
  for (const auto& [name, rule] : {std::pair("left", AxisRule::left),
                                   {"middle", AxisRule::middle},
                                   {"right", AxisRule::right}})
    if (options.axis == name) {
      section.axis = rule;
      return {};
    }
  constexpr double kFarthestMm = 1e6;
  const auto place = length_of(options.axis, -kFarthestMm, kFarthestMm);
  if (!place)
    return failure(ErrorKind::bad_input,
                   fmt::format("--axis: expected left, middle, right or a place in mm, found {}",
                               options.axis));
  section.axis_mm = *place;
  section.axis = AxisRule::at;
  return {};
}

Json summary(const ImportOptions& options, const HalfSection& section, const DrawnPot& drawn,
             const std::vector<std::string>& warnings) {
  const Pot& pot = drawn.pot;
  const Deviation& deviation = drawn.deviation;
  return {{"drawing", options.drawing},
          {"axis_mm", section.axis_mm},
          {"axis", section.axis == AxisRule::middle  ? "middle"
                   : section.axis == AxisRule::left  ? "left"
                   : section.axis == AxisRule::right ? "right"
                   : section.axis == AxisRule::line  ? "line"
                                                     : "at"},
          {"rings", pot.stack.size()},
          {"ring_height_mm", pot.stack.ring_height_mm()},
          {"height_mm", pot.stack.height_mm()},
          {"drawn_mm3", section.volume_mm3()},
          {"volume_mm3", pot.stack.volume_mm3()},
          {"deviation_mm", deviation.mm},
          {"deviation_at_mm", {deviation.radius_mm, deviation.height_mm}},
          {"thinnest_wall_mm", drawn.thinnest ? Json(drawn.thinnest->mm) : Json()},
          {"warnings", warnings}};
}

const char* axis_source(const ImportOptions& options, const HalfSection& section) {
  switch (section.axis) {
    case AxisRule::middle:
      return "the middle of the drawing";
    case AxisRule::left:
      return "its left end";
    case AxisRule::right:
      return options.axis.empty() ? "the straight edge at its right end" : "its right end";
    case AxisRule::line:
      return "its vertical line";
    default:
      return options.axis.empty() ? "radius 0 of the table" : "--axis";
  }
}

void print_summary(const Console& console, const ImportOptions& options, const HalfSection& section,
                   const DrawnPot& drawn, const Json& json) {
  console.print(fmt::format("axis at x = {:.3f} mm of the drawing ({})",
                            rounded_to(json["axis_mm"].get<double>(), 1e-3),
                            axis_source(options, section)));
  console.print(fmt::format("{} of {:.4g} mm: {} mm high, {} cm3 of clay ({} cm3 {})",
                            counted(json["rings"].get<std::size_t>(), "ring"),
                            number_field(json, "ring_height_mm"),
                            size_text(number_field(json, "height_mm"), 1),
                            size_text(number_field(json, "volume_mm3") / 1e3, 1),
                            size_text(number_field(json, "drawn_mm3") / 1e3, 1),
                            options.pot_settings.wall_mm ? "if it were solid" : "in the drawing"));
  console.print(text_of(drawn.deviation, "drawing"));
  if (!drawn.pot.stack.hollow())
    console.print("solid: the drawing shows no inside (--wall LENGTH makes one)");
  if (drawn.thinnest)
    console.print(fmt::format(
        "thinnest wall as drawn: {:.2f} mm, {:.2f} mm from the axis and {:.2f} mm above "
        "the foot",
        drawn.thinnest->mm, drawn.thinnest->radius_mm, drawn.thinnest->height_mm));
}

#ifdef CLAYSTACK_EXPORT
Result<void> import_from_mesh(const ImportOptions& options, const Console& console) {
  for (const auto& [option, given] : {std::pair("--axis", !options.axis.empty()),
                                      {"--layer", !options.layer.empty()},
                                      {"--wall", options.pot_settings.wall_mm.has_value()}})
    if (given)
      return failure(ErrorKind::bad_input, fmt::format("{}: expected a drawing, found the mesh {}",
                                                       option, options.drawing));
  return import_mesh(options.drawing, options.pot,
                     {options.section.height_mm, options.pot_settings}, console);
}
#endif

Result<void> import_drawing(const ImportOptions& options, const Console& console) {
  Progress progress(console, "importing", 0);
  progress.stage("reading");
  const auto bytes = read_file(options.drawing);
  if (!bytes) return tl::make_unexpected(bytes.error());
  const auto section = read_half_section(*bytes, options.drawing, options.layer, options.section);
  if (!section) return tl::make_unexpected(section.error());
  for (const std::string& note : section->notes) console.warn(note);
  progress.stage("making rings");
  const auto pot = drawn_pot(*section, options.pot_settings, options.drawing);
  if (!pot) return tl::make_unexpected(pot.error());
  const PotEncoding encoding = pot_encoding_of(options.pot).value_or(PotEncoding::json);
  if (auto room = expect_room_to_write(pot->pot.stack.size(), encoding, options.pot); !room)
    return room;
  if (auto done = publish(options.pot, write_pot(pot->pot, encoding)); !done) return done;
  std::vector<std::string> warnings = section->notes;
  for (std::string& warning :
       drawing_warnings(*section, *pot, options.pot_settings, options.drawing)) {
    console.warn(warning);
    warnings.push_back(std::move(warning));
  }
  const Json json = summary(options, *section, *pot, warnings);
  if (console.json) print_json(json);
  print_summary(console, options, *section, *pot, json);
  console.print("pot: " + options.pot);
  return {};
}

Result<void> import_file(ImportOptions options, Console console) {
  if (options.pot == "-") console.quiet = true;
  if (auto named = check_pot_name(options.pot); !named) return named;
  if (auto axis = set_axis(options); !axis) return axis;
  if (auto free = check_outputs({{options.pot}}, {options.drawing}, console); !free) return free;
#ifdef CLAYSTACK_EXPORT
  if (solid::mesh_format_of(options.drawing)) return import_from_mesh(options, console);
#endif
  return import_drawing(options, console);
}

/// Options about the content of the drawing, and its size.
void add_drawing_options(CLI::App* command, ImportOptions& options) {
  command
      ->add_option(
          "--axis", options.axis,
          "Axis of the pot in the drawing: left, middle, right, or its x position [mm]; default: "
          "a separate vertical line; else the middle of a symmetric drawing; else a straight edge "
          "at its right end, if the left end has none; else its left end. Of a table (.csv), the "
          "default is radius 0")
      ->type_name("AXIS");
  command
      ->add_option("--layer", options.layer,
                   "The only layer of an SVG or DXF drawing to read, by its name (default: all "
                   "that are shown)")
      ->type_name("NAME");
  add_length(*command, "--height", options.section.height_mm,
             "Height of the pot: scales the drawing or mesh [mm] (default: as it is)",
             kPotHeightRange.low, kPotHeightRange.high);
}

void add_pot_options(CLI::App* command, DrawnPotSettings& settings) {
  add_length(
      *command, "--wall", settings.wall_mm,
      "Thickness of the wall, measured across it, and of the floor, for a drawing that shows "
      "only the outside [mm] (default: solid)",
      kDrawnWallRange.low, kDrawnWallRange.high);
  add_length(*command, "--ring-height", settings.ring_height_mm,
             "Maximum ring height [mm] (default: 0.75, or less where the rings would deviate "
             "by more than 0.02 mm from the drawing)",
             kMinRingHeightMm, kMaxRingHeightMm);
  command->add_option("--density", settings.density_g_cm3, "Density of the clay [g/cm3]")
      ->check(in_range(kMinDensityGCm3, kMaxDensityGCm3))
      ->capture_default_str();
}

}  // namespace

void add_import_command(CLI::App& app, Console& console, int& exit) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App* command = app.add_subcommand(
      "import",
      "Make a pot from a drawing of its section, or from a mesh, to throw on or to print");
  add_file(*command, "drawing", options->drawing,
           "NAME.svg, NAME.dxf or NAME.csv, or - for one of them on standard input; or a mesh "
           "of a pot"
#ifdef CLAYSTACK_EXPORT
           ": " +
               solid::format_endings(solid::FormatUse::read)
#endif
               )
      ->required();
  add_file(*command, "-o,--output", options->pot,
           "NAME.pot.json or NAME.pot.cbor; or - for .pot.json on standard output")
      ->required();
  add_drawing_options(command, *options);
  add_pot_options(command, options->pot_settings);
  command->footer(
      "\nExamples:\n"
      "  claystack import samples/drawings/jug.svg -o jug.pot.json --height 180\n"
      "  claystack import samples/drawings/tumbler.csv --wall 6 -o lump.pot.json\n"
      "  claystack throw --from lump.pot.json --device auto -o "
      "mine.pot.json\n"
      "  claystack export jug.pot.json jug.stl\n"
      "  claystack import jug.stl -o scan.pot.json");
  command->callback([options, &console, &exit] {
    const auto done = import_file(*options, console);
    exit = done ? kDone : report(done.error());
  });
}

}  // namespace clay::cli
