// The verdict of `claystack check` as text.

#include "app/cli/check.hpp"
#include "core/size_text.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clay::cli {
namespace {

/// "12.345 cm3", with significant digits where three decimals are too few or too many.
std::string in_cm3(double mm3) {
  const double cm3 = mm3 / 1000.0, size = std::abs(cm3);
  return size >= 0.1 && size < 1e6 ? fmt::format("{:.3f} cm3", cm3)
                                   : fmt::format("{:.4g} cm3", cm3);
}

std::string volume_text(const solid::MeshReport& mesh) {
  const bool several_shells = mesh.components > 1 || mesh.self_intersections > 0;
  const bool counted_twice = several_shells && !mesh.bounds_volume;
  if (mesh.has_volume)
    return in_cm3(mesh.volume_mm3) + (counted_twice ? " (counted twice where shells overlap)" : "");
  if (!mesh.closed) return "no volume: the mesh is open";
  return mesh.oriented ? "no volume: faces at a non-manifold edge have no opposite face"
                       : "no volume: neighbours face opposite ways";
}

void print_certificate(const Console& console, const solid::SolidCertificate& certificate) {
  console.print(fmt::format(
      "  certificate holds: closed and embedded, wall {:.4f} to {:.4f} mm at its thinnest, volume "
      "{:.3f} cm3 within {:.2g} mm3",
      certificate.wall_lower_mm, certificate.wall_upper_mm, certificate.volume_mm3 / 1000.0,
      certificate.volume_bound_mm3));
}

void print_wall(const Console& console, const solid::SampledWall& wall) {
  if (!std::isinf(wall.least_mm))
    console.print(fmt::format(
        "  thinnest sample {} mm at ({:.6g}, {:.6g}, {:.6g}), {} rays; a sampled "
        "value, not a bound",
        size_text(wall.least_mm, 3), wall.place.x, wall.place.y, wall.place.z, wall.rays));
  if (wall.escaped > 0)
    console.print(fmt::format("  {} of {} passed through an opening", wall.escaped,
                              counted(wall.rays, "ray")));
}

void print_repair(const Console& console, const RepairSummary& summary, const Verdict& verdict) {
  for (const auto& problem : summary.found)
    console.print(fmt::format("  found: {} ({}): {}", problem.what, problem.count, problem.where));
  for (const auto& [what, count] : summary.repaired)
    console.print(fmt::format("  repaired: {} ({})", what, count));
  if (summary.decimation_error_mm)
    console.print(fmt::format("  decimated: {} to {} triangles; vertices within {:.2g} mm",
                              summary.triangles_before, verdict.mesh.triangles,
                              *summary.decimation_error_mm));
  for (const solid::FilledHole& hole : summary.holes)
    console.print(fmt::format(
        "  filled: hole of {} edges, {:.4g} mm wide, {:.4g} mm2, at ({:.6g}, {:.6g}, {:.6g}) mm",
        hole.edges, hole.extent_mm, hole.area_mm2, hole.place.x, hole.place.y, hole.place.z));
  if (summary.wrapped_mm)
    console.print(fmt::format("  wrapped: a new surface {:.4g} mm outside of the old one",
                              *summary.wrapped_mm));
  if (const auto& wall = summary.thickened)
    console.print(fmt::format(
        "  thickened{}: {:.4g} mm requested, thinnest sample {:.4g} mm, median {:.4g} mm",
        wall->wrapped ? " by a wrap" : "", wall->asked_mm, wall->least_mm, wall->median_mm));
  if (!summary.repaired.empty() || summary.change.added_mm > 0.0 || summary.change.removed_mm > 0.0)
    console.print(
        fmt::format("  change: the new surface within {:.3g} mm of the old one, the old one within "
                    "{:.3g} mm of the new one",
                    summary.change.added_mm, summary.change.removed_mm));
  constexpr double kLeastShownMm = 5e-4;
  if (summary.reading_mm >= kLeastShownMm)
    console.print(
        fmt::format("  read: points rounded to float32, by up to {:.3g} mm", summary.reading_mm));
  const auto volume = [](const std::optional<double>& mm3, std::string_view when) {
    return mm3 ? fmt::format("{:.6g} cm3 {}", *mm3 / 1e3, when)
               : fmt::format("none {}, because the mesh encloses none", when);
  };
  const auto& mesh = verdict.mesh;
  console.print(fmt::format(
      "  volume: {}, {}", volume(summary.volume_before_mm3, "before"),
      volume(mesh.has_volume ? std::optional(mesh.volume_mm3) : std::nullopt, "after")));
  const std::string_view state = name_of(verdict.state);
  console.print(
      summary.path.empty()
          ? fmt::format("  not written (dry run): {} bytes, {}", summary.bytes, state)
          : fmt::format("  written: {}, {} bytes, {}", summary.path, summary.bytes, state));
}

/// The next command for a mesh that is not sound.
std::string next_step(const std::string& file, const Verdict& verdict) {
  const std::string repair = fmt::format("claystack check {} --repair ", file);
  if (verdict.state == MeshState::prints)
    return repair + "-o FILE makes one body of it; --accept prints accepts it as it is";
  return repair + "--dry-run reports what a repair changes, or why it is not possible";
}

/// "sound", or "sound; walls: fail".
std::string headline(MeshState state, const std::vector<Finding>& findings) {
  std::string text(name_of(state));
  if (state == MeshState::prints) text += " (not sound, but a slicer unites its shells)";
  std::vector<std::string> failed;
  for (const Finding& finding : findings)
    if (finding.grade == Grade::fail && std::ranges::find(failed, finding.check) == failed.end()) {
      failed.push_back(finding.check);
      text += fmt::format("; {}: fail", finding.check);
    }
  return text;
}

/// With --quiet: the faults, on standard error.
void print_faults(const Console& console, const std::string& file, const Verdict& verdict) {
  for (const auto& problem : verdict.mesh.problems)
    console.error(file + ": " + problem_text(problem));
  for (const auto& [check, grade, text] : verdict.findings) {
    const std::string line = fmt::format("{}: {}: {}", file, check, text);
    if (grade == Grade::fail) console.error(line);
    if (grade == Grade::warn) console.warn(line);
  }
}

}  // namespace

