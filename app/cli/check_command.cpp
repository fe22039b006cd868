#include "app/cli/check.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/quantity.hpp"
#include "app/cli/usage.hpp"
#include "core/text.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/export/repair.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::cli {
namespace {

bool is_pot(std::string_view path) {
  return ends_ignoring_case(path, ".json") || ends_ignoring_case(path, ".cbor");
}

/// The options of a repair that are given.
std::vector<std::string_view> details_of_repair(const solid::RepairOptions& options) {
  std::vector<std::string_view> given;
  for (const auto& [name, is_given] : {std::pair("--weld", options.weld_mm.has_value()),
                                       {"--cap", options.cap_openings},
                                       {"--thicken", options.thicken_mm.has_value()},
                                       {"--wrap", options.wrap_mm.has_value()}})
    if (is_given) given.push_back(name);
  return given;
}

/// Checks combinations of options.
Result<void> check_usage(const CheckCommand& command, const Console& console) {
  if (command.wall_samples_asked && !command.walls.asked() && !is_pot(command.file))
    return tl::make_unexpected(no_effect_without("--wall-samples", "--min-wall or --process"));
  if (command.dry_run && !command.changes_mesh())
    return failure(ErrorKind::bad_input, "--dry-run: expected --repair or --max-triangles with it");
  if (const auto details = details_of_repair(command.repair_options);
      !details.empty() && !command.repair)
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected --repair with {}", fmt::join(details, ", "),
                               details.size() == 1 ? "it" : "them"));
  if (command.changes_mesh() == command.out.empty() && !command.dry_run)
    return failure(ErrorKind::bad_input,
                   command.changes_mesh()
                       ? "expected -o FILE for the result of --repair or --max-triangles, or "
                         "--dry-run"
                       : "-o: expected --repair or --max-triangles with it");
  if (command.changes_mesh() && !command.out.empty() && command.out != "-" && !is_pot(command.file))
    if (const auto format = solid::mesh_format_of(command.out, solid::FormatUse::write); !format)
      return tl::make_unexpected(format.error());
  if (command.changes_mesh() && !command.certificate.empty())
    return failure(ErrorKind::bad_input,
                   "--certificate: expected no --repair or --max-triangles, because it verifies "
                   "the unchanged file");
  return check_outputs({{command.dry_run ? std::string() : command.out}},
                       {command.file, command.certificate, command.walls.process()}, console);
}

/// A map in CBOR, with which no text begins, or an object in JSON; the header of a binary STL may
/// begin with either.
bool begins_as_pot(std::string_view bytes) {
  if (is_binary_stl(bytes, bytes.size())) return false;
  const std::size_t begin = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  return static_cast<unsigned char>(bytes.front()) >> 5 == 5 ||
         bytes.substr(begin).starts_with('{');
}

Result<Verdict> check_stream(const CheckCommand& command, const Console& console) {
  auto bytes = read_file(command.file);
  if (!bytes) return tl::make_unexpected(bytes.error());
  if (bytes->empty())
    return failure(ErrorKind::bad_input, "-: expected a mesh or a pot, found no input");
  if (begins_as_pot(*bytes)) return check_pot(*bytes, command, console);
  const solid::MeshFormat format = solid::mesh_format_of_bytes(*bytes);
  return check_mesh_file(format, command, console, std::move(*bytes));
}

Result<Verdict> check_file(const CheckCommand& command, const Console& console) {
  if (command.file == "-") return check_stream(command, console);
  if (is_pot(command.file))
    return read_file(command.file).and_then([&](const std::string& bytes) {
      return check_pot(bytes, command, console);
    });
  const auto format = solid::mesh_format_of(command.file);
  if (!format) {
    const auto bytes = read_file(command.file);
    if (!bytes) return tl::make_unexpected(bytes.error());
    return failure(ErrorKind::bad_input, format.error().message +
                                             ", or a pot: .pot.json, .pot.cbor; the file is " +
                                             kind_of_file(*bytes));
  }
  return check_mesh_file(*format, command, console);
}

/// For a file that could not be examined.
Verdict failed(const Error& error) {
  switch (error.kind) {
    case ErrorKind::unsound:
      return not_examined(MeshState::will_not_print, "not repaired", error.message);
    case ErrorKind::io:
      return not_examined(MeshState::unreadable, "not read or written", error.message);
    case ErrorKind::bad_input:
    case ErrorKind::device:
      break;
  }
  return not_examined(MeshState::unreadable, "unreadable", error.message);
}

