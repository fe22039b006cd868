#include "app/cli/check.hpp"
#include "app/cli/export_json.hpp"
#include "core/size_text.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

template <class Problems>
Json problems_json(const Problems& problems) {
  Json json = Json::array();
  for (const auto& problem : problems)
    json.push_back({{"what", problem.what}, {"where", problem.where}, {"count", problem.count}});
  return json;
}

Json wall_json(const solid::SampledWall& wall, bool united) {
  Json json = {{"least_mm", nullptr},     {"rays", wall.rays}, {"oblique", wall.oblique},
               {"escaped", wall.escaped}, {"bound", false},    {"united", united}};
  if (std::isinf(wall.least_mm)) return json;
  json["least_mm"] = wall.least_mm;
  json["at_mm"] = {wall.place.x, wall.place.y, wall.place.z};
  if (!united) json["triangle"] = wall.triangle;  // of the file
  return json;
}

Json volume_json(const std::optional<double>& mm3) { return mm3 ? Json(*mm3) : Json(); }

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

void add_repair(Json& json, const RepairSummary& summary, const Verdict& verdict) {
  json["found"] = problems_json(summary.found);
  json["repaired"] = Json::array();
  for (const auto& [what, count] : summary.repaired)
    json["repaired"].push_back({{"what", what}, {"count", count}});
  json["holes"] = Json::array();
  for (const solid::FilledHole& hole : summary.holes)
    json["holes"].push_back({{"edges", hole.edges},
                             {"extent_mm", hole.extent_mm},
                             {"area_mm2", hole.area_mm2},
                             {"at_mm", {hole.place.x, hole.place.y, hole.place.z}}});
  if (const auto& wall = summary.thickened)
    json["thickened"] = {{"asked_mm", wall->asked_mm},
                         {"least_mm", wall->least_mm},
                         {"bound", false},
                         {"filled_share", wall->filled_share}};
  json["change"] = {{"added_mm", summary.change.added_mm},
                    {"removed_mm", summary.change.removed_mm},
                    {"reading_mm", summary.reading_mm},
                    {"bound", true}};
  if (summary.wrapped_mm) json["wrapped_mm"] = *summary.wrapped_mm;
  json["volume_before_mm3"] = volume_json(summary.volume_before_mm3);
  json["remaining"] = problems_json(verdict.mesh.problems);
  if (summary.decimation_error_mm)
    json["decimated"] = {{"from_triangles", summary.triangles_before},
                         {"to_triangles", verdict.mesh.triangles},
                         {"max_error_mm", *summary.decimation_error_mm}};
  json["written"] = nullptr;
  if (!summary.path.empty())
    json["written"] = {{"path", summary.path},
                       {"format", solid::name_of(summary.format)},
                       {"bytes", summary.bytes}};
}

Json certificate_json(const solid::SolidCertificate& certificate, bool holds) {
  return {{"holds", holds},
          {"wall_mm", {certificate.wall_lower_mm, certificate.wall_upper_mm}},
          {"volume_mm3", certificate.volume_mm3},
          {"volume_bound_mm3", certificate.volume_bound_mm3},
          {"counted_volume_mm3", certificate.counted_volume_mm3}};
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
        size_text(wall.least_mm, 2), wall.place.x, wall.place.y, wall.place.z, wall.rays));
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
    console.print(fmt::format("  thickened: {:.4g} mm requested, thinnest sample {:.4g} mm",
                              wall->asked_mm, wall->least_mm));
  if (!summary.repaired.empty() || summary.change.added_mm > 0.0 || summary.change.removed_mm > 0.0)
    console.print(
        fmt::format("  change: the new surface within {:.3g} mm of the old one, the old one within "
                    "{:.3g} mm of the new one",
                    summary.change.added_mm, summary.change.removed_mm));
  constexpr double kLeastShownMm = 5e-4;
  if (summary.reading_mm >= kLeastShownMm)
    console.print(
        fmt::format("  read: points rounded to float32, by up to {:.3g} mm", summary.reading_mm));
  const std::string before =
      summary.volume_before_mm3 ? fmt::format("{:.6g} cm3 before", *summary.volume_before_mm3 / 1e3)
                                : std::string("none before, because the mesh enclosed none");
  console.print(
      fmt::format("  volume: {}, {:.6g} cm3 after", before, verdict.mesh.volume_mm3 / 1e3));
  const std::string_view state = name_of(verdict.state);
  console.print(
      summary.path.empty()
          ? fmt::format("  not written (dry run): {} bytes, {}", summary.bytes, state)
          : fmt::format("  written: {}, {} bytes, {}", summary.path, summary.bytes, state));
}

