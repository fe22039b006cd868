// The limits on a mesh that are not about its soundness: its walls, its size, its undersides.

#include "app/cli/check.hpp"
#include "core/size_text.hpp"
#include "core/text.hpp"

#include "claystack/export/repair.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace clay::cli {
namespace {

using solid::ProblemKind;
using solid::TriangleMesh;

void report_wall(const solid::SampledWall& wall, const solid::WallLimit& limit, bool united,
                 const CheckCommand& command, Verdict& verdict) {
  const std::string sampled = united ? "sampled on the united shells" : std::string("sampled");
  if (wall.rays < command.wall_samples())
    verdict.add(
        solid::check_name(ProblemKind::thin_wall), Grade::warn,
        fmt::format("sampled by only {} rays instead of {}: too many triangles lie near each ray",
                    wall.rays, command.wall_samples()));
  if (std::isinf(wall.least_mm))
    return verdict.add(
        solid::check_name(ProblemKind::thin_wall), Grade::fail,
        fmt::format("not measured: none of {} rays reached the other side of a wall", wall.rays));
  if (limit.met_by(wall.least_mm))
    return verdict.add(solid::check_name(ProblemKind::thin_wall), Grade::pass,
                       sampled + ": " + solid::wall_text(wall.least_mm, limit));
  // The triangles of united shells are not those of the file.
  const std::string triangle = united ? "" : fmt::format("triangle {} ", wall.triangle + 1);
  verdict.add(solid::check_name(ProblemKind::thin_wall), Grade::fail,
              fmt::format("thin wall ({}): {}at ({:.6g}, {:.6g}, {:.6g}) mm: {}", sampled, triangle,
                          wall.place.x, wall.place.y, wall.place.z,
                          solid::wall_text(wall.least_mm, limit)));
}

Result<void> measure_wall(const PrintedBody& body, const solid::WallLimit& limit,
                          const CheckCommand& command, const Console& console, Verdict& verdict) {
  Progress progress(console, "walls", command.wall_samples());
  const auto wall = solid::sampled_wall(body.mesh(), command.wall_samples(),
                                        solid::most_wall_steps(command.wall_samples()),
                                        [&](std::size_t rays) { progress.update(rays); });
  if (!wall && wall.error().kind == ErrorKind::io)
    return failure(ErrorKind::io, command.file + ": " + wall.error().message);
  if (!wall) {
    verdict.add(solid::check_name(ProblemKind::thin_wall), Grade::fail,
                "not measured: " + wall.error().message);
    return {};
  }
  verdict.wall_sampled = *wall;
  verdict.wall_united = body.united.has_value();
  report_wall(*wall, limit, verdict.wall_united, command, verdict);
  return {};
}

}  // namespace

Result<PrintedBody> printed_body(const TriangleMesh& mesh, const CheckCommand& command,
                                 const Verdict& verdict) {
  PrintedBody body{&mesh, {}, {}};
  if (!command.walls.asked()) return body;
  const solid::MeshReport& report = verdict.mesh;
  // Rays through an opening measure the bore.
  if (!report.closed) {
    body.unknown = "the mesh is open; check the result of --repair";
    return body;
  }
  if (!report.oriented) {
    body.unknown = "some or all faces point into the clay; check the result of --repair";
    return body;
  }
  const bool nested = report.components > 1 && !report.bounds_volume;
  if (report.sound() || (report.self_intersections == 0 && !nested)) return body;
  if (!solid::slicer_unites(mesh, report)) {
    if (report.self_intersections > 0)
      body.unknown = fmt::format(
          "shells intersect ({} of triangles), and a slicer may not unite them; check the result "
          "of --repair",
          counted(report.self_intersections, "pair"));
    return body;
  }
  auto repaired = solid::repair_unsound_mesh(mesh);
  if (!repaired && repaired.error().kind == ErrorKind::io)
    return failure(ErrorKind::io, command.file + ": " + repaired.error().message);
  if (repaired)
    body.united = std::move(repaired->mesh);
  else
    body.unknown = "shells intersect, and cannot be united: " + repaired.error().message;
  return body;
}

void check_process(const PrintedBody& body, const glm::dvec3& size, const CheckCommand& command,
                   Verdict& verdict) {
  const auto& process = command.walls.demand().process;
  if (!process) return;
  std::string passed = fmt::format("{} x {} x {} mm", size_text(size.x, 1), size_text(size.y, 1),
                                   size_text(size.z, 1));
  const auto& largest = process->size;
  const bool fits = !largest || largest->fits(size);
  if (!fits)
    verdict.add(solid::check_name(ProblemKind::too_large), Grade::fail,
                fmt::format("too large: {}; {}: at most {:g} x {:g} mm and {:g} mm high ({})",
                            passed, solid::process_title(process->name), largest->width_mm,
                            largest->depth_mm, largest->height_mm, largest->source));
  if (const auto& most = process->overhang) {
    const std::string_view unknown = !verdict.mesh.closed    ? "the mesh is open"
                                     : verdict.mesh.oriented ? ""
                                                             : "some or all faces point into the "
                                                               "clay";
    if (!unknown.empty()) {
      verdict.add("process", Grade::warn,
                  fmt::format("{}: {}, overhangs not measured: {}",
                              solid::process_title(process->name), passed, unknown));
      return;
    }
    const auto steepest = solid::steepest_overhang(body.mesh());
    if (steepest && !most->met_by(steepest->angle_deg))
      return verdict.add(solid::check_name(ProblemKind::overhang), Grade::warn,
                         solid::overhang_text(steepest->angle_deg, steepest->height_mm, *process));
    passed += steepest ? fmt::format(", largest overhang {:.0f} degrees", steepest->angle_deg)
                       : std::string(", overhangs not measured");
  }
  if (fits)
    verdict.add("process", Grade::pass, solid::process_title(process->name) + ": " + passed);
}

Result<void> check_walls(const PrintedBody& body, const glm::dvec3& size,
                         const CheckCommand& command, const Console& console, Verdict& verdict) {
  const auto limit = command.walls.demand().for_size(solid::size_sum_mm(size));
  if (!limit) return {};
  if (!verdict.certified_wall_mm && !body.unknown.empty()) {
    verdict.add(solid::check_name(ProblemKind::thin_wall), Grade::fail,
                "not measured: " + body.unknown);
    return {};
  }
  if (!verdict.certified_wall_mm) return measure_wall(body, *limit, command, console, verdict);
  const double wall_mm = *verdict.certified_wall_mm;
  verdict.add(solid::check_name(ProblemKind::thin_wall),
              limit->met_by(wall_mm) ? Grade::pass : Grade::fail,
              "certified: " + solid::wall_text(wall_mm, *limit));
  return {};
}

}  // namespace clay::cli