int check(CheckCommand& command, Console& console) {
  if (command.out == "-" && !console.json) console.quiet = true;
  if (auto loaded = command.walls.load(); !loaded) return report(loaded.error());
  if (const auto usage = check_usage(command, console); !usage) return report(usage.error());
  const auto verdict = check_file(command, console);
  if (!verdict)
    return report(verdict.error(), verdict_json(command.file, failed(verdict.error()), false));
  if (verdict->failure) {
    Json json = verdict_json(command.file, *verdict, false);
    json["written"] = nullptr;
    return report(*verdict->failure, std::move(json));
  }
  if (console.json) print_json(verdict_json(command.file, *verdict, command.accept_prints()));
  print_verdict(console, command.file, *verdict);
  return verdict->passes(command.accept_prints()) ? kDone : kUnsound;
}

/// Options for requirements on the file.
void add_demands(CLI::App* sub, const std::shared_ptr<CheckCommand>& command) {
  begin_group(*sub, "Requirements");
  command->walls.add_to(*sub);
  sub->add_option("--wall-samples", command->wall_samples_asked,
                  "Number of rays that sample the walls of a mesh; they may "
                  "miss the thinnest place (pots are measured, not sampled)")
      ->check(in_whole_range(1, solid::kMostWallSamples))
      ->default_str(std::to_string(kWallSamples));
  add_file(*sub, "--certificate", command->certificate,
           "Certificate of the file, to be verified against its bytes");
  sub->add_option(
         "--accept", command->accept,
         "Exit with status 0 for a mesh that is sound, or also for one that prints: its closed "
         "shells intersect in a few places or are nested, and a slicer unites them (default: "
         "sound). Other checks must not fail")
      ->check(one_of({"sound", "prints"}));
}

void add_repair_options(CLI::App* sub, const std::shared_ptr<CheckCommand>& command) {
  begin_group(*sub, "Repair");
  sub->add_flag("--repair", command->repair,
                "Repair the mesh until it is sound, and report what was repaired; where that is "
                "not possible, report the reason and write nothing");
  constexpr double kLeastMm = 1e-3, kMostMm = 1e6;
  add_length(*sub, "--weld", command->repair_options.weld_mm,
             "With --repair: width of the cracks that are welded [mm]; default: a quarter of "
             "the shortest edge at a border, slivers left out, at most 1/1000 of the size of the "
             "mesh",
             0.0, kMostMm);
  sub->add_flag("--cap", command->repair_options.cap_openings,
                "With --repair: close wide openings by caps instead of refusing them");
  add_length(*sub, "--thicken", command->repair_options.thicken_mm,
             "With --repair: thickness of the wall that a surface with a wide opening gets, "
             "half on each side [mm]; no effect on a closed mesh; default: such a surface is "
             "refused",
             kLeastMm, kMostMm)
      ->excludes("--cap");
  add_length(*sub, "--wrap", command->repair_options.wrap_mm,
             "With --repair, as a last resort: replace the surface by a wrap at this distance "
             "around it [mm], which loses smaller details; default: such a mesh is refused",
             kLeastMm, kMostMm);
}

/// The changed mesh.
void add_output_options(CLI::App* sub, const std::shared_ptr<CheckCommand>& command) {
  begin_group(*sub, "Output");
  sub->add_flag("--dry-run", command->dry_run, "Report the changes without writing a file");
  sub->add_option("--max-triangles", command->max_triangles,
                  "Maximum number of triangles: decimates a closed mesh after any repair, and "
                  "measures the error")
      ->check(in_whole_range(solid::kFewestTriangles, solid::kMaxTriangles));
  add_file(
      *sub, "-o,--output", command->out,
      "File for the repaired or decimated mesh: " + solid::format_endings(solid::FormatUse::write) +
          "; or - for a binary STL on standard output. Written even if nothing had to be changed; "
          "verdict and exit status are those of the "
          "result");
}

}  // namespace

void add_check_command(CLI::App& app, Console& console, int& exit) {
  auto command = std::make_shared<CheckCommand>();
  CLI::App* sub =
      app.add_subcommand("check", "Check a pot or a mesh, and report each fault with its place");
  add_file(*sub, "file", command->file,
           solid::format_endings(solid::FormatUse::read, ", ") +
               ", .pot.json or .pot.cbor; or - for standard input")
      ->required();
  add_demands(sub, command);
  add_repair_options(sub, command);
  add_output_options(sub, command);
  sub->footer(
      "\nExamples:\n"
      "  claystack throw samples/bowl.scene.json -o bowl.pot.json\n"
      "  claystack check bowl.pot.json --min-wall 3 --json\n"
      "  claystack export bowl.pot.json bowl.stl bowl.obj --certificate\n"
      "  claystack check bowl.stl --certificate bowl.stl.certificate.json\n"
      "  claystack check bowl.stl --accept prints\n"
      "  claystack check bowl.stl --repair --dry-run\n"
      "  claystack check bowl.stl --repair -o repaired.stl\n"
      "  claystack check bowl.obj --repair --max-triangles 10000 -o small.stl --min-wall 2");
  sub->callback([command, &console, &exit] { exit = check(*command, console); });
}

}  // namespace clay::cli
