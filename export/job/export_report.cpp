#include "claystack/export/job.hpp"

#include "core/size_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::solid::inline job {

bool ExportReport::has_solid() const noexcept {
  return std::ranges::any_of(files, [](const FileReport& file) {
    return file.kind == FileKind::mesh || file.kind == FileKind::step;
  });
}

double ExportReport::thinnest_mm() const noexcept {
  double thinnest = walls.min_wall_mm;
  for (const FileReport& file : files)
    if (collapsed && file.kind == FileKind::mesh)  // both sides of a wall may have moved
      thinnest = std::min(thinnest, std::max(walls.min_wall_mm - 2.0 * file.max_error_mm, 0.0));
    else if (file.certificate)
      thinnest = std::min(thinnest, file.certificate->wall_lower_mm);
    else if (file.step)
      thinnest = std::min(thinnest, file.step->min_wall_mm);
  return thinnest;
}

namespace {

std::optional<std::string> thin_wall_of_solid(const ExportReport& report) {
  const auto& limit = report.walls.limit;
  const double thinnest = report.thinnest_mm();
  if (!limit || limit->met_by(thinnest)) return std::nullopt;
  return "thin wall: " + (report.collapsed
                              ? wall_text(thinnest, *limit)
                              : thin_wall_text(report.section.profile(), thinnest, *limit));
}

}  // namespace

std::optional<std::string> thin_wall_of(const ExportReport& report) {
  return report.has_solid() ? thin_wall_of_solid(report) : std::nullopt;
}

std::string text_of(const Cavity& cavity) {
  return fmt::format("closed cavity from {} to {} mm ({} cm3): it needs a drain hole",
                     size_text(cavity.bottom_mm, 1), size_text(cavity.top_mm, 1),
                     size_text(cavity.volume_mm3 / 1000.0, 1));
}

