#include "app/cli/export_report.hpp"
#include "app/cli/export_run.hpp"
#include "app/cli/thin_walls.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

using solid::ExportReport;
using solid::FileReport;

std::string_view proof_of(const FileReport& file) {
  return file.proof == solid::Proof::margins ? "the profile's margins cover the rounding"
                                             : "no two triangles as written meet (exact test)";
}

/// What the planar certificate says, and where it ends.
std::string_view proof_of(const ExportReport& report) {
  if (report.collapsed)
    return "each part before the fall: closed and embedded; the whole: no self-intersection by "
           "exact predicates on the mesh as rounded to float32";
  return "closed and embedded: the profile is strictly simple and meets the axis in segments only";
}

Json file_json(const FileReport& file, const std::string& path) {
  Json json = {{"path", path},
               {"format", solid::name_of(file.format)},
               {"bytes", file.bytes},
               {"content_hash", file.content_hash},
               {"max_error_mm", file.max_error_mm},
               {"proof", file.proof == solid::Proof::margins ? "margins" : "exact_test"},
               {"read_again", file.read_again}};
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

/// Of files that say nothing of themselves: the section, and the table of walls.
std::string_view plain_format_of(std::string_view path) {
  if (path.ends_with(".svg")) return "svg";
  return path.ends_with(".csv") ? "csv" : "";
}

void tell_file(const Console& console, const FileReport& file, const std::string& path) {
  console.say(fmt::format("{}: {}, {} bytes; vertices within {:.2g} mm; {}{}{}", path,
                          solid::name_of(file.format), file.bytes, file.max_error_mm,
                          proof_of(file), file.read_again ? "; read again" : "",
                          file.full_verification ? "; checked in full" : ""));
  if (const auto& c = file.certificate)
    console.say(fmt::format("  wall {:.4f} to {:.4f} mm at its thinnest, volume within {:.2g} mm3",
                            c->wall_lower_mm, c->wall_upper_mm, c->volume_bound_mm3));
}

void tell_collapse(const Console& console, const solid::CollapsedSolid& collapsed) {
  const auto cm3 = [](double mm3) { return mm3 / 1000.0; };
  console.say(fmt::format(
      "collapsed: {:.3f} cm3 stand and {:.3f} cm3 fell; they overlap by {:.3f} cm3, so that the "
      "union holds {:.3f} cm3",
      cm3(collapsed.lower_mm3), cm3(collapsed.upper_mm3), cm3(collapsed.overlap_mm3),
      cm3(collapsed.union_mm3)));
  if (collapsed.pieces > 1)
    console.warn(fmt::format("the file holds {} bodies that do not touch", collapsed.pieces));
  if (collapsed.voids > 0)
    console.warn(fmt::format("{} closed cavities hold {:.3g} cm3: they need drain holes",
                             collapsed.voids, cm3(collapsed.voids_mm3)));
}

/// Where smoothing gave way: one line for each reason.
void tell_smoothing(const Console& console, const ExportReport& report) {
  for (const auto reason : {solid::KeptFor::wall, solid::KeptFor::overshoot, solid::KeptFor::volume,
                            solid::KeptFor::certificate}) {
    const auto is = [&](const solid::KeptSteps& kept) { return kept.reason == reason; };
    const auto first = std::find_if(report.kept_steps.begin(), report.kept_steps.end(), is);
    if (first == report.kept_steps.end()) continue;
    console.say(fmt::format(
        "steps kept for {}: {} stretch(es), the first from {:.2f} to {:.2f} mm ({:.3f} mm if "
        "smoothed)",
        solid::name_of(reason),
        std::count_if(report.kept_steps.begin(), report.kept_steps.end(), is), first->from_mm,
        first->to_mm, first->smoothed_mm));
  }
  if (report.wall_as_steps_mm)
    console.warn(
        fmt::format("exact walls leave an edge of {:.3f} mm at height {:.1f} mm, where the "
                    "steps are {:.3f} mm at least; --smooth fair does not",
                    report.min_wall_mm, report.thinnest.from.y, *report.wall_as_steps_mm));
  if (report.taken_mm > 0.0)
    console.warn(
        fmt::format("walls may be thinner than they were by {:.2g} mm: no other clay to "
                    "take from",
                    report.taken_mm));
}

void tell_shrinkage(const Console& console, const ExportReport& report) {
  if (report.shrinkage == 0.0) return;
  const double fired = 1.0 - report.shrinkage;
  console.say(fmt::format(
      "for a shrinkage of {:g} % the files are larger: {:.2f} mm wide and {:.2f} mm high, to come "
      "out {:.2f} mm wide and {:.2f} mm high",
      100.0 * report.shrinkage, report.diameter_mm, report.height_mm, fired * report.diameter_mm,
      fired * report.height_mm));
}

void tell_solid(const Console& console, const ExportReport& report) {
  console.say(
      fmt::format("proved: {}closed and embedded, from {} profile vertices; {} triangles in "
                  "{} shell(s)",
                  report.collapsed ? "each part before the fall " : "", report.planar.vertices,
                  report.triangles, report.shells));
  console.say(
      fmt::format("volume {:.3f} cm3, {}off the counted clay by {:.1e}; thinnest {:.2f} mm, at "
                  "height {:.1f} mm; chordal error {:.3g} mm",
                  report.volume_mm3 / 1000.0, report.collapsed ? "with the overlap " : "",
                  report.volume_error_relative, report.min_wall_mm, report.thinnest.from.y,
                  report.chordal_error_mm));
  tell_shrinkage(console, report);
  if (report.collapsed) tell_collapse(console, *report.collapsed);
  tell_smoothing(console, report);
  for (const auto& [what, why, saved] : report.left_out)
    if (saved) console.say(fmt::format("left out: {} ({}), saved {:.2g} s", what, why, *saved));
}

/// What was made and proved.
Json solid_json(const ExportReport& report) {
  Json json = {
      {"triangles", report.triangles},
      {"shells", report.shells},
      {"segments", report.segments},
      {"smoothing", solid::name_of(report.smoothing)},
      {"tolerance_mm", report.tolerance_mm},
      {"chordal_error_mm", report.chordal_error_mm},
      {"volume_mm3", report.volume_mm3},
      {"counted_volume_mm3", report.counted_volume_mm3},
      {"volume_error_relative", report.volume_error_relative},
      {"min_wall_mm", report.min_wall_mm},
      {"thinnest_at_mm",
       {{report.thinnest.from.rho, report.thinnest.from.y},
        {report.thinnest.to.rho, report.thinnest.to.y}}},
      {"diameter_mm", report.diameter_mm},
      {"height_mm", report.height_mm},
      {"certificate",
       {{"proved", proof_of(report)},
        {"polygons", report.planar.polygons},
        {"vertices", report.planar.vertices},
        {"axis_segments", report.planar.axis_segments}}},
      {"overshoot_mm", report.overshoot_mm},
      {"kept_steps", Json::array()},
      {"cavities", Json::array()},
  };
  for (const auto& shape : report.shapes)
    for (const auto& cavity : shape.cavities)
      json["cavities"].push_back({{"bottom_mm", cavity.bottom_mm},
                                  {"top_mm", cavity.top_mm},
                                  {"volume_mm3", cavity.volume_mm3}});
  for (const auto& kept : report.kept_steps) json["kept_steps"].push_back(kept_json(kept));
  if (report.shrinkage > 0.0) {
    const double fired = 1.0 - report.shrinkage;
    json["shrinkage"] = {{"part", report.shrinkage},
                         {"fired_diameter_mm", fired * report.diameter_mm},
                         {"fired_height_mm", fired * report.height_mm},
                         {"fired_volume_mm3", fired * fired * fired * report.volume_mm3}};
  }
  if (report.collapsed) json["collapsed"] = collapsed_json(*report.collapsed);
  if (report.drilled_mm3 > 0.0) json["drilled_mm3"] = report.drilled_mm3;
  if (report.smoothing == solid::Smoothing::exact)
    json["max_ring_error_relative"] = report.max_ring_error_relative;
  if (report.wall_as_steps_mm) json["wall_as_steps_mm"] = *report.wall_as_steps_mm;
  if (report.lip_fillet_mm > 0.0) json["lip_fillet_mm"] = report.lip_fillet_mm;
  if (report.taken_mm > 0.0) json["taken_mm"] = report.taken_mm;
  return json;
}

}  // namespace

