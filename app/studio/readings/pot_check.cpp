#include "app/studio/readings/pot_check.hpp"

#include "app/render/wall_rows.hpp"
#include "app/studio/readings/clay_figures.hpp"
#include "app/studio/units.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/job.hpp"
#include "claystack/export/walls.hpp"
#include "core/colour_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace clay::studio {

namespace {

constexpr double kFinestSpacingMm = 0.05;

Result<std::optional<solid::ProcessLimits>> limits_of(const std::string& process) {
  if (process.empty()) return std::nullopt;
  return solid::read_process(process).map(
      [](solid::ProcessLimits&& limits) { return std::optional(std::move(limits)); });
}

const char* kept_text(solid::KeptFor reason) {
  switch (reason) {
    case solid::KeptFor::wall:
      return "steps kept: smoothing would make the wall too thin";
    case solid::KeptFor::overshoot:
      return "steps kept: smoothing would overshoot a radius";
    case solid::KeptFor::volume:
      return "steps kept: smoothing would move the walls to keep the volume";
    case solid::KeptFor::certificate:
      break;
  }
  return "steps kept: the smoothed section would intersect itself";
}

void take_remarks(const solid::ExportReport& report, PotCheck& check) {
  for (const solid::PieceShape& shape : report.section.shapes())
    for (const solid::Cavity& cavity : shape.cavities)
      check.remarks.push_back(
          {cavity.bottom_mm, cavity.top_mm,
           fmt::format("closed cavity of {:.1f} ml: add a drain hole", 1e-3 * cavity.volume_mm3)});
  for (const solid::KeptSteps& kept : report.section.smoothed.guard)
    check.remarks.push_back({kept.from_mm, kept.to_mm, kept_text(kept.reason)});
}

solid::MakerNumbers numbers_of(const solid::ExportReport& report, double shrinkage) {
  solid::ClayFigures clay = report.maker->clay;
  clay.shrinkage = shrinkage;
  return solid::maker_numbers(report.section.profile(), clay);
}

void take_report(const solid::ExportReport& report, std::size_t rows, double shrinkage,
                 PotCheck& check) {
  check.proved = true;
  check.problems = solid::problems_of_solid(report);
  check.triangles = report.size.triangles;
  check.tolerance_mm = report.size.tolerance_mm;
  check.counted_mm3 = report.prepared.counted_volume_mm3;
  check.proved_mm3 = report.volume.solid_mm3;
  check.volume_error_relative = report.volume.error_relative;
  if (check.fallen) return take_remarks(report, check);
  if (report.maker) check.maker = numbers_of(report, shrinkage);
  check.least_wall_mm = report.walls.min_wall_mm;
  check.thinnest_mm = report.walls.thinnest.thickness_mm;
  check.thinnest_from = {report.walls.thinnest.from.rho, report.walls.thinnest.from.y};
  check.thinnest_to = {report.walls.thinnest.to.rho, report.walls.thinnest.to.y};
  check.thinnest_in_floor = in_floor(check.form, check.thinnest_from, check.thinnest_to);
  check.walls = render::row_walls(report.walls.field, rows, check.height_mm);
  take_remarks(report, check);
}

Pot provisional(ClayStack stack, double density_g_cm3) {
  Pot pot;
  pot.stack = std::move(stack);
  pot.density_g_cm3 = density_g_cm3;
  return pot;
}

void run(const PotQuestion& question, const Pot& pot, const std::function<bool()>& cancelled,
         PotCheck& check) {
  check.height_mm = pot.stack.height_mm();
  check.fallen = pot.collapse.has_value();
  if (!check.fallen) check.form = form_of(pot.stack);
  const auto limits = limits_of(question.process);
  if (!limits) {  // the export refuses it too
    check.stopped = true;
    check.why_not = limits.error().message;
    return;
  }
  if (*limits)
    check.limit = (*limits)->wall_for(solid::size_sum_mm(
        solid::round_size_mm(2.0 * largest_radius_mm(pot.stack), pot.stack.height_mm())));
  const std::size_t rows = std::max<std::size_t>(1, question.subject.outline.rows.size());
  solid::ExportOptions options;
  options.tolerance_mm = question.tolerance_mm;
  options.cancelled = cancelled;
  options.walls.process = *limits;
  if (!check.fallen)  // a fallen pot has no single section
    options.wall_spacing_mm =
        std::max(kFinestSpacingMm, 0.5 * check.height_mm / static_cast<double>(rows));
  const auto report = solid::run_export(pot, {}, options);
  if (report) return take_report(*report, rows, question.shrinkage, check);
  check.why_not = report.error().message;
  check.fault_mm = check.form.parting_mm;
}

}  // namespace