namespace {

std::optional<Problem> steep_overhang(const ExportReport& report) {
  const auto& [limits, overhang] = report.process;
  if (!overhang || !limits || !limits->overhang || limits->overhang->met_by(overhang->angle_deg))
    return std::nullopt;
  return Problem{overhang_text(overhang->angle_deg, overhang->at.y, *limits),
                 report.collapsed ? std::nullopt : std::optional(overhang->at), false,
                 ProblemKind::overhang, overhang->angle_deg};
}

std::optional<Problem> too_large(const ExportReport& report) {
  const auto& limits = report.process.limits;
  if (!limits || !limits->size) return std::nullopt;
  const SizeLimit& most = *limits->size;
  const glm::dvec3 size = report.size.extents_mm;
  if (most.fits(size)) return std::nullopt;
  const std::string across = size.x == size.y ? fmt::format("{:.1f}", size.x)
                                              : fmt::format("{:.1f} x {:.1f}", size.x, size.y);
  return Problem{fmt::format("too large: {} mm wide and {:.1f} mm high; {}: at most {:g} x {:g} "
                             "mm and {:g} mm high ({})",
                             across, size.z, process_title(limits->name), most.width_mm,
                             most.depth_mm, most.height_mm, most.source),
                 std::nullopt, true, ProblemKind::too_large};
}

/// Whether the place of the thinnest wall is known: not in a fallen pot.
bool placed_wall(const ExportReport& report) {
  return !report.collapsed && report.walls.thinnest.thickness_mm > 0.0;
}

/// Without a requested limit, a wall below the limit of every process still gets a warning.
std::optional<std::string> below_each_process(const ExportReport& report) {
  const double smallest = smallest_allowed_wall_mm(), thinnest = report.thinnest_mm();
  const bool measured = report.walls.min_wall_mm > 0.0 || placed_wall(report) || report.has_solid();
  if (report.walls.limit || !measured || thinnest >= smallest) return std::nullopt;
  const std::string place =
      placed_wall(report) ? " at a height of " + size_text(report.walls.thinnest.from.y, 1) + " mm"
                          : "";
  return fmt::format("thin wall: {} mm{}; no process allows less than {:g} mm",
                     bound_text(thinnest, 3), place, smallest);
}

/// For a fallen pot the cavities of the union: the parts may enclose one together, or fill one.
std::vector<Problem> cavities_of(const ExportReport& report) {
  const bool fired = report.process.limits && report.process.limits->fired;
  std::vector<Problem> cavities;
  if (report.collapsed) {
    const std::size_t voids = report.collapsed->voids;
    const double cm3 = report.collapsed->voids_mm3 / 1000.0;
    if (voids > 0)
      cavities.push_back({voids == 1 ? fmt::format("1 closed cavity of {:.3g} cm3: it needs a "
                                                   "drain hole",
                                                   cm3)
                                     : fmt::format("{} closed cavities of {:.3g} cm3 in total: "
                                                   "they need drain holes",
                                                   voids, cm3),
                          std::nullopt, fired, ProblemKind::cavity});
    return cavities;
  }
  for (const PieceShape& shape : report.section.shapes())
    for (const Cavity& cavity : shape.cavities)
      cavities.push_back({text_of(cavity),
                          ProfilePoint{0.0, 0.5 * (cavity.bottom_mm + cavity.top_mm)}, fired,
                          ProblemKind::cavity});
  return cavities;
}

std::optional<Problem> narrow_drain(const ExportReport& report) {
  const double drain_mm = report.prepared.drain_mm;
  if (drain_mm == 0.0 || drain_mm >= kLeastDrainMm) return std::nullopt;
  return Problem{
      fmt::format(
          "drain hole of {:g} mm: expected at least {:g} mm, because a printer or glaze may "
          "close a narrower one",
          drain_mm, kLeastDrainMm),
      std::nullopt, report.process.limits && report.process.limits->fired, ProblemKind::drain,
      drain_mm};
}

/// The pieces of a standing pot are one above the other.
std::optional<Problem> several_bodies(const ExportReport& report) {
  const auto& shapes = report.section.shapes();
  const std::size_t count = report.collapsed ? report.collapsed->pieces : shapes.size();
  if (count < 2) return std::nullopt;
  return Problem{
      report.collapsed
          ? fmt::format("the file holds {} bodies that do not touch", count)
          : fmt::format("{} pieces that do not touch: all but the lowest are in mid-air; "
                        "ring {} is the first of the second",
                        count, shapes[1].first_ring),
      std::nullopt, false, ProblemKind::bodies};
}

std::vector<Problem> problems_with(const ExportReport& report, std::optional<std::string> thin) {
  std::vector<Problem> problems;
  const bool fails = thin.has_value();
  if (!fails) thin = below_each_process(report);
  if (thin) {
    const Wall& wall = report.walls.thinnest;
    problems.push_back({std::move(*thin),
                        placed_wall(report) ? std::optional(wall.from) : std::nullopt, fails,
                        ProblemKind::thin_wall, report.thinnest_mm()});
  }
  if (auto size = too_large(report)) problems.push_back(std::move(*size));
  for (Problem& cavity : cavities_of(report)) problems.push_back(std::move(cavity));
  if (auto narrow = narrow_drain(report)) problems.push_back(std::move(*narrow));
  if (auto steep = steep_overhang(report)) problems.push_back(std::move(*steep));
  if (auto bodies = several_bodies(report)) problems.push_back(std::move(*bodies));
  return problems;
}

/// Whether made smaller by more than a little.
std::optional<Problem> small_lip_fillet(const ExportReport& report) {
  constexpr double kLittle = 0.05;
  const SmoothedProfile& smoothed = report.section.smoothed;
  const double asked = smoothed.lip_fillet_asked_mm, made = smoothed.lip_fillet_mm;
  if (made >= (1.0 - kLittle) * asked) return std::nullopt;
  const auto& limits = report.process.limits;
  const bool by_process = limits && limits->edges && limits->edges->min_radius_mm == asked;
  return Problem{fmt::format("lip fillet of {:.2f} mm instead of {:g} mm{}: {}; sharper edges chip",
                             made, asked, by_process ? " for " + process_title(limits->name) : "",
                             reason_of(smoothed.lip_fillet_limit)),
                 std::nullopt, false, ProblemKind::lip_fillet, made};
}

}  // namespace

std::vector<Problem> problems_of(const ExportReport& report) {
  std::vector<Problem> problems = problems_with(report, thin_wall_of(report));
  // The lip counts only if a file is made.
  const bool made = std::ranges::any_of(
      report.files, [](const FileReport& file) { return file.kind != FileKind::given; });
  if (auto fillet = small_lip_fillet(report); fillet && made)
    problems.push_back(std::move(*fillet));
  return problems;
}

std::vector<Problem> problems_of_solid(const ExportReport& report) {
  std::vector<Problem> problems = problems_with(report, thin_wall_of_solid(report));
  if (auto fillet = small_lip_fillet(report)) problems.push_back(std::move(*fillet));
  return problems;
}

std::string check_name(ProblemKind kind) {
  switch (kind) {
    case ProblemKind::thin_wall:
      return "walls";
    case ProblemKind::too_large:
    case ProblemKind::overhang:
      return "process";
    case ProblemKind::cavity:
    case ProblemKind::drain:
    case ProblemKind::bodies:
    case ProblemKind::lip_fillet:
      break;
  }
  return "geometry";
}

}  // namespace clay::solid::inline job
