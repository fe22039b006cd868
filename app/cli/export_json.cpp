#include "app/cli/export_json.hpp"

#include "app/cli/export_figures.hpp"
#include "app/cli/maker_table.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>

namespace clay::cli {
namespace {

using solid::ExportReport;
using solid::FileKind;
using solid::FileReport;

/// The scope of the planar certificate.
std::string_view proof_of(const ExportReport& report) {
  if (report.collapsed)
    return "each part before the fall: closed and embedded; the whole: no self-intersection by "
           "exact predicates on the mesh as rounded to float32";
  return "closed and embedded: the profile is strictly simple and meets the axis in segments only";
}

Json copy_json(const PotCopy& copy, const std::string& path) {
  Json json = {{"path", path},
               {"format", copy.encoding == PotEncoding::cbor ? "pot.cbor" : "pot.json"},
               {"bytes", copy.bytes}};
  if (copy.rounded_to_mm) {
    json["rounded_to_mm"] = *copy.rounded_to_mm;
    json["volume_change_mm3"] = copy.change_mm3;
    json["volume_change_relative"] = copy.change_relative;
  }
  return json;
}

Json file_json(const FileReport& file) {
  Json json = {{"path", file.path},
               {"format", solid::name_of(file.format)},
               {"bytes", file.bytes},
               {"content_hash", file.content_hash},
               {"max_error_mm", file.max_error_mm},
               {"proof", file.proof == solid::Proof::margins ? "margins" : "exact_test"},
               {"read_back", file.read_back}};
  if (const auto& c = file.certificate) {
    json["safe_rounding_mm"] = c->margins.safe_rounding_mm();
    json["wall_mm"] = {c->wall_lower_mm, c->wall_upper_mm};
    json["volume_bound_mm3"] = c->volume_bound_mm3;
  }
  if (file.full_verification)
    json["full_verification"] = {{"sound", file.full_verification->sound()},
                                 {"self_intersections", file.full_verification->self_intersections},
                                 {"volume_mm3", file.full_verification->volume_mm3}};
  return json;
}

Json step_json(const FileReport& file) {
  const solid::StepReport& step = *file.step;
  return {{"path", file.path},
          {"format", "step"},
          {"bytes", file.bytes},
          {"content_hash", file.content_hash},
          {"max_error_mm", file.max_error_mm},
          {"read_back", file.read_back},
          {"walls", step.walls == solid::StepWalls::lines ? "lines" : "spline"},
          {"faces", step.faces},
          {"volume_mm3", step.volume_mm3},
          {"volume_error_relative", step.volume_error_relative},
          {"min_wall_mm", step.min_wall_mm}};
}

Json kept_json(const solid::KeptSteps& kept) {
  return {{"from_mm", kept.from_mm},
          {"to_mm", kept.to_mm},
          {"for", solid::name_of(kept.reason)},
          {"smoothed_mm", kept.smoothed_mm},
          {"kept_mm", kept.kept_mm}};
}

Json fairing_json(const solid::FairingReport& fairing) {
  Json json = {{"length_mm", fairing.length_mm},
               {"moved_mm", fairing.moved_mm},
               {"moved_at_mm", fairing.moved_at_mm},
               {"shortened", Json::array()}};
  for (const solid::ShortenedFairing& shortened : fairing.shortened)
    json["shortened"].push_back({{"from_mm", shortened.from_mm},
                                 {"to_mm", shortened.to_mm},
                                 {"length_mm", shortened.length_mm}});
  return json;
}

void add_smoothing(Json& json, const solid::ProvedSection& section) {
  const solid::SmoothedProfile& smoothed = section.smoothed;
  json["smoothing"] = solid::name_of(section.smoothing);
  json["overshoot_mm"] = smoothed.overshoot_mm;
  json["extrapolated_mm"] = smoothed.extrapolated_mm;
  json["kept_steps"] = Json::array();
  for (const auto& kept : smoothed.guard) json["kept_steps"].push_back(kept_json(kept));
  if (section.smoothing == solid::Smoothing::exact)
    json["max_ring_error_relative"] = smoothed.max_ring_error_relative;
  if (smoothed.fairing.length_mm > 0.0) json["fairing"] = fairing_json(smoothed.fairing);
  if (smoothed.lip_fillet_mm > 0.0) json["lip_fillet_mm"] = smoothed.lip_fillet_mm;
  if (smoothed.taken_mm > 0.0) json["taken_mm"] = smoothed.taken_mm;
}

Json collapsed_json(const solid::CollapsedSolid& collapsed) {
  return {{"lower_mm3", collapsed.lower_mm3},     {"upper_mm3", collapsed.upper_mm3},
          {"overlap_mm3", collapsed.overlap_mm3}, {"union_mm3", collapsed.union_mm3},
          {"pieces", collapsed.pieces},           {"voids", collapsed.voids},
          {"voids_mm3", collapsed.voids_mm3},     {"pockets", collapsed.pockets},
          {"pockets_mm3", collapsed.pockets_mm3}, {"max_move_mm", collapsed.max_move_mm}};
}

Json finish_json(const ExportReport& report) {
  const solid::FinishLedger& ledger = report.section.finish;
  const double g_per_mm3 = 1e-3 * report.maker->clay.density_g_cm3;
  return {{"trimmed_mm3", ledger.trimmed_mm3()},
          {"trimmed_g", g_per_mm3 * ledger.trimmed_mm3()},
          {"added_mm3", ledger.floor_added_mm3},
          {"added_g", g_per_mm3 * ledger.floor_added_mm3},
          {"foot_trimmed_mm3", ledger.foot_trimmed_mm3},
          {"glaze_trimmed_mm3", ledger.glaze_trimmed_mm3}};
}

Json shrinkage_json(const ExportReport& report) {
  const double fired = 1.0 - report.prepared.shrinkage;
  const solid::PotSize size = size_in_files(report);
  return {{"part", report.prepared.shrinkage},
          {"fired_diameter_mm", fired * size.diameter_mm},
          {"fired_height_mm", fired * size.height_mm},
          {"fired_volume_mm3", fired * fired * fired * report.volume.solid_mm3}};
}

Json cavities_json(const std::vector<solid::PieceShape>& shapes) {
  Json json = Json::array();
  for (const auto& shape : shapes)
    for (const auto& cavity : shape.cavities)
      json.push_back({{"bottom_mm", cavity.bottom_mm},
                      {"top_mm", cavity.top_mm},
                      {"volume_mm3", cavity.volume_mm3}});
  return json;
}

/// The solid and its proof.
Json solid_json(const ExportReport& report) {
  Json json = {
      {"triangles", report.size.triangles},
      {"shells", report.size.shells},
      {"segments", report.size.segments},
      {"tolerance_mm", report.size.tolerance_mm},
      {"chordal_error_mm", report.size.chordal_error_mm},
      {"volume_mm3", report.volume.solid_mm3},
      {"counted_volume_mm3", report.prepared.counted_volume_mm3},
      {"volume_error_relative", report.volume.error_relative},
      {"min_wall_mm", report.thinnest_mm()},
      {"thinnest_at_mm",
       {{report.walls.thinnest.from.rho, report.walls.thinnest.from.y},
        {report.walls.thinnest.to.rho, report.walls.thinnest.to.y}}},
      {"diameter_mm", report.size.diameter_mm},
      {"height_mm", report.size.height_mm},
      {"certificate",
       {{"proved", proof_of(report)},
        {"polygons", report.section.planar.polygons},
        {"vertices", report.section.planar.vertices},
        {"axis_segments", report.section.planar.axis_segments}}},
      {"cavities", cavities_json(report.section.shapes())},
  };
  add_smoothing(json, report.section);
  if (report.prepared.shrinkage > 0.0) json["shrinkage"] = shrinkage_json(report);
  if (report.collapsed) json["collapsed"] = collapsed_json(*report.collapsed);
  if (report.prepared.drain_mm > 0.0) {
    json["drain_mm"] = report.prepared.drain_mm;
    json["drilled_mm3"] = report.prepared.drilled_mm3;
  }
  if (report.section.finish.any()) json["finish"] = finish_json(report);
  if (report.walls.as_steps_mm) json["wall_as_steps_mm"] = *report.walls.as_steps_mm;
  if (!report.walls.parts.empty()) json["wall_parts"] = wall_parts_json(report.walls.parts);
  return json;
}

Json problems_json(const ExportReport& report) {
  Json json = Json::array();
  for (const solid::Problem& problem : solid::problems_of(report)) {
    json.push_back({{"text", problem.text}, {"fails", problem.fails}});
    if (problem.at) json.back()["at_mm"] = {problem.at->rho, problem.at->y};
  }
  return json;
}

Json overhang_json(const solid::ProcessReport& process) {
  const solid::Overhang& overhang = *process.overhang;
  Json json = {{"angle_deg", overhang.angle_deg}, {"at_mm", {overhang.at.rho, overhang.at.y}}};
  if (!process.limits || !process.limits->overhang) return json;
  const solid::OverhangLimit& limit = *process.limits->overhang;
  json["limit_deg"] = limit.max_deg;
  json["source"] = limit.source;
  json["passes"] = limit.met_by(overhang.angle_deg);
  return json;
}

/// Whether the solid fits into the machine, kiln or service.
Json process_json(const ExportReport& report, const solid::ProcessLimits& process) {
  Json json = {{"name", process.name}, {"fired", process.fired}, {"bed", nullptr}};
  if (!process.size) return json;
  const solid::SizeLimit& most = *process.size;
  json["bed"] = {{"width_mm", most.width_mm},
                 {"depth_mm", most.depth_mm},
                 {"height_mm", most.height_mm},
                 {"source", most.source},
                 {"fits", most.fits(report.size.extents_mm)}};
  return json;
}

Json goal_json(const std::optional<solid::MetGoal>& met) {
  if (!met) return nullptr;
  const solid::Goal& goal = met->goal;
  const auto number = [](const std::optional<double>& n) { return n ? Json(*n) : Json(); };
  return {{"holds_ml", number(goal.holds_ml)},
          {"weighs_g", number(goal.weighs_g)},
          {"height_mm", number(goal.height_mm)},
          {"diameter_mm", number(goal.diameter_mm)},
          {"to_fill_line", goal.to_fill_line},
          {"state", !goal.fired   ? "thrown"
                    : met->glazed ? "glazed"
                                  : "fired"},
          {"radius_factor", met->radius_factor},
          {"height_factor", met->height_factor}};
}

}  // namespace

Json wall_parts_json(const std::vector<solid::PartWall>& parts) {
  Json json = Json::array();
  for (const auto& [part, thickness_mm, at] : parts)
    json.push_back(
        {{"part", solid::name_of(part)}, {"min_wall_mm", thickness_mm}, {"at_mm", {at.rho, at.y}}});
  return json;
}

Json export_json(const ExportReport& report, const std::vector<PotCopy>& copies,
                 const std::optional<solid::MetGoal>& goal) {
  Json json = report.has_solid() ? solid_json(report) : Json::object();
  for (const char* list : {"files", "left_out", "stages"}) json[list] = Json::array();
  if (const auto& limit = report.walls.limit; limit && report.has_solid())
    json["wall_demand"] = {{"min_wall_mm", limit->min_wall_mm},
                           {"source", limit->asked_by()},
                           {"passes", limit->met_by(report.thinnest_mm())}};
  if (report.process.overhang) json["overhang"] = overhang_json(report.process);
  if (const auto& process = report.process.limits) json["process"] = process_json(report, *process);
  json["maker"] = maker_json(report);
  json["goal"] = goal_json(goal);
  json["passes"] = std::ranges::none_of(solid::problems_of(report), &solid::Problem::fails);
  json["problems"] = problems_json(report);
  auto copy = copies.begin();
  for (const FileReport& file : report.files) {
    switch (file.kind) {
      case FileKind::mesh:
        json["files"].push_back(file_json(file));
        break;
      case FileKind::step:
        json["files"].push_back(step_json(file));
        break;
      case FileKind::section:
      case FileKind::wall_table:
        json["files"].push_back(
            {{"path", file.path}, {"format", section_facts(file).name}, {"bytes", file.bytes}});
        break;
      case FileKind::given:
        json["files"].push_back(copy_json(*copy++, file.path));
        break;
    }
  }
  for (const auto& [what, why, saved] : report.left_out) {
    json["left_out"].push_back({{"what", what}, {"why", why}});
    if (saved) json["left_out"].back()["saved_s"] = *saved;
  }
  for (const auto& [name, seconds] : report.stages)
    json["stages"].push_back({{"name", name}, {"seconds", seconds}});
  return json;
}

}  // namespace clay::cli
