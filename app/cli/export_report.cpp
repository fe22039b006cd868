#include "app/cli/export_report.hpp"

#include "app/cli/maker_table.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

using solid::ExportReport;
using solid::FileKind;
using solid::FileReport;

/// The smallest --tolerance. A change of a wall by less is not worth a warning.
constexpr double kLeastShownMm = 1e-5;

std::string_view proof_of(const FileReport& file) {
  return file.proof == solid::Proof::margins
             ? "the margins of the profile exceed the rounding"
             : "no two triangles in the file intersect (exact test)";
}

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

/// Of a drawing or a table, whose name `export_files` has checked.
const solid::SectionFile& section_facts(const FileReport& file) {
  const solid::SectionFile* const facts = solid::section_file(file.path);
  assert(facts != nullptr);
  return *facts;
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

Json collapsed_json(const solid::CollapsedSolid& collapsed) {
  return {{"lower_mm3", collapsed.lower_mm3},     {"upper_mm3", collapsed.upper_mm3},
          {"overlap_mm3", collapsed.overlap_mm3}, {"union_mm3", collapsed.union_mm3},
          {"pieces", collapsed.pieces},           {"voids", collapsed.voids},
          {"voids_mm3", collapsed.voids_mm3},     {"pockets", collapsed.pockets},
          {"pockets_mm3", collapsed.pockets_mm3}, {"max_move_mm", collapsed.max_move_mm}};
}

void print_file(const Console& console, const ExportReport& report, const FileReport& file) {
  console.print(fmt::format("{}: {} bytes, within {:.2g} mm of the round solid{}", file.path,
                            file.bytes, distance_mm(report, file),
                            file.read_back ? ", read back" : ""));
  console.detail(fmt::format("  {}; {}{}", words_of_name(solid::name_of(file.format)),
                             proof_of(file), file.full_verification ? "; fully checked" : ""));
  if (const auto& c = file.certificate)
    console.detail(
        fmt::format("  minimum wall between {:.4f} and {:.4f} mm, volume within {:.2g} mm3",
                    c->wall_lower_mm, c->wall_upper_mm, c->volume_bound_mm3));
}

void print_step(const Console& console, const FileReport& file) {
  const solid::StepReport& step = *file.step;
  console.print(fmt::format("{}: {} bytes, {} faces, within {:.2g} mm{}", file.path, file.bytes,
                            step.faces, file.max_error_mm, file.read_back ? ", read back" : ""));
  console.detail(fmt::format(
      "  step; closed and embedded: the section of its surfaces is strictly simple\n"
      "  minimum wall {:.4f} mm; volume {:.3f} cm3, relative difference to the counted clay {:.1e}",
      step.min_wall_mm, step.volume_mm3 / 1000.0, step.volume_error_relative));
}

void print_collapse(const Console& console, const solid::CollapsedSolid& collapsed) {
  const auto cm3 = [](double mm3) { return mm3 / 1000.0; };
  console.print(fmt::format(
      "collapsed: {:.3f} cm3 standing, {:.3f} cm3 fallen; they overlap by {:.3f} cm3, so the "
      "union holds {:.3f} cm3",
      cm3(collapsed.lower_mm3), cm3(collapsed.upper_mm3), cm3(collapsed.overlap_mm3),
      cm3(collapsed.union_mm3)));
}

/// The walls that fairing moved, and where the walls made its length shorter.
void print_fairing(const Console& console, const solid::FairingReport& fairing) {
  if (fairing.length_mm == 0.0) return;
  console.detail(fmt::format(
      "faired over {:.3g} mm: walls moved by at most {:.3f} mm, at a height of {:.1f} mm",
      fairing.length_mm, fairing.moved_mm, fairing.moved_at_mm));
  if (fairing.shortened.empty()) return;
  const solid::ShortenedFairing& first = fairing.shortened.front();
  console.detail(fmt::format(
      "fairing shortened for walls in {}, the first from {:.2f} to {:.2f} mm ({:.3g} mm "
      "there)",
      counted(fairing.shortened.size(), "place"), first.from_mm, first.to_mm, first.length_mm));
}

/// Where smoothing kept steps: one line for each reason.
void print_smoothing(const Console& console, const ExportReport& report) {
  print_fairing(console, report.section.smoothed.fairing);
  for (const auto reason : {solid::KeptFor::wall, solid::KeptFor::overshoot, solid::KeptFor::volume,
                            solid::KeptFor::certificate}) {
    const auto is = [&](const solid::KeptSteps& kept) { return kept.reason == reason; };
    const auto first = std::find_if(report.section.smoothed.guard.begin(),
                                    report.section.smoothed.guard.end(), is);
    if (first == report.section.smoothed.guard.end()) continue;
    console.detail(fmt::format(
        "steps kept for {} in {}, the first from {:.2f} to {:.2f} mm ({:.3f} mm if "
        "smoothed)",
        solid::name_of(reason),
        counted(static_cast<std::size_t>(std::ranges::count_if(report.section.smoothed.guard, is)),
                "place"),
        first->from_mm, first->to_mm, first->smoothed_mm));
  }
  if (report.walls.as_steps_mm)
    console.warn(fmt::format(
        "exact smoothing gives a wall of {:.3f} mm at height {:.1f} mm, where the "
        "unsmoothed wall is at least {:.3f} mm; --smooth none keeps the steps",
        report.walls.min_wall_mm, report.walls.thinnest.from.y, *report.walls.as_steps_mm));
  if (report.section.smoothed.taken_mm >= kLeastShownMm)
    console.warn(
        fmt::format("smoothing may have thinned walls by {:.2g} mm, because no other clay "
                    "was available to keep the volume",
                    report.section.smoothed.taken_mm));
}

/// Of the round solid; of a collapsed pot, of its mesh.
solid::PotSize in_files(const ExportReport& report) {
  if (report.maker) return report.maker->thrown.size;
  return {report.size.diameter_mm, report.size.height_mm, 0.0};
}

void print_shrinkage(const Console& console, const ExportReport& report) {
  if (report.prepared.shrinkage == 0.0) return;
  const double fired = 1.0 - report.prepared.shrinkage;
  const solid::PotSize size = in_files(report);
  console.detail(fmt::format(
      "enlarged for a shrinkage of {:g} %: {:.2f} mm wide and {:.2f} mm high in the files, {:.2f} "
      "mm wide and {:.2f} mm high after firing",
      100.0 * report.prepared.shrinkage, size.diameter_mm, size.height_mm, fired * size.diameter_mm,
      fired * size.height_mm));
}

void print_solid(const Console& console, const ExportReport& report) {
  console.detail(fmt::format(
      "proved: {}closed and embedded, from {} profile vertices; {} triangles in "
      "{}",
      report.collapsed ? "each part before the fall " : "", report.section.planar.vertices,
      report.size.triangles, counted(report.size.shells, "shell")));
  console.detail(
      fmt::format("volume {:.3f} cm3, relative difference {}to the counted clay {:.1e}; minimum "
                  "wall {:.2f} mm at {}; chordal error {:.3g} mm",
                  report.volume.solid_mm3 / 1000.0, report.collapsed ? "with overlap " : "",
                  report.volume.error_relative, report.thinnest_mm(), thinnest_height(report),
                  report.size.chordal_error_mm));
  if (!report.walls.parts.empty())
    console.detail("thinnest places: " + solid::text_of(report.walls.parts));
  print_shrinkage(console, report);
  if (report.collapsed) print_collapse(console, *report.collapsed);
  print_smoothing(console, report);
  for (const auto& [what, why, saved] : report.left_out)
    if (saved)
      console.print(
          fmt::format("skipped: {} ({}), saved {:.2g} s", words_of_name(what), why, *saved));
}

/// The clay that finishing moved: "trimmed 12 g".
std::string clay_text(const ExportReport& report, double mm3) {
  return fmt::format("{:.0f} g ({:.2f} cm3)", 1e-3 * mm3 * report.maker->clay.density_g_cm3,
                     1e-3 * mm3);
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

Json finish_json(const ExportReport& report) {
  const solid::FinishLedger& ledger = report.section.finish;
  const double g_per_mm3 = 1e-3 * report.maker->clay.density_g_cm3;
  Json json = {{"trimmed_mm3", ledger.trimmed_mm3()},
               {"trimmed_g", g_per_mm3 * ledger.trimmed_mm3()},
               {"added_mm3", ledger.floor_added_mm3},
               {"added_g", g_per_mm3 * ledger.floor_added_mm3},
               {"foot_trimmed_mm3", ledger.foot_trimmed_mm3},
               {"glaze_trimmed_mm3", ledger.glaze_trimmed_mm3}};
  return json;
}

Json shrinkage_json(const ExportReport& report) {
  const double fired = 1.0 - report.prepared.shrinkage;
  const solid::PotSize size = in_files(report);
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

}  // namespace

namespace {

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

std::string verdict_of(const ExportReport& report) {
  std::size_t faults = 0, notes = 0;
  for (const solid::Problem& problem : solid::problems_of(report))
    ++(problem.fails ? faults : notes);
  const std::string solid =
      std::string(report.collapsed ? "collapsed; " : "") + "closed and without self-intersections";
  if (faults > 0) return fmt::format("{}, but {} failed", solid, counted(faults, "limit"));
  return notes > 0 ? fmt::format("{}; {}", solid, counted(notes, "warning")) : solid;
}

/// As precise as the line on the limit, if there is one.
std::string wall_row(const ExportReport& report) {
  return at_least_mm(report.thinnest_mm(), report.walls.limit ? 3 : 2) + ", thinnest at " +
         thinnest_height(report);
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

double distance_mm(const ExportReport& report, const FileReport& file) {
  if (file.kind == FileKind::mesh) return file.max_error_mm + report.size.chordal_error_mm;
  return file.kind == FileKind::step ? file.max_error_mm : 0.0;
}

std::string thinnest_height(const ExportReport& report) {
  return fmt::format("a height of {:.1f} mm{}", report.walls.thinnest.from.y,
                     report.collapsed ? " before the fall" : "");
}

Json wall_parts_json(const std::vector<solid::PartWall>& parts) {
  Json json = Json::array();
  for (const auto& [part, thickness_mm, at] : parts)
    json.push_back(
        {{"part", solid::name_of(part)}, {"min_wall_mm", thickness_mm}, {"at_mm", {at.rho, at.y}}});
  return json;
}

std::vector<std::pair<std::string, std::string>> finish_rows(const ExportReport& report) {
  const solid::FinishLedger& ledger = report.section.finish;
  std::vector<std::pair<std::string, std::string>> rows;
  const auto add = [&](const char* what, const char* how, double mm3) {
    if (mm3 != 0.0) rows.emplace_back(what, how + clay_text(report, mm3));
  };
  add("foot ring", "trimmed ", ledger.foot_trimmed_mm3);
  add("floor fillet", "added ", ledger.floor_added_mm3);
  add("glaze allowance", "trimmed ", ledger.glaze_trimmed_mm3);
  return rows;
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

void print_export(const Console& console, const ExportReport& report,
                  const std::vector<PotCopy>& copies) {
  if (report.has_solid()) print_solid(console, report);
  if (report.prepared.drilled_mm3 > 0.0)
    console.print(fmt::format("drain hole: {:g} mm wide, {:.3f} cm3 of clay removed",
                              report.prepared.drain_mm, report.prepared.drilled_mm3 / 1000.0));
  for (const auto& [what, clay] : finish_rows(report)) console.print(what + ": " + clay);
  auto copy = copies.begin();
  for (const FileReport& file : report.files) {
    switch (file.kind) {
      case FileKind::mesh:
        print_file(console, report, file);
        break;
      case FileKind::step:
        print_step(console, file);
        break;
      case FileKind::section:
      case FileKind::wall_table:
        console.print(fmt::format("{}: {}", file.path, section_facts(file).title));
        break;
      case FileKind::given:
        console.print(copy_text(*copy++, file.path));
        break;
    }
  }
}

void print_summary(const Console& console, const ExportReport& report) {
  if (report.has_solid())
    print_maker_table(console, maker_json(report), wall_row(report), verdict_of(report));
}

bool print_problems(const Console& console, const ExportReport& report) {
  bool fails = false;
  for (const solid::Problem& problem : solid::problems_of(report)) {
    if (problem.fails)
      console.error(problem.text);
    else
      console.warn(problem.text);
    fails = fails || problem.fails;
  }
  if (report.walls.limit && report.has_solid() && !solid::thin_wall_of(report))
    console.print("walls: " + solid::wall_text(report.thinnest_mm(), *report.walls.limit));
  return fails;
}

}  // namespace clay::cli
