#include "app/cli/check.hpp"

#include "claystack/engine/files.hpp"
#include "claystack/export/job.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/solid.hpp"
#include "claystack/export/walls.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::cli {
namespace {

// A pot is checked on a mesh of its walls: enough facets to resemble the pot, few enough to be
// fast. Soundness does not depend on their number.
constexpr std::size_t kMostSegments = 64;
constexpr std::size_t kFewestSegments = 8;
constexpr std::size_t kQuickTriangles = 1'000'000;

std::size_t check_segments(const solid::Profile& profile) {
  const std::size_t each = std::max<std::size_t>(solid::triangle_count(profile, 1), 1);
  return std::clamp(kQuickTriangles / each, kFewestSegments, kMostSegments);
}

Verdict verdict_on(const solid::ExportReport& report) {
  const solid::Profile& profile = report.section.profile();
  Verdict verdict;
  if (solid::triangle_count(profile, kFewestSegments) <= solid::kMaxTriangles)
    verdict.mesh = solid::check_mesh(solid::revolve(profile, check_segments(profile)));
  else
    verdict.examined = false;
  verdict.wall_mm = report.walls.min_wall_mm;
  const auto& shapes = report.section.shapes();
  for (const solid::Problem& problem : solid::problems_of(report)) {
    if (problem.fails)
      verdict.mesh.problems.push_back({"process", problem.text, 1});
    else
      verdict.notes.push_back(problem.text);
  }
  if (shapes.size() > 1)
    verdict.mesh.problems.push_back({"pieces that do not touch",
                                     fmt::format("{} pieces; ring {} is the first of the second",
                                                 shapes.size(), shapes[1].first_ring),
                                     shapes.size()});
  const auto& limit = report.walls.limit;
  if (limit && *verdict.wall_mm < limit->min_wall_mm)
    verdict.mesh.problems.push_back(
        {"thin wall", solid::thin_wall_text(profile, *verdict.wall_mm, *limit), 1});
  else if (limit)
    verdict.notes.push_back("walls: " + solid::wall_text(*verdict.wall_mm, *limit));
  return verdict;
}

}  // namespace

Result<Verdict> check_pot(std::string_view bytes, const CheckCommand& command) {
  if (command.changes_mesh())
    return failure(
        ErrorKind::bad_input,
        command.file + ": --repair and --max-triangles are for meshes; export the pot again");
  if (!command.certificate.empty())
    return failure(ErrorKind::bad_input,
                   command.file + ": expected a mesh for --certificate, found a pot");
  const auto pot = parse_pot(bytes, command.file);
  if (!pot) return tl::make_unexpected(pot.error());
  if (pot->collapse)
    return unsound("collapsed", fmt::format("ring {} yielded at {:g} kPa",
                                            pot->collapse->failed_ring, pot->collapse->stress_kpa));
  // The export with its defaults, without a file.
  solid::ExportOptions options;
  options.walls = command.walls.demand();
  options.allow_pieces = true;
  const auto report = solid::run_export(*pot, {}, options);
  if (!report) return unsound("no solid", report.error().message);
  Verdict verdict = verdict_on(*report);
  if (pot->rounding)
    verdict.notes.push_back(fmt::format("radii rounded to {} mm", pot->rounding->to_mm));
  return verdict;
}

}  // namespace clay::cli