std::vector<std::string> process_names() {
  return {solid::kProcessNames.begin(), solid::kProcessNames.end()};
}

PotCheck check_pot(const PotQuestion& question, const std::function<bool()>& cancelled) {
  const auto begin = std::chrono::steady_clock::now();
  PotCheck check;
  check.live = question.subject.live();
  if (!check.live)
    run(question, *question.subject.pot, cancelled, check);
  else if (auto stack = stack_of(question.subject.outline, question.subject.crown_mm))
    run(question, provisional(std::move(*stack), question.subject.density_g_cm3), cancelled, check);
  else
    check.why_not = "expected clay, found none";
  if (question.target && !check.fallen)
    check.off = off_target(question.subject.outline, question.target->view);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  check.seconds = spent.count();
  return check;
}

std::optional<ClayStack> stack_of(const render::PotView& outline, double crown_mm) {
  if (outline.rows.empty()) return std::nullopt;
  const double ring_mm = (outline.height_mm - crown_mm) / static_cast<double>(outline.rows.size());
  std::vector<Ring> rings;
  rings.reserve(outline.rows.size());
  for (const render::Row& row : outline.rows)
    rings.push_back({quanta_from_radius(static_cast<double>(row.outer_mm)),
                     quanta_from_radius(static_cast<double>(row.inner_mm))});
  // A crown below a tool may hold the clay of several rings, that of a stack holds less than one.
  const double crown_rings = std::max(crown_mm / ring_mm, 0.0), whole = std::floor(crown_rings);
  rings.insert(rings.end(), static_cast<std::size_t>(whole), Ring(rings.back()));
  const auto crown = static_cast<WideQuanta>(static_cast<double>(rings.back().volume()) *
                                             std::min(crown_rings - whole, 1.0 - 1e-9));
  auto stack = ClayStack::from_rings(ring_mm, std::move(rings), crown);
  if (!stack) return std::nullopt;
  return std::move(*stack);
}

std::optional<double> wall_mm_at(const PotCheck& check, double y_mm) {
  if (!check.proved) return std::nullopt;
  const double mm = wall_at_height(check.walls, check.height_mm, y_mm);
  return std::isfinite(mm) ? std::optional(mm) : std::nullopt;
}

std::vector<render::RowWall> walls_for(const PotCheck& check, std::size_t rows, double height_mm) {
  if (check.walls.empty() || !(check.height_mm > 0.0)) return {};
  if (check.walls.size() == rows && check.height_mm == height_mm) return check.walls;
  std::vector<render::RowWall> walls(rows);
  const double per_mm = static_cast<double>(check.walls.size()) / check.height_mm;
  for (std::size_t row = 0; row < rows; ++row) {
    const double y_mm = (static_cast<double>(row) + 0.5) * height_mm / static_cast<double>(rows);
    walls[row] =
        check.walls[std::min(static_cast<std::size_t>(y_mm * per_mm), check.walls.size() - 1)];
  }
  return walls;
}

render::WallMap wall_map_of(const PotCheck& check) {
  std::vector<float> faces;
  for (const render::RowWall& wall : check.walls)
    faces.insert(faces.end(), {wall.outer_mm, wall.inner_mm});
  const double top_mm = scale_top_mm(std::move(faces));
  if (!check.limit) return {0.0, top_mm};
  return {check.limit->least_mm(), top_mm, check.limit->min_wall_mm};
}

std::vector<Stretch> thin_stretches(const PotCheck& check) {
  std::vector<Stretch> stretches;
  if (!check.limit || check.walls.empty()) return stretches;
  const double row_mm = check.height_mm / static_cast<double>(check.walls.size());
  bool open = false;
  for (std::size_t row = 0; row < check.walls.size(); ++row) {
    const render::RowWall& wall = check.walls[row];
    const bool thin =
        !check.limit->met_by(static_cast<double>(std::min(wall.outer_mm, wall.inner_mm)));
    const double low_mm = row_mm * static_cast<double>(row);
    if (thin && !open) stretches.push_back({low_mm, low_mm});
    if (thin) stretches.back().to_mm = low_mm + row_mm;
    open = thin;
  }
  return stretches;
}

