#include "app/cli/check.hpp"
#include "app/cli/pot_input.hpp"

#include "claystack/export/job.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/solid.hpp"
#include "claystack/export/walls.hpp"
#include "core/size_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/vec3.hpp>
#include <utility>

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

std::string failure_text(const Collapse& fall, double ring_mm) {
  const std::string place =
      fmt::format("the clay at a height of {:.1f} mm (ring {})",
                  (static_cast<double>(fall.failed_ring) + 0.5) * ring_mm, fall.failed_ring);
  return fall.parted() ? place + " no longer touches the clay above it"
                       : fmt::format("{} yielded at {:.4g} kPa", place, fall.stress_kpa);
}

/// The figures that were compared with the limits of the process.
std::string process_text(const solid::ExportReport& report) {
  std::string text =
      fmt::format("{}: {} mm wide, {} mm high", solid::process_title(report.process.limits->name),
                  size_text(report.size.diameter_mm, 1), size_text(report.size.height_mm, 1));
  if (report.process.overhang)
    text += fmt::format(", largest overhang {:.0f} degrees", report.process.overhang->angle_deg);
  return text;
}

/// As a file holds it: rounding may close a very thin wall.
solid::TriangleMesh in_float32(solid::TriangleMesh mesh) {
  for (glm::dvec3& point : mesh.points) point = glm::vec3(point);
  return mesh;
}

/// Refused if the mesh does not fit into memory, which is no fault of the pot.
Result<void> check_solid(const solid::TriangleMesh& mesh, Verdict& verdict) {
  return report_on(mesh).map([&](solid::MeshReport report) {
    verdict.mesh = std::move(report);
    verdict.state = state_of(mesh, verdict.mesh);
  });
}

Result<Verdict> verdict_on(const solid::ExportReport& report) {
  const solid::Profile& profile = report.section.profile();
  Verdict verdict;
  verdict.examined = solid::triangle_count(profile, kFewestSegments) <= solid::kMaxTriangles;
  if (verdict.examined) {
    const auto checked =
        check_solid(in_float32(solid::revolve(profile, check_segments(profile))), verdict);
    if (!checked) return tl::make_unexpected(checked.error());
  }
  // The mesh of facets is slightly wider.
  verdict.mesh.size_mm = report.size.extents_mm;
  verdict.wall_mm = report.walls.min_wall_mm;
  verdict.wall_parts = report.walls.parts;
  const auto& limit = report.walls.limit;
  if (limit && !limit->met_by(*verdict.wall_mm))
    verdict.add(solid::check_name(solid::ProblemKind::thin_wall), Grade::fail,
                "thin wall: " + solid::thin_wall_text(profile, *verdict.wall_mm, *limit));
  else if (limit)
    verdict.add(solid::check_name(solid::ProblemKind::thin_wall), Grade::pass,
                solid::wall_text(*verdict.wall_mm, *limit));
  for (const solid::Problem& problem : solid::problems_of(report)) {
    const bool bodies = problem.kind == solid::ProblemKind::bodies;
    verdict.add(solid::check_name(problem.kind),
                problem.fails || bodies ? Grade::fail : Grade::warn, problem.text);
  }
  const bool process_passes = std::ranges::none_of(
      verdict.findings, [](const Finding& finding) { return finding.check == "process"; });
  if (report.process.limits && process_passes)
    verdict.add("process", Grade::pass, process_text(report));
  return verdict;
}

}  // namespace

Result<Verdict> check_pot(std::string_view bytes, const CheckCommand& command,
                          const Console& console) {
  if (command.changes_mesh())
    return failure(
        ErrorKind::bad_input,
        command.file + ": --repair and --max-triangles are for meshes; export the pot again");
  for (const auto& [option, given] :
       {std::pair("--certificate", !command.certificate.empty()),
        std::pair("--wall-samples", command.wall_samples_asked.has_value()),
        std::pair("--accept", !command.accept.empty())})
    if (given)
      return failure(ErrorKind::bad_input,
                     fmt::format("{}: expected a mesh for {}, found a pot", command.file, option));
  Progress progress(console, "check", 0);
  progress.stage("reading");
  const auto pot = pot_from(bytes, command.file);
  if (!pot) return tl::make_unexpected(pot.error());
  if (pot->collapse)
    return not_examined(MeshState::will_not_print, "collapsed",
                        failure_text(*pot->collapse, pot->stack.ring_height_mm()) +
                            "; claystack export writes the fallen pot, with --pieces if it is in "
                            "several");
  // The export with its defaults, without a file.
  solid::ExportOptions options;
  options.walls = command.walls.demand();
  options.allow_pieces = true;
  options.wall_spacing_mm = solid::kWallTableSpacingMm;
  const auto report =
      solid::run_export(*pot, {}, options, [&](std::string_view stage) { progress.stage(stage); });
  const auto refused = [&](const Error& error) {
    return failure(error.kind, command.file + ": " + error.message);
  };
  if (!report && report.error().kind == ErrorKind::io) return refused(report.error());
  if (!report) return not_examined(MeshState::will_not_print, "no solid", report.error().message);
  progress.stage("checking");
  auto verdict = verdict_on(*report);
  if (!verdict) return refused(verdict.error());
  if (pot->rounding)
    verdict->notes.push_back(fmt::format("radii rounded to {} mm", pot->rounding->to_mm));
  return verdict;
}

}  // namespace clay::cli