Json findings_json(const std::vector<Finding>& findings) {
  Json json = Json::array();
  for (const auto& [check, grade, text] : findings)
    json.push_back({{"check", check}, {"verdict", name_of(grade)}, {"text", text}});
  return json;
}

/// What to do with a mesh that is not sound.
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

}  // namespace

std::string_view name_of(MeshState state) {
  switch (state) {
    case MeshState::sound:
      return "sound";
    case MeshState::prints:
      return "prints";
    case MeshState::will_not_print:
      return "will not print";
    default:
      return "unreadable";
  }
}

MeshState state_of(const solid::TriangleMesh& mesh, const solid::MeshReport& report) {
  if (report.sound()) return MeshState::sound;
  return solid::slicer_unites(mesh, report) ? MeshState::prints : MeshState::will_not_print;
}

std::string check_name(solid::ProblemKind kind) {
  switch (kind) {
    case solid::ProblemKind::thin_wall:
      return "walls";
    case solid::ProblemKind::too_large:
    case solid::ProblemKind::overhang:
      return "process";
    case solid::ProblemKind::cavity:
    case solid::ProblemKind::drain:
    case solid::ProblemKind::bodies:
    case solid::ProblemKind::lip_fillet:
      break;
  }
  return "geometry";
}

std::string_view name_of(Grade grade) {
  return grade == Grade::pass ? "pass" : grade == Grade::warn ? "warn" : "fail";
}

bool Verdict::passes(bool accept_prints) const {
  const bool accepted = state == MeshState::sound || (accept_prints && state == MeshState::prints);
  return accepted && !failure && std::ranges::none_of(findings, [](const Finding& finding) {
           return finding.grade == Grade::fail;
         });
}

Verdict not_examined(MeshState state, std::string what, std::string where) {
  Verdict verdict;
  verdict.state = state;
  verdict.examined = false;
  verdict.mesh.problems.push_back({std::move(what), std::move(where), 1, false});
  return verdict;
}

Json verdict_json(const std::string& file, const Verdict& verdict, bool accept_prints) {
  const solid::MeshReport& mesh = verdict.mesh;
  Json json = {{"file", file},
               {"verdict", name_of(verdict.state)},
               {"passes", verdict.passes(accept_prints)},
               {"sound", verdict.state == MeshState::sound},
               {"closed", mesh.closed},
               {"manifold", mesh.manifold},
               {"oriented", mesh.oriented},
               {"self_intersections", mesh.self_intersections},
               {"bounds_volume", mesh.bounds_volume},
               {"components", mesh.components},
               {"cavities", mesh.cavities},
               {"trapped_mm3", mesh.trapped_mm3},
               {"degenerate", mesh.degenerate},
               {"triangles", mesh.triangles},
               {"volume_mm3", mesh.has_volume ? Json(mesh.volume_mm3) : Json()},
               {"problems", problems_json(mesh.problems)},
               {"checks", findings_json(verdict.findings)}};
  if (verdict.examined) {
    json["size_mm"] = {mesh.size_mm.x, mesh.size_mm.y, mesh.size_mm.z};
    json["area_mm2"] = mesh.area_mm2;
  }
  if (verdict.wall_mm) {
    json["min_wall_mm"] = *verdict.wall_mm;
    json["wall_parts"] = wall_parts_json(verdict.wall_parts);
  }
  if (verdict.wall_sampled)
    json["wall_sampled"] = wall_json(*verdict.wall_sampled, verdict.wall_united);
  if (verdict.certificate)
    json["certificate"] = certificate_json(*verdict.certificate, verdict.certificate_holds);
  json["notes"] = verdict.notes;
  if (verdict.repair_summary) add_repair(json, *verdict.repair_summary, verdict);
  return json;
}

namespace {

/// "open edge (3): triangle 12 at (1, 2, 3) mm".
std::string problem_text(const solid::MeshProblem& problem) {
  return fmt::format("{} ({}{}): {}", problem.what, problem.at_least ? "at least " : "",
                     problem.count, problem.where);
}

/// With --quiet: what is wrong, on standard error.
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