namespace {

constexpr double kLipShare = 0.93;  // of the height: the lip is above

std::string thin_text(double thickness_mm, double y_mm, const PotCheck& check, LengthUnit unit) {
  const std::string thickness = thickness_text(thickness_mm, unit);
  if (check.thinnest_in_floor) return "thin floor of " + thickness;
  return fmt::format("thin {} of {} at a height of {}",
                     y_mm > kLipShare * check.height_mm ? "lip" : "wall", thickness,
                     length_text(y_mm, unit));
}

/// A fault of the vessel that does not stop a print; empty: none.
std::string vessel_fault_text(const PotForm& form, LengthUnit unit) {
  if (form.floorless) return "no floor";
  if (form.throttle_mm)
    return fmt::format("mouth narrower than {} at a height of {}", length_text(kLeastMouthMm, unit),
                       length_text(*form.throttle_mm, unit));
  return {};
}

std::string problem_line(const solid::Problem& problem, const PotCheck& check, LengthUnit unit) {
  const std::string process = check.limit ? process_title(check.limit->process) : "";
  const double y_mm = problem.at ? problem.at->y : 0.0;
  switch (problem.kind) {
    case solid::ProblemKind::thin_wall:
      return fmt::format(
          "{}; {} {}", thin_text(problem.figure, y_mm, check, unit),
          check.limit ? process + " needs" : "no process allows less than",
          thickness_text(check.limit ? check.limit->min_wall_mm : solid::smallest_allowed_wall_mm(),
                         unit));
    case solid::ProblemKind::too_large:
      return "too large for " + process;
    case solid::ProblemKind::cavity:
      return fmt::format("closed cavity at a height of {}", length_text(y_mm, unit));
    case solid::ProblemKind::drain:
      return fmt::format("the drain hole is only {} wide", length_text(problem.figure, unit));
    case solid::ProblemKind::overhang:
      return fmt::format("overhang of {:.1f} degrees at a height of {}: print it with supports",
                         problem.figure, length_text(y_mm, unit));
    case solid::ProblemKind::lip_fillet:
      return fmt::format("the lip is rounded by only {}", length_text(problem.figure, unit));
    case solid::ProblemKind::bodies:
      break;
  }
  return "several bodies that do not touch";
}

}  // namespace

bool PotCheck::ready() const {
  return proved && std::ranges::none_of(problems, &solid::Problem::fails);
}

Verdict PotCheck::verdict() const {
  if (!ready()) return Verdict::not_ready;
  if (!problems.empty() || !vessel_fault_text(form, LengthUnit::mm).empty())
    return Verdict::doubtful;
  return form.hollow || fallen ? Verdict::ready : Verdict::lump;
}

std::string ready_text(const PotCheck& check, LengthUnit unit) {
  if (check.stopped) return "Not checked: " + check.why_not;
  if (!check.proved)
    return "Not ready: " + (check.fault_mm ? parts_text(check.form, unit) : "not one closed solid");
  const bool ready = check.ready();
  for (const solid::Problem& problem : check.problems)
    if (problem.fails != ready)
      return (ready ? "Check before printing: " : "Not ready: ") +
             problem_line(problem, check, unit);
  if (const std::string fault = vessel_fault_text(check.form, unit); !fault.empty())
    return "Check before printing: " + fault;
  return check.verdict() == Verdict::lump ? "Solid clay" : "Ready to print";
}

std::string parts_text(const PotForm& form, LengthUnit unit) {
  const std::string height = length_text(*form.parting_mm, unit);
  if (form.parts <= 2) return "in two parts, separated at a height of " + height;
  return fmt::format("in {} parts, the lowest up to a height of {}", form.parts, height);
}

std::string wall_text(const PotCheck& check, LengthUnit unit) {
  if (check.fallen) return "Fallen: walls are not measured";
  if (check.stopped) return "Walls unknown: " + check.why_not;
  if (!check.proved) return "Walls unknown: the pot is not one closed solid";
  if (!check.form.hollow && !check.thin()) return "Solid clay: there are no walls yet";
  std::string words = fmt::format(
      "Thinnest wall {}, {}", thickness_text(check.thinnest_mm, unit),
      check.thinnest_in_floor ? "in the floor"
                              : "at a height of " + length_text(check.thinnest_from.y, unit));
  if (check.limit)
    words += fmt::format("; {} requires {}: {}", process_title(check.limit->process),
                         thickness_text(check.limit->min_wall_mm, unit),
                         check.thin() ? "too thin" : "thick enough");
  return words;
}

}  // namespace clay::studio