void print_verdict(const Console& console, const std::string& file, const Verdict& verdict) {
  if (console.quiet && !console.json) return print_faults(console, file, verdict);
  const solid::MeshReport& mesh = verdict.mesh;
  const bool was_repaired = verdict.repair_summary.has_value();
  const std::string found = headline(verdict.state, verdict.findings);
  console.print(was_repaired ? fmt::format("{}: {} before, the result: {}", file,
                                           name_of(verdict.repair_summary->before), found)
                             : fmt::format("{}: {}", file, found));
  if (was_repaired) print_repair(console, *verdict.repair_summary, verdict);
  for (const auto& problem : mesh.problems)
    console.print((was_repaired ? "  remaining: " : "  ") + problem_text(problem));
  const auto yes = [](bool value) { return value ? "yes" : "no"; };
  if (verdict.examined) {
    console.print(fmt::format(
        "  closed {}, manifold {}, oriented {}, bounds a volume {}, self-intersections {}",
        yes(mesh.closed), yes(mesh.manifold), yes(mesh.oriented), yes(mesh.bounds_volume),
        mesh.self_intersections));
    console.print(fmt::format("  {}, {}, {}", counted(mesh.triangles, "triangle"),
                              counted(mesh.components, "component"), volume_text(mesh)));
    console.print(
        fmt::format("  {:.6g} x {:.6g} x {:.6g} mm (width x depth x height), surface {:.4g} cm2",
                    mesh.size_mm.x, mesh.size_mm.y, mesh.size_mm.z, mesh.area_mm2 / 100.0));
  }
  if (verdict.wall_mm)
    console.print(fmt::format("  minimum wall {} mm ({})", bound_text(*verdict.wall_mm, 3),
                              solid::text_of(verdict.wall_parts)));
  if (verdict.wall_sampled) print_wall(console, *verdict.wall_sampled);
  if (verdict.certificate_holds) print_certificate(console, *verdict.certificate);
  for (const auto& [check, grade, text] : verdict.findings)
    console.print(fmt::format("  {}: {}: {}", check, name_of(grade), text));
  for (const std::string& note : verdict.notes) console.print("  note: " + note);
  const bool mesh_of_file = verdict.examined && !was_repaired && !verdict.wall_mm;
  if (mesh_of_file &&
      (verdict.state == MeshState::prints || verdict.state == MeshState::will_not_print))
    console.print("  next: " + next_step(file, verdict));
}

}  // namespace clay::cli
