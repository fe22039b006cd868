#include "app/cli/export_run.hpp"

#include "app/cli/export_report.hpp"
#include "app/cli/thin_walls.hpp"
#include "app/cli/wall_table.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/tick.hpp"
#include "claystack/export/job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

using solid::ExportReport;

/// What smoothing must not go below, where the user or the process says.
std::optional<double> least_wall(const ExportCommand& command, const ClayStack& stack) {
  const double size_sum_mm = 4.0 * largest_radius_mm(stack) + stack.height_mm();
  const auto demand =
      command.walls.for_size(size_sum_mm * solid::enlargement(command.options.shrinkage));
  return demand ? std::optional(demand->min_wall_mm) : std::nullopt;
}

/// Through the job, where a mesh or the walls are asked for.
Result<ExportReport> run_job(const Pot& pot, std::vector<Request>& requests,
                             const ExportCommand& command,
                             const std::function<void(std::string_view)>& progress) {
  solid::ExportOptions options = command.options;
  std::vector<solid::Output> outputs;
  for (const Request& request : requests)
    if (request.mesh) outputs.push_back({*request.mesh, request.file.get()});
  const bool walls = std::ranges::any_of(command.outputs, is_wall_table);
  if (walls) options.wall_spacing_mm = kWallSpacingMm;
  if (outputs.empty() && !walls) return ExportReport{};
  auto report = solid::run_export(pot, outputs, options, progress);
  if (!report) return failure(report.error().kind, command.pot + ": " + report.error().message);
  return report;
}

/// Beside the job, which looks to it itself.
Result<void> still_wanted(const ExportCommand& command) {
  const auto& cancelled = command.options.cancelled;
  if (!cancelled || !cancelled()) return {};
  return failure(ErrorKind::io, command.pot + ": export given up: cancelled");
}

/// The report is a file of the export like the others, and told of them before they have names.
Result<void> publish(std::vector<Request>& requests, FileOnDisk* report_file, ExportDone& done,
                     const ExportCommand& command) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<AtomicFile*> files = files_of(requests);
  for (AtomicFile* file : files)
    if (auto prepared = file->prepare(); !prepared) return prepared;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  done.report.stages.push_back({"publish", seconds.count()});
  if (report_file != nullptr) {
    const Json json = export_json(done.report, done.copies, command.outputs, done.demand);
    if (auto written = write_text(*report_file, pretty(json)); !written) return written;
    files.push_back(&report_file->file());
  }
  return commit_all(files);
}

}  // namespace

Result<ExportDone> export_files(const Pot& pot, ExportCommand& command,
                                const std::function<void(std::string_view)>& progress) {
  if (auto loaded = command.walls.load(); !loaded) return tl::make_unexpected(loaded.error());
  auto requests = requests_of(command);
  if (!requests) return tl::make_unexpected(requests.error());
  command.options.min_wall_mm = least_wall(command, pot.stack);
  if (auto done = open_all(*requests, command); !done) return tl::make_unexpected(done.error());
  auto report_file = open_file(command.report);
  if (!report_file) return tl::make_unexpected(report_file.error());
  auto copies = write_copies(pot, *requests, command);
  if (!copies) return tl::make_unexpected(copies.error());
  if (auto wanted = still_wanted(command); !wanted) return tl::make_unexpected(wanted.error());
  auto report = run_job(pot, *requests, command, progress);
  if (!report) return tl::make_unexpected(report.error());
  if (auto done = write_companions(pot, *report, *requests, command.options.shrinkage); !done)
    return tl::make_unexpected(done.error());
  if (auto wanted = still_wanted(command); !wanted) return tl::make_unexpected(wanted.error());
  const auto demand = demand_for(command.walls, *report);
  ExportDone done{std::move(*report), std::move(*copies), demand};
  return publish(*requests, report_file->get(), done, command).map([&] { return std::move(done); });
}

Result<ExportDone> rehearse_export(const Pot& pot, ExportCommand& command,
                                   const std::function<void(std::string_view)>& progress) {
  if (auto loaded = command.walls.load(); !loaded) return tl::make_unexpected(loaded.error());
  command.options.min_wall_mm = least_wall(command, pot.stack);
  std::vector<std::unique_ptr<solid::MemoryStore>> stores;
  std::vector<solid::Output> outputs;
  for (const std::string& path : command.outputs) {
    const auto format = solid::mesh_format_of(path);
    if (!format) continue;
    stores.push_back(std::make_unique<solid::MemoryStore>());
    outputs.push_back({*format, stores.back().get()});
  }
  return solid::run_export(pot, outputs, command.options, progress).map([&](ExportReport report) {
    const auto demand = demand_for(command.walls, report);
    return ExportDone{std::move(report), {}, demand};
  });
}

std::optional<std::string> thin_wall_of(const ExportReport& report,
                                        const std::optional<WallDemand>& demand) {
  if (!demand || report.files.empty()) return std::nullopt;
  const double thinnest = thinnest_mm(report);
  if (thinnest >= demand->min_wall_mm) return std::nullopt;
  const auto& certificate = report.files.front().certificate;
  return "thin wall: " + (certificate ? thin_wall_text(certificate->profile, thinnest, *demand)
                                      : wall_text(thinnest, *demand));
}

std::string text_of(const solid::Cavity& cavity) {
  return fmt::format("closed cavity from {:.1f} to {:.1f} mm ({:.1f} cm3): it needs a drain hole",
                     cavity.bottom_mm, cavity.top_mm, cavity.volume_mm3 / 1000.0);
}

std::vector<Problem> problems_of(const ExportDone& done) {
  const ExportReport& report = done.report;
  std::vector<Problem> problems;
  if (auto thin = thin_wall_of(report, done.demand)) {
    const auto& [thickness, from, to] = report.thinnest;
    const bool placed = !report.collapsed && thickness > 0.0;
    problems.push_back({std::move(*thin), placed ? std::optional(from) : std::nullopt});
  }
  for (const solid::PieceShape& shape : report.shapes)
    for (const solid::Cavity& cavity : shape.cavities)
      problems.push_back(
          {text_of(cavity), solid::ProfilePoint{0.0, 0.5 * (cavity.bottom_mm + cavity.top_mm)}});
  if (report.collapsed && report.collapsed->pieces > 1)
    problems.push_back(
        {fmt::format("the file holds {} bodies that do not touch", report.collapsed->pieces),
         std::nullopt});
  return problems;
}

std::optional<WallDemand> demand_for(const WallDemands& walls, const ExportReport& report) {
  return walls.for_size(2.0 * report.diameter_mm + report.height_mm);
}

double thinnest_mm(const ExportReport& report) {
  double thinnest = report.min_wall_mm;
  for (const solid::FileReport& file : report.files)
    if (file.certificate) thinnest = std::min(thinnest, file.certificate->wall_lower_mm);
  return thinnest;
}

solid::Smoothing smoothing_of(std::string_view name) {
  for (const auto mode : {solid::Smoothing::fair, solid::Smoothing::exact})
    if (solid::name_of(mode) == name) return mode;
  return solid::Smoothing::none;
}

Result<double> shrinkage_of(const std::string& text) {
  double percent = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, percent);
  const std::string_view rest(stop, static_cast<std::size_t>(end - stop));
  if (problem != std::errc() || rest != "%" ||
      !(percent >= 0.0 && percent <= 100.0 * solid::kMostShrinkage))
    return failure(ErrorKind::bad_input, fmt::format("expected 0% to {:g}%, found {}",
                                                     100.0 * solid::kMostShrinkage, text));
  return 0.01 * percent;
}

}  // namespace clay::cli