Json export_json(const ExportReport& report, const std::vector<PotCopy>& copies,
                 const std::vector<std::string>& paths, const std::optional<WallDemand>& demand) {
  Json json = report.files.empty() ? Json::object() : solid_json(report);
  for (const char* list : {"files", "left_out", "stages"}) json[list] = Json::array();
  if (demand && !report.files.empty())
    json["wall_demand"] = {{"min_wall_mm", demand->min_wall_mm},
                           {"source", demand->source},
                           {"passes", thinnest_mm(report) >= demand->min_wall_mm}};
  auto file = report.files.begin();
  auto copy = copies.begin();
  for (const std::string& path : paths) {
    const std::string_view plain = plain_format_of(path);
    json["files"].push_back(!plain.empty()          ? Json{{"path", path}, {"format", plain}}
                            : pot_encoding_of(path) ? copy_json(*copy++, path)
                                                    : file_json(*file++, path));
  }
  for (const auto& [what, why, saved] : report.left_out) {
    json["left_out"].push_back({{"what", what}, {"why", why}});
    if (saved) json["left_out"].back()["saved_s"] = *saved;
  }
  for (const auto& [name, seconds] : report.stages)
    json["stages"].push_back({{"name", name}, {"seconds", seconds}});
  return json;
}

void tell_export(const Console& console, const ExportReport& report,
                 const std::vector<PotCopy>& copies, const std::vector<std::string>& paths) {
  if (!report.files.empty()) tell_solid(console, report);
  if (report.drilled_mm3 > 0.0)
    console.say(
        fmt::format("drain drilled, {:.3f} cm3 of clay taken", report.drilled_mm3 / 1000.0));
  for (const auto& shape : report.shapes)
    for (const auto& cavity : shape.cavities) console.warn(text_of(cavity));
  auto file = report.files.begin();
  auto copy = copies.begin();
  for (const std::string& path : paths) {
    if (const std::string_view plain = plain_format_of(path); !plain.empty())
      console.say(path + (plain == "svg" ? ": section" : ": walls along the section"));
    else if (pot_encoding_of(path))
      console.say(copy_text(*copy++, path));
    else
      tell_file(console, *file++, path);
  }
}

bool tell_thin_wall(const Console& console, const ExportReport& report,
                    const std::optional<WallDemand>& demand) {
  if (!demand || report.files.empty()) return false;
  if (const auto thin = thin_wall_of(report, demand)) {
    console.warn(*thin);
    return true;
  }
  console.say("walls: " + wall_text(thinnest_mm(report), *demand));
  return false;
}

}  // namespace clay::cli
