#include "claystack/export/job.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::solid::inline job {

bool ExportReport::has_mesh() const noexcept {
  return std::ranges::any_of(files,
                             [](const FileReport& file) { return file.kind == FileKind::mesh; });
}

double ExportReport::thinnest_mm() const noexcept {
  double thinnest = walls.min_wall_mm;
  for (const FileReport& file : files)
    if (file.certificate) thinnest = std::min(thinnest, file.certificate->wall_lower_mm);
  return thinnest;
}

std::optional<std::string> thin_wall_of(const ExportReport& report) {
  const auto& limit = report.walls.limit;
  const double thinnest = report.thinnest_mm();
  if (!limit || !report.has_mesh() || thinnest >= limit->min_wall_mm) return std::nullopt;
  return "thin wall: " + (report.collapsed
                              ? wall_text(thinnest, *limit)
                              : thin_wall_text(report.section.profile(), thinnest, *limit));
}

std::string text_of(const Cavity& cavity) {
  return fmt::format("closed cavity from {:.1f} to {:.1f} mm ({:.1f} cm3): it needs a drain hole",
                     cavity.bottom_mm, cavity.top_mm, cavity.volume_mm3 / 1000.0);
}

std::vector<Problem> problems_of(const ExportReport& report) {
  std::vector<Problem> problems;
  if (auto thin = thin_wall_of(report)) {
    const Wall& wall = report.walls.thinnest;
    const bool placed = !report.collapsed && wall.thickness_mm > 0.0;
    problems.push_back({std::move(*thin), placed ? std::optional(wall.from) : std::nullopt});
  }
  for (const PieceShape& shape : report.section.shapes())
    for (const Cavity& cavity : shape.cavities)
      problems.push_back(
          {text_of(cavity), ProfilePoint{0.0, 0.5 * (cavity.bottom_mm + cavity.top_mm)}});
  if (report.collapsed && report.collapsed->pieces > 1)
    problems.push_back(
        {fmt::format("the file holds {} bodies that do not touch", report.collapsed->pieces),
         std::nullopt});
  return problems;
}

}  // namespace clay::solid::inline job
