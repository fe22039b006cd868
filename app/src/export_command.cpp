#include "commands.hpp"
#include "export_files.hpp"
#include "export_report.hpp"
#include "wall_table.hpp"

#include "claystack/engine/atomic_file.hpp"
#include "claystack/engine/pot_file.hpp"
#include "claystack/engine/stack_measures.hpp"
#include "claystack/export/export_job.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

namespace clay::app {
namespace {

using solid::ExportReport;

/// Through the job, where a mesh or the walls are asked for.
Result<ExportReport> run_job(const Pot& pot, std::vector<Request>& requests,
                             const ExportCommand& command, const Console& console) {
  solid::ExportOptions options = command.options;
  std::vector<solid::Output> outputs;
  for (const Request& request : requests)
    if (request.mesh) outputs.push_back({*request.mesh, request.file.get()});
  const bool walls = std::ranges::any_of(command.outputs, is_wall_table);
  if (walls) options.wall_spacing_mm = kWallSpacingMm;
  if (outputs.empty() && !walls) return ExportReport{};
  Progress progress(console, "exporting", 0);
  auto report = solid::run_export(pot, outputs, options,
                                  [&](std::string_view stage) { progress.stage(stage); });
  if (!report) return failure(report.error().kind, command.pot + ": " + report.error().message);
  return report;
}

solid::Smoothing smoothing_of(const std::string& name) {
  for (const auto mode : {solid::Smoothing::fair, solid::Smoothing::exact})
    if (solid::name_of(mode) == name) return mode;
  return solid::Smoothing::none;
}

/// What smoothing must not go below, where the user or the process says.
std::optional<double> least_wall(const ExportCommand& command, const ClayStack& stack) {
  const auto demand = command.walls.for_size(4.0 * largest_radius_mm(stack) + stack.height_mm());
  return demand ? std::optional(demand->min_wall_mm) : std::nullopt;
}

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

/// All files are whole and verified before the first one gets its name.
Result<ExportReport> write_and_publish(const Pot& pot, std::vector<Request>& requests,
                                       const ExportCommand& command, const Console& console) {
  auto report = run_job(pot, requests, command, console);
  if (!report) return report;
  if (auto done = write_companions(pot, *report, requests); !done)
    return tl::make_unexpected(done.error());
  const auto begin = std::chrono::steady_clock::now();
  if (auto done = publish_all(requests); !done) return tl::make_unexpected(done.error());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  report->stages.push_back({"publish", seconds.count()});
  return report;
}

/// Exit status: done, or done with a wall below what was asked for.
Result<int> export_pot(ExportCommand& command, const Console& console) {
  if (auto loaded = command.walls.load(); !loaded) return tl::make_unexpected(loaded.error());
  auto requests = requests_of(command);
  if (!requests) return tl::make_unexpected(requests.error());
  const auto pot = read_pot(command);
  if (!pot) return tl::make_unexpected(pot.error());
  command.options.smoothing = smoothing_of(command.smooth);
  command.options.min_wall_mm = least_wall(command, pot->stack);
  command.options.full_verification = command.verify == "full";
  command.options.name = std::filesystem::path(command.pot).stem().stem().string();
  if (auto done = open_all(*requests, command); !done) return tl::make_unexpected(done.error());
  auto report_file = open_file(command.report);
  if (!report_file) return tl::make_unexpected(report_file.error());

  const auto copies = write_copies(*pot, *requests, command);
  if (!copies) return tl::make_unexpected(copies.error());
  const auto report = write_and_publish(*pot, *requests, command, console);
  if (!report) return tl::make_unexpected(report.error());

  const auto demand = command.walls.for_size(2.0 * report->diameter_mm + report->height_mm);
  const Json json = export_json(*report, *copies, command.outputs, demand);
  if (console.json) console.print(json);
  tell_export(console, *report, *copies, command.outputs);
  if (FileOnDisk* const file = report_file->get())
    if (auto done = write_text(*file, pretty(json)).and_then([&] { return file->commit(); }); !done)
      return tl::make_unexpected(done.error());
  return tell_thin_wall(console, *report, demand) ? kUnsound : kDone;
}

}  // namespace

void add_export_command(CLI::App& app, Console& console, int& exit) {
  auto command = std::make_shared<ExportCommand>();
  CLI::App* sub =
      app.add_subcommand("export", "Turn a pot into a solid that prints, proved and checked");
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
                  "Radius that rounds both edges of the lip [mm]")
      ->check(in_range(0.0, 1e3));
  sub->add_option("--segments", command->options.segments,
                  "Steps around the axis (default: as the tolerance asks)")
      ->check(CLI::Range(3, 1 << 20));
  sub->add_option("--max-triangles", command->options.max_triangles,
                  "Coarser than the tolerance where that needs more triangles")
      ->check(CLI::Range(8, 20'000'000));
  sub->add_option("--drain", command->options.drain_mm,
                  "Diameter of a hole along the axis that opens closed cavities [mm]")
      ->check(in_range(1e-3, 1e4));
  command->walls.add_to(*sub);
  sub->add_flag("--measure-left-out", command->options.measure_left_out,
                "Do what was left out after all, and tell the time that leaving it out saved");
  sub->add_option("--report", command->report, "Write what --json prints to this file");
  sub->add_option("--precision", command->precision_mm,
                  "Round the radii of pots that are written, meshes keep the exact ones [mm]")
      ->check(in_range(1e-5, 1.0));
  sub->add_flag("--certificate", command->certificate,
                "Write OUT.certificate.json beside each mesh, for claystack check --certificate");
  sub->add_option("--verify", command->verify,
                  "margins: prove the rounding, read the file again; full: also check the file "
                  "as a stranger's, exact self-intersection test included")
      ->check(CLI::IsMember({"margins", "full"}))
      ->capture_default_str();
  sub->add_flag("--ascii", command->ascii, "Write .stl as text");
  sub->add_flag("--normals", command->options.normals, "Write .obj with normals, for shading");
  sub->add_flag("--pieces", command->options.allow_pieces,
                "Allow pieces that do not touch, all in one file");
  sub->footer(
      "\nExamples:\n  claystack export bowl.pot.json bowl.stl bowl.obj bowl.drc bowl.svg\n"
      "  claystack export bowl.pot.json bowl.stl --tolerance 0.005 --process stoneware\n"
      "  claystack export bowl.pot.json bowl.drc --certificate --report bowl.report.json\n"
      "  claystack export bowl.pot.json bowl.pot.cbor --precision 0.001");
  sub->callback([command, &console, &exit] {
    const auto done = export_pot(*command, console);
    if (!done && console.json) console.print({{"error", done.error().message}});
    exit = done ? *done : report(done.error());
  });
}

}  // namespace clay::app
