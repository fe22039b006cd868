#include "app/studio/export_choices.hpp"

#include "app/cli/memory_room.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/report_file.hpp"
#include "app/studio/readings/pot_form.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

namespace clay::studio {
namespace {

constexpr std::string_view kReportEnding = ".report.html";

std::vector<cli::PotCopy> copies_in(const solid::ExportRequest& request, const Pot& pot) {
  std::vector<cli::PotCopy> copies;
  for (const solid::FileRequest& file : request.files)
    if (const auto encoding = cli::pot_encoding_of(file.path))
      copies.push_back(cli::describe_copy(pot, *encoding, file.bytes.size()));
  return copies;
}

/// The process and the minimum wall, which files without a solid do not need.
Result<void> set_walls(const ExportChoices& choices, solid::ExportOptions& options) {
  if (choices.min_wall_mm > 0.0) options.walls.min_wall_mm = choices.min_wall_mm;
  if (choices.process.empty()) return {};
  return solid::read_process(choices.process).map([&](solid::ProcessLimits process) {
    options.walls.process = std::move(process);
  });
}

void set_finish(const ExportChoices& choices, solid::ExportOptions& options) {
  if (choices.foot_width_mm > 0.0)
    options.finish.foot = solid::FootRing{choices.foot_width_mm, choices.foot_depth_mm, {}};
  options.finish.floor_fillet_mm = choices.floor_fillet_mm;
  options.finish.glaze_mm = choices.glaze_mm * solid::enlargement(options.shrinkage);
  if (choices.drain_mm > 0.0) options.drain_mm = choices.drain_mm;
  if (choices.lip_fillet_mm > 0.0) options.lip_fillet_mm = choices.lip_fillet_mm;
}

Result<solid::ExportOptions> options_of(const ExportChoices& choices, const Pot& pot) {
  solid::ExportOptions options;
  options.tolerance_mm = choices.tolerance_mm;
  options.smoothing = choices.smoothing;
  if (choices.smoothing == solid::Smoothing::fair && !pot.collapse)
    options.smooth_length_mm = choices.smooth_length_mm;
  options.name = options.source = choices.name;
  options.material = choices.material;
  const bool solid = !choices.meshes.empty() || choices.step;
  if (solid || choices.section || choices.dxf || choices.pdf || choices.report) {
    options.shrinkage = 0.01 * choices.shrinkage_percent;
    if (!pot.collapse) set_finish(choices, options);
  }
  if (!solid && !choices.report) return options;
  return set_walls(choices, options).map([&] { return std::move(options); });
}

solid::Goal goal_of(const ExportChoices& choices) {
  solid::Goal goal;
  goal.fired = choices.shrinkage_percent > 0.0;
  if (choices.size == ExportSize::capacity) goal.holds_ml = choices.holds_ml;
  if (choices.size == ExportSize::weight) goal.weighs_g = choices.weighs_g;
  if (choices.size == ExportSize::height) goal.height_mm = choices.height_mm;
  if (choices.size == ExportSize::diameter) goal.diameter_mm = choices.diameter_mm;
  return goal;
}

Result<void> add_files(const ExportChoices& choices, const Pot& pot,
                       solid::ExportRequest& request) {
  for (const std::string& path : paths_of(choices)) {
    if (path.ends_with(kReportEnding)) {
      request.report_path = path;
      continue;
    }
    if (const auto encoding = cli::pot_encoding_of(path)) {
      if (auto room = cli::expect_room_to_write(pot.stack.size(), *encoding, path); !room)
        return room;
      request.files.push_back(
          {.path = path, .kind = solid::FileKind::given, .bytes = write_pot(pot, *encoding)});
      continue;
    }
    auto file = solid::file_request(path);
    if (!file) return tl::make_unexpected(file.error());
    request.files.push_back(std::move(*file));
  }
  return {};
}

/// The view keeps the pot as it is on the wheel; the solid in the file is larger, and may have
/// another size.
glm::dvec2 on_pot(const solid::ProfilePoint& place, double shrinkage,
                  const std::optional<solid::MetGoal>& met) {
  const glm::dvec2 scaled = glm::dvec2(place.rho, place.y) / solid::enlargement(shrinkage);
  return met ? scaled / glm::dvec2(met->radius_factor, met->height_factor) : scaled;
}

/// To the brim, fired and glazed if it shrinks [ml].
double capacity_of(const std::optional<solid::MakerNumbers>& numbers) {
  if (!numbers) return 0.0;
  return (numbers->fired && numbers->glazed ? *numbers->glazed : numbers->in_use()).capacity_ml;
}

ExportFigures figures_of(const solid::ExportReport& report, const solid::ExportOptions& options,
                         const ClayStack& thrown) {
  const double shrinkage = report.prepared.shrinkage;
  const auto place_of = [&](const solid::ProfilePoint& place) {
    return on_pot(place, shrinkage, options.met_goal);
  };
  const solid::Wall& thinnest = report.walls.thinnest;
  // The width is that of the section, as in the table of the command; a mesh has its corners
  // farther out.
  ExportFigures figures{
      .has_solid = report.has_solid(),
      .triangles = report.size.triangles,
      .meshes = {},
      .diameter_mm = report.maker ? report.maker->thrown.size.diameter_mm : report.size.diameter_mm,
      .height_mm = report.size.height_mm,
      .shrinkage = shrinkage,
      .capacity_ml = capacity_of(report.maker),
      .weight_g = report.maker ? report.maker->in_use().weight_g : 0.0,
      .fallen = report.collapsed.has_value(),
      .thinnest_mm = report.thinnest_mm(),
      .thinnest_at_mm = thinnest.from.y,
      .thinnest_in_floor =
          in_floor(form_of(thrown), place_of(thinnest.from), place_of(thinnest.to)),
      .closed_cavity = false,
      .faired_mm = report.section.smoothed.fairing.length_mm,
      .moved_mm = report.section.smoothed.fairing.moved_mm,
      .moved_at_mm = report.section.smoothed.fairing.moved_at_mm,
      .problems = {},
      .failed = 0,
      .marks = {}};
  for (const solid::FileReport& file : report.files)
    if (file.kind == solid::FileKind::mesh) figures.meshes.push_back({file.format, file.bytes});
  std::vector<solid::Problem> problems = solid::problems_of(report);
  const auto warnings = std::stable_partition(problems.begin(), problems.end(),
                                              [](const solid::Problem& one) { return one.fails; });
  figures.failed = static_cast<std::size_t>(warnings - problems.begin());
  for (const solid::Problem& problem : problems) {
    figures.problems.push_back(problem.text);
    figures.closed_cavity |= problem.kind == solid::ProblemKind::cavity;
    if (problem.at) figures.marks.push_back({place_of(*problem.at), problem.text});
  }
  return figures;
}

}  // namespace

std::vector<std::string> paths_of(const ExportChoices& choices) {
  std::vector<std::string> paths;
  const auto add = [&](std::string_view ending) {
    const std::filesystem::path name = choices.name + std::string(ending);
    paths.push_back((std::filesystem::path(choices.folder) / name).string());
  };
  for (const solid::MeshFormat format : choices.meshes) add(solid::facts_of(format).ending);
  if (choices.step) add(".step");
  if (choices.section) add(".svg");
  if (choices.dxf) add(".dxf");
  if (choices.pdf) add(".pdf");
  if (choices.pot) add(".pot.json");
  if (choices.report) add(kReportEnding);
  return paths;
}

Result<ExportJob> job_of(const ExportChoices& choices, const Pot& pot,
                         const std::function<bool()>& cancelled) {
  auto options = options_of(choices, pot);
  if (!options) return tl::make_unexpected(options.error());
  options->cancelled = cancelled;
  options->expect_memory = [](std::uint64_t bytes) {
    return cli::expect_room("writing meshes", bytes);
  };
  ExportJob job{pot, {}};
  job.request.options = std::move(*options);
  if (choices.size != ExportSize::as_thrown && !pot.collapse) {
    auto scaled = solid::scaled_to(pot, goal_of(choices), job.request.options);
    if (!scaled) return tl::make_unexpected(scaled.error());
    job.pot = std::move(scaled->pot);
    job.request.options.met_goal = scaled->met;
  }
  return add_files(choices, job.pot, job.request).map([&] { return std::move(job); });
}

std::vector<std::string> standing_files(const ExportChoices& choices) {
  std::vector<std::string> paths = paths_of(choices);
  std::erase_if(paths, [](const std::string& path) {
    std::error_code ignored;
    return !std::filesystem::exists(path, ignored);
  });
  return paths;
}

std::string failed_text(std::size_t count) { return counted(count, "limit") + " failed"; }

Result<ExportFigures> run_export(const Pot& pot, const ExportChoices& choices, ExportKind kind,
                                 cli::Thumbnail& thumbnail, const std::function<bool()>& cancelled,
                                 const std::function<void(std::string_view)>& show_stage) {
  return job_of(choices, pot, cancelled).and_then([&](ExportJob job) {
    cli::Thumbnail of_scaled;
    // Another thread may draw the thumbnail after this job has ended, so it is given the caller's
    // pot.
    if (job.request.options.met_goal)
      cli::pack_pot(job.pot, job.request, of_scaled);
    else
      cli::pack_pot(pot, job.request, thumbnail);
    if (kind == ExportKind::files)
      cli::set_report(job.pot, job.request, copies_in(job.request, job.pot));
    const auto report = kind == ExportKind::files
                            ? solid::export_files(job.pot, job.request, show_stage)
                            : solid::preview_export(job.pot, job.request, show_stage);
    return report.map([&](const solid::ExportReport& done) {
      return figures_of(done, job.request.options, pot.stack);
    });
  });
}

}  // namespace clay::studio
