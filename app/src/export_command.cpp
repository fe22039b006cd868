#include "commands.hpp"
#include "export_report.hpp"
#include "file_on_disk.hpp"
#include "pot_copy.hpp"
#include "wall_demand.hpp"
#include "wall_table.hpp"

#include "claystack/engine/atomic_file.hpp"
#include "claystack/engine/pot_file.hpp"
#include "claystack/engine/rounded_pot.hpp"
#include "claystack/export/export_job.hpp"
#include "claystack/export/section_svg.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

namespace clay::app {
namespace {

using solid::ExportReport;
using solid::MeshFormat;

struct ExportCommand {
  std::string pot;
  std::vector<std::string> outputs;
  solid::ExportOptions options;
  std::string smooth = "fair";
  std::string verify = "margins";
  std::string report;
  WallDemands walls;
  std::optional<double> precision_mm;
  bool ascii = false;
  bool certificate = false;
};

/// What is asked for: meshes and walls go through the job, drawings and pots straight from the pot.
struct Request {
  std::string path;
  std::optional<MeshFormat> mesh;
  std::unique_ptr<FileOnDisk> file;
};

Result<std::vector<Request>> requests_of(const ExportCommand& command) {
  std::vector<Request> requests;
  for (const std::string& path : command.outputs) {
    Request request{path, std::nullopt, nullptr};
    if (!path.ends_with(".svg") && !is_wall_table(path) && !pot_encoding_of(path)) {
      const auto format = solid::mesh_format_of(path);
      if (!format)
        return failure(
            ErrorKind::bad_input,
            format.error().message +
                "; or .svg for the section, .csv for its walls, .pot.json or .pot.cbor for "
                "the pot");
      request.mesh =
          *format == MeshFormat::stl_binary && command.ascii ? MeshFormat::stl_ascii : *format;
    }
    requests.push_back(std::move(request));
  }
  return requests;
}

/// Options that would do nothing for the files asked for.
Result<void> check_usage(const ExportCommand& command, const std::vector<Request>& requests) {
  const auto refuse_without = [&](bool option, std::string_view name, std::string_view what,
                                  auto is) -> Result<void> {
    if (!option || std::ranges::any_of(requests, is)) return {};
    return failure(ErrorKind::bad_input, fmt::format("{}: expected {} among the files to write, "
                                                     "found none",
                                                     name, what));
  };
  const auto format = [](MeshFormat wanted) {
    return [wanted](const Request& request) { return request.mesh == wanted; };
  };
  return refuse_without(command.precision_mm.has_value(), "--precision", "a pot",
                        [](const Request& r) { return pot_encoding_of(r.path).has_value(); })
      .and_then([&] {
        return refuse_without(command.ascii, "--ascii", "an .stl", format(MeshFormat::stl_ascii));
      })
      .and_then([&] {
        return refuse_without(command.options.normals, "--normals", "an .obj",
                              format(MeshFormat::obj));
      })
      .and_then([&] {
        return refuse_without(command.certificate, "--certificate", "a mesh",
                              [](const Request& r) { return r.mesh.has_value(); });
      });
}

std::string certificate_path(const std::string& file) { return file + ".certificate.json"; }

/// Opens every file before any work: what can't be written is known at once.
Result<void> open_all(std::vector<Request>& requests) {
  for (Request& request : requests) {
    auto file = AtomicFile::create(request.path);
    if (!file) return tl::make_unexpected(file.error());
    request.file = std::make_unique<FileOnDisk>(std::move(*file));
  }
  return {};
}

Result<void> write_text(const std::string& text, Request& request) {
  return request.file->write(std::as_bytes(std::span(text)));
}

/// Copies of the pot, as exact as asked for.
Result<std::vector<PotCopy>> write_copies(const Pot& pot, std::vector<Request>& requests,
                                          const ExportCommand& command) {
  const auto copied = command.precision_mm ? rounded_pot(pot, *command.precision_mm) : pot;
  if (!copied) return failure(copied.error().kind, command.pot + ": " + copied.error().message);
  std::vector<PotCopy> copies;
  for (Request& request : requests) {
    const auto encoding = pot_encoding_of(request.path);
    if (!encoding) continue;
    const std::string bytes = write_pot(*copied, *encoding);
    if (auto written = request.file->write(std::as_bytes(std::span(bytes))); !written)
      return tl::make_unexpected(written.error());
    copies.push_back(describe_copy(*copied, *encoding, bytes.size()));
  }
  return copies;
}

/// All files are whole and verified before the first one gets its name.
Result<ExportReport> export_all(const Pot& pot, std::vector<Request>& requests,
                                const ExportCommand& command, const Console& console) {
  solid::ExportOptions options = command.options;
  std::vector<solid::Output> outputs;
  for (const Request& request : requests)
    if (request.mesh) outputs.push_back({*request.mesh, request.file.get()});
  ExportReport report;
  const bool walls = std::ranges::any_of(command.outputs, is_wall_table);
  if (walls) options.wall_spacing_mm = kWallSpacingMm;
  if (!outputs.empty() || walls) {
    Progress progress(console, "exporting", 0);
    auto done = solid::run_export(pot, outputs, options,
                                  [&](std::string_view stage) { progress.stage(stage); });
    if (!done) return failure(done.error().kind, command.pot + ": " + done.error().message);
    report = std::move(*done);
  }
  for (Request& request : requests) {
    if (request.mesh || pot_encoding_of(request.path)) continue;
    const std::string text =
        is_wall_table(request.path) ? wall_table(report.wall_field) : solid::section_svg(pot);
    if (auto written = write_text(text, request); !written)
      return tl::make_unexpected(written.error());
  }
  return report;
}

Result<void> publish_all(std::vector<Request>& requests, const ExportCommand& command,
                         const ExportReport& report) {
  auto file = report.files.begin();
  for (Request& request : requests) {
    if (auto done = request.file->commit(); !done) return done;
    if (!request.mesh) continue;
    if (command.certificate)
      if (auto done =
              publish(certificate_path(request.path), solid::write_certificate(*file->certificate));
          !done)
        return done;
    ++file;
  }
  return {};
}

solid::Smoothing smoothing_of(const std::string& name) {
  for (const auto mode : {solid::Smoothing::fair, solid::Smoothing::exact})
    if (solid::name_of(mode) == name) return mode;
  return solid::Smoothing::none;
}

/// What smoothing must not go below, where the user or the process says.
std::optional<double> least_wall(const ExportCommand& command, const ClayStack& stack) {
  double radius = 0.0;
  for (const Ring& ring : stack.rings()) radius = std::max(radius, ring.outer_mm());
  const auto demand = command.walls.for_size(4.0 * radius + stack.height_mm());
  return demand ? std::optional(demand->min_wall_mm) : std::nullopt;
}

/// Exit status: done, or done with a wall below what was asked for.
Result<int> export_pot(ExportCommand& command, const Console& console) {
  std::vector<std::string> outputs = command.outputs;
  outputs.push_back(command.report);
  if (command.certificate)
    for (const std::string& path : command.outputs) outputs.push_back(certificate_path(path));
  if (auto names = check_distinct(outputs, {command.pot}); !names)
    return tl::make_unexpected(names.error());
  if (auto loaded = command.walls.load(); !loaded) return tl::make_unexpected(loaded.error());
  auto requests = requests_of(command);
  if (!requests) return tl::make_unexpected(requests.error());
  if (auto usage = check_usage(command, *requests); !usage)
    return tl::make_unexpected(usage.error());
  const auto pot = read_file(command.pot).and_then([&](const std::string& bytes) {
    return parse_pot(bytes, command.pot);
  });
  if (!pot) return tl::make_unexpected(pot.error());
  if (command.certificate && pot->collapse)
    return failure(
        ErrorKind::bad_input,
        command.pot + ": --certificate: expected a pot that stands, found a collapsed one");
  command.options.smoothing = smoothing_of(command.smooth);
  command.options.min_wall_mm = least_wall(command, pot->stack);
  command.options.full_verification = command.verify == "full";
  command.options.name = std::filesystem::path(command.pot).stem().stem().string();
  if (auto opened = open_all(*requests); !opened) return tl::make_unexpected(opened.error());

  const auto copies = write_copies(*pot, *requests, command);
  if (!copies) return tl::make_unexpected(copies.error());
  auto report = export_all(*pot, *requests, command, console);
  if (!report) return tl::make_unexpected(report.error());
  const auto begin = std::chrono::steady_clock::now();
  if (auto done = publish_all(*requests, command, *report); !done)
    return tl::make_unexpected(done.error());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  report->stages.push_back({"publish", seconds.count()});

  const auto demand = command.walls.for_size(2.0 * report->diameter_mm + report->height_mm);
  const Json json = export_json(*report, *copies, command.outputs, demand);
  if (console.json) console.print(json);
  tell_export(console, *report, *copies, command.outputs);
  if (!command.report.empty())
    if (auto done = publish(command.report, json.dump(2) + "\n"); !done)
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
    exit = done ? *done : report(done.error());
  });
}

}  // namespace clay::app
