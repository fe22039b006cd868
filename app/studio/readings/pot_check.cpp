#include "app/studio/readings/pot_check.hpp"

#include "app/render/wall_rows.hpp"
#include "claystack/engine/tick.hpp"
#include "claystack/export/job.hpp"
#include "claystack/export/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace clay::studio {
namespace {

constexpr double kFinestSpacingMm = 0.05;

std::optional<solid::WallLimit> limit_of(const std::string& process, const ClayStack& stack,
                                         std::vector<PotRemark>& remarks) {
  if (process.empty()) return std::nullopt;
  const auto limits = solid::read_process(process);
  if (!limits) {
    remarks.push_back({0.0, stack.height_mm(), limits.error().message});
    return std::nullopt;
  }
  return limits->wall_for(4.0 * largest_radius_mm(stack) + stack.height_mm());
}

/// The lowest level where the rings on both sides share no clay: a pot in pieces parts there.
std::optional<double> parting_mm(const ClayStack& stack) {
  const auto rings = stack.rings();
  for (std::size_t i = 1; i < rings.size(); ++i)
    if (std::max(rings[i - 1].inner2, rings[i].inner2) >=
        std::min(rings[i - 1].outer2, rings[i].outer2))
      return static_cast<double>(i) * stack.ring_height_mm();
  return std::nullopt;
}

const char* words_of(solid::KeptFor reason) {
  switch (reason) {
    case solid::KeptFor::wall:
      return "steps stay: smoothed, the wall would be too thin";
    case solid::KeptFor::overshoot:
      return "steps stay: a radius would overshoot";
    case solid::KeptFor::volume:
      return "steps stay: the walls would move to keep the volume";
    case solid::KeptFor::certificate:
      break;
  }
  return "steps stay: smoothed, the section would meet itself";
}

void take_remarks(const solid::ExportReport& report, PotCheck& check) {
  for (const solid::PieceShape& shape : report.section.shapes())
    for (const solid::Cavity& cavity : shape.cavities)
      check.remarks.push_back(
          {cavity.bottom_mm, cavity.top_mm,
           fmt::format("closed cavity of {:.1f} ml: it needs a drain", 1e-3 * cavity.volume_mm3)});
  for (const solid::KeptSteps& kept : report.section.smoothed.guard)
    check.remarks.push_back({kept.from_mm, kept.to_mm, words_of(kept.reason)});
}

void take_report(const solid::ExportReport& report, std::size_t rows, PotCheck& check) {
  check.proved = true;
  check.triangles = report.size.triangles;
  check.tolerance_mm = report.size.tolerance_mm;
  check.counted_mm3 = report.prepared.counted_volume_mm3;
  check.proved_mm3 = report.volume.solid_mm3;
  check.volume_error_relative = report.volume.error_relative;
  if (check.fallen) return take_remarks(report, check);
  check.least_wall_mm = report.walls.min_wall_mm;
  check.thinnest_mm = report.walls.thinnest.thickness_mm;
  check.thinnest_from = {report.walls.thinnest.from.rho, report.walls.thinnest.from.y};
  check.thinnest_to = {report.walls.thinnest.to.rho, report.walls.thinnest.to.y};
  check.walls = render::row_walls(report.walls.field, rows, check.height_mm);
  take_remarks(report, check);
}

Pot provisional(ClayStack stack, double density_g_cm3) {
  Pot pot;
  pot.stack = std::move(stack);
  pot.density_g_cm3 = density_g_cm3;
  return pot;
}

void run(const PotQuestion& question, const Pot& pot, const std::function<bool()>& given_up,
         PotCheck& check) {
  check.height_mm = pot.stack.height_mm();
  check.fallen = pot.collapse.has_value();
  check.limit = limit_of(question.process, pot.stack, check.remarks);
  const std::size_t rows = std::max<std::size_t>(1, question.subject.outline.rows.size());
  solid::ExportOptions options;
  options.tolerance_mm = question.tolerance_mm;
  options.cancelled = given_up;
  if (check.limit) options.walls.min_wall_mm = check.limit->min_wall_mm;
  if (!check.fallen)  // one that has fallen has no one section
    options.wall_spacing_mm =
        std::max(kFinestSpacingMm, 0.5 * check.height_mm / static_cast<double>(rows));
  const auto report = solid::run_export(pot, {}, options);
  if (report) return take_report(*report, rows, check);
  check.why_not = report.error().message;
  check.fault_mm = parting_mm(pot.stack);
}

}  // namespace

std::vector<std::string> process_names() {
  return {solid::kProcessNames.begin(), solid::kProcessNames.end()};
}

PotCheck check_pot(const PotQuestion& question, const std::function<bool()>& given_up) {
  const auto begin = std::chrono::steady_clock::now();
  PotCheck check;
  check.live = question.subject.live();
  if (!check.live)
    run(question, *question.subject.pot, given_up, check);
  else if (auto stack = stack_of(question.subject.outline, question.subject.crown_mm))
    run(question, provisional(std::move(*stack), question.subject.density_g_cm3), given_up, check);
  else
    check.why_not = "expected clay, found none";
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  check.seconds = spent.count();
  return check;
}

}  // namespace clay::studio
