// The verdict of `claystack check` as JSON.

#include "app/cli/check.hpp"
#include "app/cli/export_json.hpp"

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
                         {"median_mm", wall->median_mm},
                         {"wrapped", wall->wrapped},
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

Json findings_json(const std::vector<Finding>& findings) {
  Json json = Json::array();
  for (const auto& [check, grade, text] : findings)
    json.push_back({{"check", check}, {"verdict", name_of(grade)}, {"text", text}});
  return json;
}

}  // namespace

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

}  // namespace clay::cli
