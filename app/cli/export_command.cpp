#include "app/cli/commands.hpp"
#include "app/cli/export_report.hpp"
#include "app/cli/finish_options.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/packed_pot.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/pot_input.hpp"
#include "app/cli/quantity.hpp"
#include "app/cli/report_file.hpp"
#include "app/cli/usage.hpp"
#include "app/cli/wall_options.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/export/job.hpp"
#include "core/material.hpp"
#include "core/number_parsing.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::cli {
namespace {

using solid::FileKind;
using solid::FileRequest;
using solid::MeshFormat;

/// The command line as given.
struct ExportCommand {
  const CLI::App* line = nullptr;
  std::string pot;
  std::vector<std::string> outputs, named_outputs;
  solid::ExportRequest request;
  std::string smooth = "fair";
  bool length_of_tool = false;  ///< --smooth-length tool
  std::string verify = "margins";
  std::optional<std::string> step, glb, material;
  solid::Goal goal;

  [[nodiscard]] bool given(const std::string& option) const { return line->count(option) > 0; }
  [[nodiscard]] bool has_goal() const {
    return goal.holds_ml || goal.weighs_g || goal.height_mm || goal.diameter_mm;
  }
  WallOptions walls;
  double glaze_mm = 0.0;  ///< of the fired pot
  std::optional<double> precision_mm;
  bool ascii = false;
};

solid::Smoothing smoothing_of(std::string_view name) {
  for (const auto mode : {solid::Smoothing::fair, solid::Smoothing::exact})
    if (solid::name_of(mode) == name) return mode;
  return solid::Smoothing::none;
}

constexpr std::array kGlbMeshes{std::pair{"draco", solid::GlbMesh::draco},
                                std::pair{"meshopt", solid::GlbMesh::meshopt},
                                std::pair{"core", solid::GlbMesh::core}};

solid::GlbMesh glb_mesh_of(std::string_view name) {
  return std::ranges::find(kGlbMeshes, name,
                           [](const auto& mesh) { return std::string_view(mesh.first); })
      ->second;
}

/// "12%": a part, 0.12. Errors state what was expected.
Result<double> part_of(const std::string& text, double most) {
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

constexpr double kMostSmoothMm = 1e4;

/// "9mm", "9", "0"; "tool": empty.
Result<std::optional<double>> smooth_length_of(const std::string& text) {
  if (text == "tool") return std::optional<double>();
  return length_of(text, 0.0, kMostSmoothMm)
      .map([](double mm) { return std::optional<double>(mm); })
      .map_error([](const Error& error) {
        return Error{error.kind, error.message + "; or tool"};
      });
}

Result<void> check_names(const ExportCommand& command, const Console& console) {
  std::vector<OutputFile> outputs;
  for (const std::string& path : command.outputs) outputs.push_back({path});
  outputs.push_back({command.request.report_path, {".html", ".json"}});
  if (command.request.certificates)
    for (const std::string& path : command.outputs) outputs.push_back({path + ".certificate.json"});
  return check_outputs(outputs, {command.pot, command.walls.process()}, console);
}

bool is_pot(const FileRequest& file) { return file.kind == FileKind::given; }
bool is_step(const FileRequest& file) { return file.kind == FileKind::step; }
bool is_mesh(const FileRequest& file) { return file.kind == FileKind::mesh; }
bool is_solid(const FileRequest& file) { return is_mesh(file) || is_step(file); }
bool is_made(const FileRequest& file) { return !is_pot(file); }
template <MeshFormat... Formats>
bool is_format(const FileRequest& file) {
  return is_mesh(file) && ((file.format == Formats) || ...);
}

/// An option and the files on which it has an effect.
struct FileOption {
  bool given;
  std::string_view name, kind;
  bool (*fits)(const FileRequest&);
};

/// Options of the solid that do not change a copy of the pot.
constexpr std::array kSolidOptions{"--segments", "--max-triangles", "--verify",
                                   "--measure-left-out"};
/// Options of the section, by which a goal scales the pot.
constexpr std::array kSectionOptions{"--tolerance",  "--smooth", "--smooth-length",
                                     "--lip-fillet", "--drain",  "--pieces"};

/// The options of the solid and the section that need a file other than a copy of the pot.
std::vector<FileOption> made_options(const ExportCommand& command) {
  std::vector<FileOption> options;
  const auto add = [&](const char* name) {
    options.push_back({command.given(name), name, "a mesh or its section", is_made});
  };
  std::ranges::for_each(kSolidOptions, add);
  if (!command.has_goal()) std::ranges::for_each(kSectionOptions, add);
  return options;
}

/// Refuses options that contradict each other. The export refuses them too, but names no option.
Result<void> check_pairs(const ExportCommand& command) {
  const solid::ExportOptions& options = command.request.options;
  const auto refuse = [](const std::string& text) { return failure(ErrorKind::bad_input, text); };
  for (const auto& [name, mm] : {std::pair("--smooth-length", options.smooth_length_mm),
                                 {"--lip-fillet", options.lip_fillet_mm}})
    if (mm.value_or(0.0) > 0.0 && command.smooth != "fair")
      return refuse(fmt::format("{}: expected --smooth fair, found {}", name, command.smooth));
  const double drying = options.clay.drying_shrinkage.value_or(0.0);
  if (drying > options.shrinkage)
    return refuse(
        fmt::format("--drying-shrinkage: expected at most --shrinkage, {:g}%, found {:g}%",
                    100.0 * options.shrinkage, 100.0 * drying));
  if (command.goal.fired && command.has_goal() && options.shrinkage == 0.0)
    return tl::make_unexpected(no_effect_without("--fired", "--shrinkage"));
  return {};
}

/// Refuses options that have no effect on any of the requested files.
Result<void> check_options(const ExportCommand& command) {
  const solid::ExportOptions& options = command.request.options;
  const bool unscaled = !command.has_goal();
  constexpr std::string_view kFinish = "--foot, --floor-fillet and --glaze-allowance";
  std::vector<FileOption> known{
      FileOption{command.precision_mm.has_value(), "--precision", "a pot", is_pot},
      FileOption{command.request.certificates, "--certificate", "a mesh", is_mesh},
      FileOption{unscaled && options.shrinkage > 0.0, "--shrinkage", "a mesh or its section",
                 is_made},
      FileOption{unscaled && options.finish.asked(), kFinish, "a mesh or its section", is_made},
      FileOption{command.walls.asked(), "--min-wall and --process", "a solid", is_solid},
      FileOption{command.step.has_value(), "--step", "a .step", is_step},
      FileOption{command.glb.has_value(), "--glb", "a .glb", is_format<MeshFormat::glb>},
      FileOption{options.wall_map, "--wall-map", "a .glb or a .3mf",
                 is_format<MeshFormat::glb, MeshFormat::three_mf>},
      FileOption{command.material.has_value(), "--material", "a .glb", is_format<MeshFormat::glb>},
      FileOption{command.ascii, "--ascii", "an .stl", is_format<MeshFormat::stl_ascii>},
      FileOption{options.normals, "--normals", "an .obj", is_format<MeshFormat::obj>}};
  std::ranges::copy(made_options(command), std::back_inserter(known));
  for (const FileOption& option : known)
    if (option.given && std::ranges::none_of(command.request.files, option.fits))
      return failure(ErrorKind::bad_input,
                     fmt::format("{}: expected {} among the files to write, found none",
                                 option.name, option.kind));
  constexpr solid::ClayFigures kUsual;
  for (const auto& [name, given] :
       {std::pair("--drying-shrinkage", options.clay.drying_shrinkage.value_or(0.0) > 0.0),
        {"--water", options.clay.water != kUsual.water},
        {"--ignition-loss", options.clay.ignition_loss != kUsual.ignition_loss}})
    if (given && options.shrinkage == 0.0)
      return tl::make_unexpected(no_effect_without(name, "--shrinkage"));
  return check_pairs(command);
}

/// Standard output gets a binary STL, as from `check -o -`.
Result<FileRequest> file_of(const std::string& path, bool ascii) {
  if (path == "-")
    return FileRequest{path, FileKind::mesh,
                       ascii ? MeshFormat::stl_ascii : MeshFormat::stl_binary};
  if (pot_encoding_of(path)) return FileRequest{path, FileKind::given};
  return solid::file_request(path)
      .map([&](FileRequest file) {
        if (ascii && file.kind == FileKind::mesh && file.format == MeshFormat::stl_binary)
          file.format = MeshFormat::stl_ascii;
        return file;
      })
      .map_error([](const Error& error) {
        return Error{error.kind, error.message + ", .pot.json or .pot.cbor for the pot"};
      });
}

/// Files that take long to send or to slice are announced before they are written.
std::function<void(const std::string&, std::size_t, std::uint64_t)> warning_of_size(
    const Console& console, solid::Smoothing smoothing) {
  return
      [&console, smoothing](const std::string& name, std::size_t triangles, std::uint64_t bytes) {
        constexpr std::uint64_t kLargeBytes = 50'000'000;
        if (bytes < kLargeBytes) return;
        const bool fair = smoothing == solid::Smoothing::fair;
        console.warn(
            fmt::format("{}: about {:.0f} MB, {} triangles; {} or --max-triangles makes it "
                        "smaller",
                        name, 1e-6 * static_cast<double>(bytes), triangles,
                        fair ? "a larger --tolerance" : "--smooth fair"));
      };
}

/// The request without the pot.
Result<void> complete_request(ExportCommand& command, const Console& console) {
  if (auto loaded = command.walls.load(); !loaded) return loaded;
  for (const std::string& path : command.outputs) {
    auto file = file_of(path, command.ascii);
    if (!file) return tl::make_unexpected(file.error());
    command.request.files.push_back(std::move(*file));
  }
  if (auto names = check_names(command, console); !names) return names;
  solid::ExportOptions& options = command.request.options;
  options.smoothing = smoothing_of(command.smooth);
  if (command.step == "lines") options.step_walls = solid::StepWalls::lines;
  if (command.glb) options.glb = glb_mesh_of(*command.glb);
  options.material = command.material.value_or(options.material);
  options.full_verification = command.verify == "full";
  options.finish.glaze_mm = command.glaze_mm * solid::enlargement(options.shrinkage);
  options.walls = command.walls.demand();
  options.name = std::filesystem::path(command.pot).stem().stem().string();
  options.source = command.pot;
  options.announce_size = warning_of_size(console, options.smoothing);
  options.expect_memory = [](std::uint64_t bytes) { return expect_room("writing meshes", bytes); };
  return check_options(command);
}

/// Writes the copies of the pot at the requested precision.
Result<std::vector<PotCopy>> add_copies(const Pot& pot, ExportCommand& command) {
  const auto copied = command.precision_mm ? rounded_pot(pot, *command.precision_mm) : pot;
  if (!copied)
    return failure(copied.error().kind,
                   "--precision with " + command.pot + ": " + copied.error().message);
  std::vector<PotCopy> copies;
  for (FileRequest& file : command.request.files) {
    const auto encoding = pot_encoding_of(file.path);
    if (!encoding) continue;
    if (auto room = expect_room_to_write(copied->stack.size(), *encoding, file.path); !room)
      return tl::make_unexpected(room.error());
    file.bytes = write_pot(*copied, *encoding);
    copies.push_back(describe_copy(*copied, *encoding, file.bytes.size()));
  }
  return copies;
}

/// Scales the pot to its goal, and prints how.
Result<Pot> pot_at_goal(const Pot& pot, ExportCommand& command, const Console& console) {
  if (!command.has_goal()) {
    if (!command.goal.fired) return pot;
    return failure(ErrorKind::bad_input,
                   "--fired: expected --holds, --weighs, --height or --diameter, found none");
  }
  command.goal.to_fill_line = command.given("--fill-line");
  return solid::scaled_to(pot, command.goal, command.request.options)
      .map([&](solid::GoalReport reached) {
        console.print(fmt::format("scaled by {:.4f} across and {:.4f} up to meet the goal: {}",
                                  reached.met.radius_factor, reached.met.height_factor,
                                  solid::text_of(reached.met)));
        command.request.options.met_goal = reached.met;
        return std::move(reached.pot);
      });
}

/// `--smooth-length tool` needs a pot that remembers its tool; the default does without.
Result<void> check_tool_length(const Pot& pot, const ExportCommand& command) {
  if (!command.length_of_tool) return {};
  const auto refuse = [](const std::string& why) {
    return failure(ErrorKind::bad_input, "--smooth-length tool: expected " + why);
  };
  if (command.smooth != "fair") return refuse("--smooth fair, found " + command.smooth);
  if (pot.collapse) return refuse("a standing pot, found a collapsed one");
  if (solid::tool_length_mm(pot) == 0.0)
    return refuse("a pot that remembers its tool, found none in it; give the length in mm");
  return {};
}

/// The exit status: done, or unsound if a problem fails: wall, size or cavity.
Result<int> export_pot(ExportCommand& command, Console console) {
  if (command.outputs.empty())
    return failure(ErrorKind::bad_input, "expected a file to write, such as pot.3mf, found none");
  const bool streams = std::ranges::count(command.outputs, "-") > 0;
  if (streams && command.request.certificates)
    return failure(ErrorKind::bad_input,
                   "-: expected no --certificate with it, because a certificate is a file beside "
                   "its mesh");
  console.quiet = console.quiet || streams;
  Progress progress(console, "exporting", 0);
  progress.stage("reading");
  const auto given = read_pot(command.pot, console);
  if (!given) return tl::make_unexpected(given.error());
  if (auto complete = complete_request(command, console); !complete)
    return tl::make_unexpected(complete.error());
  if (auto length = check_tool_length(*given, command); !length)
    return tl::make_unexpected(length.error());
  progress.stage("scaling and copying");
  const auto pot = pot_at_goal(*given, command, console);
  if (!pot) return tl::make_unexpected(pot.error());
  const auto copies = add_copies(*pot, command);
  if (!copies) return tl::make_unexpected(copies.error());
  Thumbnail thumbnail;
  pack_pot(*pot, command.request, thumbnail);
  set_report(*pot, command.request, *copies);
  if (console.verbose && !pot->collapse)
    command.request.options.wall_spacing_mm = solid::kWallTableSpacingMm;
  const auto report = solid::export_files(*pot, command.request,
                                          [&](std::string_view stage) { progress.stage(stage); });
  if (!report) return tl::make_unexpected(report.error());
  if (console.json) print_json(export_json(*report, *copies, command.request.options.met_goal));
  print_export(console, *report, *copies);
  const bool fails = print_problems(console, *report);
  print_summary(console, *report);
  return fails ? kUnsound : kDone;
}

using SharedCommand = std::shared_ptr<ExportCommand>;

/// An option in percent, written "12%".
template <class Field>
void add_part(CLI::App* sub, const SharedCommand& command, const std::string& name, double most,
              const std::string& help, Field field) {
  sub->add_option_function<std::string>(
         name,
         [=](const std::string& text) {
           field(command->request.options) = part_of(text, most).value_or(0.0);
         },
         help)
      ->check([most](const std::string& text) {
        const auto parsed = part_of(text, most);
        return parsed ? std::string() : parsed.error().message;
      });
}

/// Figures for weights and capacities.
void add_clay_options(CLI::App* sub, const SharedCommand& command) {
  constexpr double kMost = 0.9;
  begin_group(*sub, "Shrinkage, weight and capacity");
  add_part(sub, command, "--shrinkage", solid::kMostShrinkage,
           "Shrinkage in drying and firing, in percent of each length, such as 12%: the files are "
           "enlarged so that the fired piece has the size of the pot (default: 0%)",
           [](solid::ExportOptions& options) -> double& { return options.shrinkage; });
  add_part(sub, command, "--drying-shrinkage", solid::kMostShrinkage,
           "Part of --shrinkage that happens in drying, in percent of each length (default: half)",
           [](solid::ExportOptions& options) -> double& {
             return options.clay.drying_shrinkage.emplace();
           });
  add_part(sub, command, "--water", kMost,
           "Water that leaves in drying, in percent of the weight as thrown (default: 20%)",
           [](solid::ExportOptions& options) -> double& { return options.clay.water; });
  add_part(sub, command, "--ignition-loss", kMost,
           "Loss in firing, in percent of the dry weight (default: 9%)",
           [](solid::ExportOptions& options) -> double& { return options.clay.ignition_loss; });
  add_length(*sub, "--fill-line", command->request.options.fill_line_mm,
             "Fill line for the capacity, below the brim of the finished pot, fired and glazed "
             "[mm]; with --holds the capacity is up to this line",
             0.0, 1e4)
      ->capture_default_str();
}

/// An option in units, written "350ml".
CLI::Option* add_quantity(CLI::App* sub, const std::string& name, std::optional<double>& value,
                          std::span<const Unit> units, const std::string& help) {
  return sub
      ->add_option_function<std::string>(
          name,
          [&value, units](const std::string& text) {
            if (const auto quantity = quantity_of(text, units)) value = *quantity;
          },
          help)
      ->check([units](const std::string& text) {
        const auto parsed = quantity_of(text, units);
        return parsed ? std::string() : parsed.error().message;
      });
}

/// Sizes to which the pot is scaled.
void add_goal_options(CLI::App* sub, const SharedCommand& command) {
  // A goal for a length is above 0, like those for volume and weight.
  begin_group(*sub, "Size of the pot");
  const auto add_size = [&](const std::string& name, std::optional<double>& value,
                            const std::string& help) {
    add_quantity(sub, name, value, kLengthUnits, help)->type_name(kLengthName);
  };
  add_quantity(
      sub, "--holds", command->goal.holds_ml, kVolumeUnits,
      "Scale the pot to this capacity, such as 350ml or 12oz (US fluid ounces): to the brim, "
      "or to --fill-line");
  add_quantity(sub, "--weighs", command->goal.weighs_g, kWeightUnits,
               "Scale the pot to this weight, such as 400g");
  add_size("--height", command->goal.height_mm,
           "Scale the pot to this height, such as 120mm; with one more of these options, "
           "height and radius are scaled separately");
  add_size("--diameter", command->goal.diameter_mm, "Scale the pot to this largest diameter");
  sub->add_flag("--fired", command->goal.fired,
                "The goal applies to the finished pot: after --shrinkage, and with the glaze of "
                "--glaze-allowance, which has no weight (default: to the pot as thrown)");
}

/// How the steps of the rings become walls.
void add_smoothing_options(CLI::App* sub, const SharedCommand& command) {
  sub->add_option("--smooth", command->smooth,
                  "fair: smooth walls; exact: smooth walls, every ring keeps its volume; none: the "
                  "steps of the rings remain")
      ->check(one_of({"fair", "exact", "none"}))
      ->capture_default_str();
  sub->add_option_function<std::string>(
         "--smooth-length",
         [=](const std::string& text) {
           if (const auto length = smooth_length_of(text)) {
             command->request.options.smooth_length_mm = *length;
             command->length_of_tool = !*length;
           }
         },
         "With --smooth fair: continuous curvature; marks shorter along the height than this are "
         "smoothed away, such as 9mm; tool: the radius of the pot's tool; 0: straight from ring to "
         "ring (default: tool; 0 without clay rules, "
         "or for a tolerance above 0.1 mm)")
      ->type_name(std::string(kLengthName) + "|tool")
      ->check([](const std::string& text) {
        const auto length = smooth_length_of(text);
        return length ? std::string() : length.error().message;
      });
}

/// Options of the solid.
void add_solid_options(CLI::App* sub, const SharedCommand& command) {
  begin_group(*sub, "Surface");
  add_length(*sub, "--tolerance", command->request.options.tolerance_mm,
             "Maximum chordal error, vertex error in .drc and distance of curves in .step [mm]",
             1e-5, 10.0)
      ->capture_default_str();
  add_smoothing_options(sub, command);
  sub->add_option("--segments", command->request.options.segments,
                  "Facets around the axis (default: chosen from the tolerance)")
      ->check(in_whole_range(3, 1 << 20));
  sub->add_option(
         "--max-triangles", command->request.options.max_triangles,
         "Maximum number of triangles (default: no limit); facets may then exceed the tolerance")
      ->check(in_whole_range(8, 20'000'000));
  begin_group(*sub, "Finish");
  add_finish_options(*sub, command->request.options, command->glaze_mm);
  add_length(*sub, "--drain", command->request.options.drain_mm,
             "Diameter of a hole along the axis that opens closed cavities, as thrown [mm] "
             "(default: none)",
             1e-3, 1e4);
}

/// Requirements on the solid, and their proof.
void add_demand_options(CLI::App* sub, const SharedCommand& command) {
  begin_group(*sub, "Requirements and proof");
  command->walls.add_to(*sub);
  sub->add_flag("--pieces", command->request.options.allow_pieces,
                "Accept a pot of several pieces that do not touch");
  sub->add_option("--verify", command->verify,
                  "margins: prove the rounding, read the file back; full: also check the file "
                  "like any foreign mesh, with the exact self-intersection test")
      ->check(one_of({"margins", "full"}))
      ->capture_default_str();
  sub->add_flag("--certificate", command->request.certificates,
                "Write OUT.certificate.json beside each mesh, for claystack check --certificate");
  sub->add_option("--report", command->request.report_path,
                  "File for the report: .html: a page to print; .json: what --json prints");
  sub->add_flag("--measure-left-out", command->request.options.measure_left_out,
                "Also run the skipped stages, and report the time [s] that skipping saves");
}

/// Choices within the formats.
void add_format_options(CLI::App* sub, const SharedCommand& command) {
  begin_group(*sub, "Formats");
  sub->add_option("--step", command->step,
                  "Walls in a .step: spline: one smooth surface for each wall, within the "
                  "tolerance; lines: cones, exactly (default: spline)")
      ->check(one_of({"spline", "lines"}));
  sub->add_option(
         "--glb", command->glb,
         "Mesh in a .glb: draco: compressed, within the tolerance; meshopt: compressed, larger, "
         "unpacked faster; core: plain, for readers without either (default: draco)")
      ->check(one_of({"draco", "meshopt", "core"}));
  sub->add_option("--material", command->material,
                  "Clay or glaze of a .glb, as for render (default: terracotta)")
      ->check(one_of(material_ids()));
  sub->add_flag("--wall-map", command->request.options.wall_map,
                "Colour a .glb and a .3mf by the wall thickness, as the window does");
  sub->add_flag("--ascii", command->ascii, "Write .stl as text");
  sub->add_flag("--normals", command->request.options.normals,
                "Write .obj with normals, for shading");
  add_length(*sub, "--precision", command->precision_mm,
             "Rounding of radii in pot files [mm] (default: exact); meshes keep the exact radii",
             1e-5, 1.0);
}

}  // namespace

void add_export_command(CLI::App& app, Console& console, int& exit) {
  auto command = std::make_shared<ExportCommand>();
  CLI::App* sub = app.add_subcommand(
      "export", "Write a pot as a printable solid, with a proof that it is sound");
  command->line = sub;
  sub->add_option("pot", command->pot,
                  std::string("NAME") + std::string(kPotInputs) + ", or - for standard input")
      ->required();
  sub->add_option(
      "out", command->outputs,
      "Files to write: " + solid::format_endings(solid::FormatUse::write) + "; " +
          solid::section_endings() +
          "; .pot.json or .pot.cbor for the pot; - for a binary STL on standard output");
  sub->add_option("-o,--output", command->named_outputs,
                  "File to write, like the argument out; repeatable")
      ->allow_extra_args(false);
  add_solid_options(sub, command);
  add_clay_options(sub, command);
  add_goal_options(sub, command);
  add_demand_options(sub, command);
  add_format_options(sub, command);
  sub->footer(
      "\nExamples:\n"
      "  claystack throw samples/bowl.scene.json -o bowl.pot.json\n"
      "  claystack export bowl.pot.json bowl.stl bowl.obj bowl.drc bowl.svg\n"
      "  claystack export bowl.pot.json bowl.step --process stoneware\n"
      "  claystack export bowl.pot.json bowl.3mf --holds 350ml --fired --shrinkage 12%\n"
      "  claystack export bowl.pot.json bowl.pdf bowl.dxf --shrinkage 12%\n"
      "  claystack export bowl.pot.json bowl.3mf --foot 60x6x4 --floor-fillet 5mm\n"
      "  claystack export bowl.pot.json bowl.stl --tolerance 0.005 --process stoneware\n"
      "  claystack export bowl.pot.json bowl.stl --process porcelain --shrinkage 12%\n"
      "  claystack export bowl.pot.json bowl.drc --certificate --report bowl.report.json\n"
      "  claystack export bowl.pot.json bowl.pot.cbor --precision 0.001");
  sub->callback([command, &console, &exit] {
    std::ranges::move(command->named_outputs, std::back_inserter(command->outputs));
    const auto done = export_pot(*command, console);
    exit = done ? *done : report(done.error());
  });
}

}  // namespace clay::cli
