#include "app/cli/commands.hpp"
#include "app/cli/export_report.hpp"
#include "app/cli/export_run.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

Result<Pot> read_pot(const ExportCommand& command) {
  auto pot = read_file(command.pot).and_then([&](const std::string& bytes) {
    return parse_pot(bytes, command.pot);
  });
  if (pot && command.certificate && pot->collapse)
    return failure(
        ErrorKind::bad_input,
        command.pot + ": --certificate: expected a pot that stands, found a collapsed one");
  return pot;
}

/// Exit status: done, or done with a wall below what was asked for.
Result<int> export_pot(ExportCommand& command, const Console& console) {
  const auto pot = read_pot(command);
  if (!pot) return tl::make_unexpected(pot.error());
  command.options.smoothing = smoothing_of(command.smooth);
  command.options.full_verification = command.verify == "full";
  command.options.name = std::filesystem::path(command.pot).stem().stem().string();
  const auto done = [&] {
    Progress progress(console, "exporting", 0);
    return export_files(*pot, command, [&](std::string_view stage) { progress.stage(stage); });
  }();
  if (!done) return tl::make_unexpected(done.error());

  const auto& [report, copies, demand] = *done;
  if (console.json) console.print(export_json(report, copies, command.outputs, demand));
  tell_export(console, report, copies, command.outputs);
  return tell_thin_wall(console, report, demand) ? kUnsound : kDone;
}

}  // namespace

void add_export_command(CLI::App& app, Console& console, int& exit) {
  auto command = std::make_shared<ExportCommand>();
  CLI::App* sub = app.add_subcommand(
      "export", "Write a pot as a printable solid, with a proof that it is sound");
  sub->add_option("pot", command->pot, "NAME.pot.json or .pot.cbor, or - for standard input")
      ->required();
  sub->add_option("out", command->outputs,
                  "Files to write: .stl, .obj, .drc; .svg for the section, .csv for its walls; "
                  ".pot.json or .pot.cbor for the pot")
      ->required();
  sub->add_option("--tolerance", command->options.tolerance_mm,
                  "Largest chordal error, and vertex error in .drc [mm]")
      ->check(in_range(1e-5, 10.0))
      ->capture_default_str();
  sub->add_option("--smooth", command->smooth,
                  "fair: walls as they were meant; exact: every ring keeps its volume; none: the "
                  "steps of the rings")
      ->check(CLI::IsMember({"fair", "exact", "none"}))
      ->capture_default_str();
  sub->add_option("--lip-fillet", command->options.lip_fillet_mm,
                  "Radius of the fillet at both edges of the lip [mm]")
      ->check(in_range(0.0, 1e3));
  sub->add_option("--segments", command->options.segments,
                  "Facets around the axis (default: chosen from the tolerance)")
      ->check(CLI::Range(3, 1 << 20));
  sub->add_option("--max-triangles", command->options.max_triangles,
                  "Most triangles: facets may be coarser than the tolerance")
      ->check(CLI::Range(8, 20'000'000));
  sub->add_option("--drain", command->options.drain_mm,
                  "Diameter of a hole along the axis that opens closed cavities [mm]")
      ->check(in_range(1e-3, 1e4));
  sub->add_option_function<std::string>(
         "--shrinkage",
         [command](const std::string& text) {
           command->options.shrinkage = shrinkage_of(text).value_or(0.0);
         },
         "Part of each length lost in drying and firing, as 12%: files are so much larger that the "
         "piece comes out in the pot's own size")
      ->check([](const std::string& text) {
        const auto parsed = shrinkage_of(text);
        return parsed ? std::string() : parsed.error().message;
      });
  command->walls.add_to(*sub);
  sub->add_flag("--measure-left-out", command->options.measure_left_out,
                "Run the skipped stages too, and report the time that skipping saves");
  sub->add_option("--report", command->report, "File for the report that --json prints");
  sub->add_option("--precision", command->precision_mm,
                  "Rounding of radii in pot files; meshes keep the exact radii [mm]")
      ->check(in_range(1e-5, 1.0));
  sub->add_flag("--certificate", command->certificate,
                "Write OUT.certificate.json beside each mesh, for claystack check --certificate");
  sub->add_option("--verify", command->verify,
                  "margins: prove the rounding, read the file again; full: also check the file "
                  "like any foreign mesh, with the exact self-intersection test")
      ->check(CLI::IsMember({"margins", "full"}))
      ->capture_default_str();
  sub->add_flag("--ascii", command->ascii, "Write .stl as text");
  sub->add_flag("--normals", command->options.normals, "Write .obj with normals, for shading");
  sub->add_flag("--pieces", command->options.allow_pieces,
                "Accept a pot of several pieces that do not touch");
  sub->footer(
      "\nExamples:\n  claystack export bowl.pot.json bowl.stl bowl.obj bowl.drc bowl.svg\n"
      "  claystack export bowl.pot.json bowl.stl --tolerance 0.005 --process stoneware\n"
      "  claystack export bowl.pot.json bowl.stl --process porcelain --shrinkage 12%\n"
      "  claystack export bowl.pot.json bowl.drc --certificate --report bowl.report.json\n"
      "  claystack export bowl.pot.json bowl.pot.cbor --precision 0.001");
  sub->callback([command, &console, &exit] {
    const auto done = export_pot(*command, console);
    if (!done && console.json) console.print({{"error", done.error().message}});
    exit = done ? *done : report(done.error());
  });
}

}  // namespace clay::cli
