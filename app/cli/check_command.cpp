#include "app/cli/check.hpp"
#include "app/cli/commands.hpp"
#include "core/text.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/export/repair.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

bool is_pot(std::string_view path) { return path.ends_with(".json") || path.ends_with(".cbor"); }

/// Checks combinations of options.
Result<void> check_usage(const CheckCommand& command) {
  if (command.dry_run && !command.changes_mesh())
    return failure(ErrorKind::bad_input, "--dry-run: expected --repair or --max-triangles with it");
  const solid::RepairOptions& repair = command.repair_options;
  if ((repair.weld_mm || repair.thicken_mm || repair.wrap_mm || repair.cap_openings) &&
      !command.repair)
    return failure(ErrorKind::bad_input,
                   "--weld, --cap, --thicken, --wrap: expected --repair with them");
  if (command.changes_mesh() == command.out.empty() && !command.dry_run)
    return failure(ErrorKind::bad_input,
                   command.changes_mesh()
                       ? "expected -o FILE for the result of --repair or --max-triangles, or "
                         "--dry-run"
                       : "-o: expected --repair or --max-triangles with it");
  if (command.changes_mesh() && !command.out.empty() && !is_pot(command.file))
    if (const auto format = solid::mesh_format_of(command.out, solid::FormatUse::write); !format)
      return tl::make_unexpected(format.error());
  if (command.changes_mesh() && !command.certificate.empty())
    return failure(ErrorKind::bad_input,
                   "--certificate: expected no --repair or --max-triangles, because it verifies "
                   "the unchanged file");
  return check_distinct({command.out}, {command.file, command.certificate});
}

Result<Verdict> check_file(const CheckCommand& command, const Console& console) {
  if (auto usage = check_usage(command); !usage) return tl::make_unexpected(usage.error());
  if (is_pot(command.file))
    return read_file(command.file).and_then([&](const std::string& bytes) {
      return check_pot(bytes, command);
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

std::string what_failed(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::unsound:
      return "not repaired";
    case ErrorKind::io:
      return "not read or written";
    case ErrorKind::bad_input:
    case ErrorKind::device:
      break;
  }
  return "unreadable";
}

int check(CheckCommand& command, const Console& console) {
  if (auto loaded = command.walls.load(); !loaded) return report(loaded.error());
  const auto verdict = check_file(command, console);
  if (!verdict) {
    const Error& error = verdict.error();
    return report(error,
                  verdict_json(command.file, unsound(what_failed(error.kind), error.message)));
  }
  if (console.json) print_json(verdict_json(command.file, *verdict));
  print_verdict(console, command.file, *verdict);
  return verdict->mesh.sound() ? kDone : kUnsound;
}

}  // namespace

void add_check_command(CLI::App& app, Console& console, int& exit) {
  auto command = std::make_shared<CheckCommand>();
  CLI::App* sub =
      app.add_subcommand("check", "Check a pot or a mesh, and report each fault with its place");
  sub->add_option("file", command->file,
                  solid::format_endings(solid::FormatUse::read, ", ") + ", .pot.json or .pot.cbor")
      ->required();
  command->walls.add_to(*sub);
  sub->add_option("--wall-samples", command->wall_samples,
                  "Number of rays that sample the walls of a mesh; they may "
                  "miss the thinnest place (pots are measured, not sampled)")
      ->check(CLI::Range(std::size_t{1}, solid::kMostWallSamples))
      ->capture_default_str();
  sub->add_option("--certificate", command->certificate,
                  "Certificate of the file, to be verified against its bytes");
  sub->add_flag("--repair", command->repair,
                "Repair the mesh until it is sound, and report what was repaired; where that is "
                "not possible, report the reason and write nothing");
  sub->add_option("--weld", command->repair_options.weld_mm,
                  "With --repair: width of the cracks that are welded [mm]; default: a quarter of "
                  "the shortest edge at a border, at most 1/1000 of the size of the mesh")
      ->check(CLI::Range(0.0, 1e6));
  sub->add_flag("--cap", command->repair_options.cap_openings,
                "With --repair: close wide openings by caps instead of refusing them");
  sub->add_option("--thicken", command->repair_options.thicken_mm,
                  "With --repair: thickness of the wall that a surface with a wide opening gets, "
                  "half on each side [mm]; default: such a surface is refused")
      ->check(CLI::Range(1e-3, 1e6));
  sub->add_option(
         "--wrap", command->repair_options.wrap_mm,
         "With --repair, if all else fails: replace the surface by a wrap at this distance "
         "around it [mm], which loses smaller details; default: such a mesh is refused")
      ->check(CLI::Range(1e-3, 1e6));
  sub->add_flag("--dry-run", command->dry_run, "Report the changes without writing a file");
  sub->add_option("--max-triangles", command->max_triangles,
                  "Maximum number of triangles: decimates a closed mesh after any repair, and "
                  "measures the error")
      ->check(CLI::Range(solid::kFewestTriangles, solid::kMaxTriangles));
  sub->add_option(
      "-o,--out", command->out,
      "File for the repaired or decimated mesh: " + solid::format_endings(solid::FormatUse::write) +
          ". Written even if nothing had to be changed; verdict and exit status are those of the "
          "result");
  sub->footer(
      "\nExamples:\n  claystack check bowl.stl --certificate bowl.stl.certificate.json\n"
      "  claystack check bowl.pot.json --min-wall 3 "
      "--json\n  claystack check found.stl --repair --dry-run\n"
      "  claystack check found.stl --repair -o repaired.stl\n"
      "  claystack check scan.obj --repair --max-triangles 100000 -o small.stl --min-wall 2");
  sub->callback([command, &console, &exit] { exit = check(*command, console); });
}

}  // namespace clay::cli
