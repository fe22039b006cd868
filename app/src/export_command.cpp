#include "commands.hpp"
#include "export_report.hpp"
#include "file_on_disk.hpp"
#include "pot_copy.hpp"
#include "wall_demand.hpp"

#include "claystack/engine/atomic_file.hpp"
#include "claystack/engine/pot_file.hpp"
#include "claystack/engine/rounded_pot.hpp"
#include "claystack/engine/stack_measures.hpp"
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

/// What is asked for: meshes go through the job, drawings and pots straight from the pot.
struct Request {
  std::string path;
  std::optional<MeshFormat> mesh;
  std::unique_ptr<FileOnDisk> file;
  std::unique_ptr<FileOnDisk> certificate;  ///< of a mesh, where asked for

  [[nodiscard]] bool is_mesh() const noexcept { return mesh.has_value(); }
};

Result<std::vector<Request>> requests_of(const ExportCommand& command) {
  std::vector<Request> requests;
  for (const std::string& path : command.outputs) {
    Request request{path, std::nullopt, nullptr, nullptr};
    if (!path.ends_with(".svg") && !pot_encoding_of(path)) {
      const auto format = solid::mesh_format_of(path);
      if (!format)
        return failure(ErrorKind::bad_input,
                       format.error().message +
                           "; or .svg for the section, .pot.json or .pot.cbor for the pot");
      request.mesh =
          *format == MeshFormat::stl_binary && command.ascii ? MeshFormat::stl_ascii : *format;
    }
    requests.push_back(std::move(request));
  }
  return requests;
}

/// Options that speak of files which nobody asked for.
Result<void> check_options(const ExportCommand& command, const std::vector<Request>& requests) {
  const auto idle = [](std::string_view option, std::string_view kind) {
    return failure(ErrorKind::bad_input, std::string(option)
                                             .append(": expected a ")
                                             .append(kind)
                                             .append(" among the files to write, found none"));
  };
  if (command.precision_mm && std::ranges::none_of(requests, [](const Request& request) {
        return pot_encoding_of(request.path).has_value();
      }))
    return idle("--precision", "pot");
  if (command.certificate && std::ranges::none_of(requests, &Request::is_mesh))
    return idle("--certificate", "mesh");
  return {};
}

std::string certificate_path(const std::string& file) { return file + ".certificate.json"; }

Result<void> open(std::unique_ptr<FileOnDisk>& file, const std::string& path) {
  return AtomicFile::create(path).map(
      [&](AtomicFile created) { file = std::make_unique<FileOnDisk>(std::move(created)); });
}

/// Opens every file before any work: what can't be written is known at once.
Result<void> open_all(std::vector<Request>& requests, std::unique_ptr<FileOnDisk>& report,
                      const ExportCommand& command) {
  for (Request& request : requests) {
    if (auto done = open(request.file, request.path); !done) return done;
    if (!request.mesh || !command.certificate) continue;
    if (auto done = open(request.certificate, certificate_path(request.path)); !done) return done;
  }
  return command.report.empty() ? Result<void>() : open(report, command.report);
}

Result<void> write_text(FileOnDisk& file, const std::string& text) {
  return file.write(std::as_bytes(std::span(text)));
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
    if (auto written = write_text(*request.file, bytes); !written)
      return tl::make_unexpected(written.error());
    copies.push_back(describe_copy(*copied, *encoding, bytes.size()));
  }
  return copies;
}

/// All files are whole and verified before the first one gets its name.
Result<ExportReport> export_all(const Pot& pot, std::vector<Request>& requests,
                                const ExportCommand& command, const Console& console) {
  std::vector<solid::Output> outputs;
  for (const Request& request : requests)
    if (request.mesh) outputs.push_back({*request.mesh, request.file.get()});
  ExportReport report;
  if (!outputs.empty()) {
    Progress progress(console, "exporting", 0);
    auto done = solid::run_export(pot, outputs, command.options,
                                  [&](std::string_view stage) { progress.stage(stage); });
    if (!done) return failure(done.error().kind, command.pot + ": " + done.error().message);
    report = std::move(*done);
  }
  for (Request& request : requests)
    if (!request.mesh && !pot_encoding_of(request.path))
      if (auto drawn = write_text(*request.file, solid::section_svg(pot)); !drawn)
        return tl::make_unexpected(drawn.error());
  auto file = report.files.begin();
  for (Request& request : requests) {
    if (!request.mesh) continue;
    if (request.certificate)
      if (auto done =
              write_text(*request.certificate, solid::write_certificate(*file->certificate));
          !done)
        return tl::make_unexpected(done.error());
    ++file;
  }
  return report;
}

Result<void> publish_all(std::vector<Request>& requests) {
  for (Request& request : requests) {
    if (auto done = request.file->commit(); !done) return done;
    if (!request.certificate) continue;
    if (auto done = request.certificate->commit(); !done) return done;
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
  if (auto options = check_options(command, *requests); !options)
    return tl::make_unexpected(options.error());
  const auto pot = read_pot(command);
  if (!pot) return tl::make_unexpected(pot.error());
  command.options.smoothing = smoothing_of(command.smooth);
  command.options.min_wall_mm = least_wall(command, pot->stack);
  command.options.full_verification = command.verify == "full";
  command.options.name = std::filesystem::path(command.pot).stem().stem().string();
  std::unique_ptr<FileOnDisk> report_file;
  if (auto done = open_all(*requests, report_file, command); !done)
    return tl::make_unexpected(done.error());

  const auto copies = write_copies(*pot, *requests, command);
  if (!copies) return tl::make_unexpected(copies.error());
  auto report = export_all(*pot, *requests, command, console);
  if (!report) return tl::make_unexpected(report.error());
  const auto begin = std::chrono::steady_clock::now();
  if (auto done = publish_all(*requests); !done) return tl::make_unexpected(done.error());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  report->stages.push_back({"publish", seconds.count()});

  const auto demand = command.walls.for_size(2.0 * report->diameter_mm + report->height_mm);
  const Json json = export_json(*report, *copies, command.outputs, demand);
  if (console.json) console.print(json);
  tell_export(console, *report, *copies, command.outputs);
  if (report_file)
    if (auto done =
            write_text(*report_file, pretty(json)).and_then([&] { return report_file->commit(); });
        !done)
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
                  "Files to write: .stl, .obj, .drc, .svg for the section, .pot.json or .pot.cbor")
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
