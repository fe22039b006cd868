#include "export_report.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace clay::app {
namespace {

using solid::ExportReport;
using solid::FileReport;

std::string_view name_of(solid::Smoothing smoothing) {
  return smoothing == solid::Smoothing::fair ? "fair" : "none";
}

std::string_view proof_of(const FileReport& file) {
  return file.certificate.proof == solid::Proof::margins
             ? "the profile's margins cover the rounding"
             : "no two triangles as written meet (exact test)";
}

Json file_json(const FileReport& file, const std::string& path) {
  const solid::SolidCertificate& c = file.certificate;
  Json json = {{"path", path},
               {"format", c.format},
               {"bytes", c.bytes},
               {"content_hash", c.content_hash},
               {"max_error_mm", c.rounding_mm},
               {"proof", c.proof == solid::Proof::margins ? "margins" : "exact_test"},
               {"safe_rounding_mm", c.margins.safe_rounding_mm()},
               {"wall_mm", {c.wall_lower_mm, c.wall_upper_mm}},
               {"volume_bound_mm3", c.volume_bound_mm3},
               {"read_again", file.read_again}};
  if (file.full_verification)
    json["full_verification"] = {{"sound", file.full_verification->sound()},
                                 {"self_intersections", file.full_verification->self_intersections},
                                 {"volume_mm3", file.full_verification->volume_mm3}};
  return json;
}

bool is_drawing(const std::string& path) { return path.ends_with(".svg"); }

void tell_file(const Console& console, const FileReport& file, const std::string& path) {
  const solid::SolidCertificate& c = file.certificate;
  console.say(fmt::format("{}: {}, {} bytes; vertices within {:.2g} mm; {}{}{}", path, c.format,
                          c.bytes, c.rounding_mm, proof_of(file),
                          file.read_again ? "; read again" : "",
                          file.full_verification ? "; checked in full" : ""));
  console.say(fmt::format("  wall {:.4f} to {:.4f} mm at its thinnest, volume within {:.2g} mm3",
                          c.wall_lower_mm, c.wall_upper_mm, c.volume_bound_mm3));
}

}  // namespace

Json export_json(const ExportReport& report, const std::vector<PotCopy>& copies,
                 const std::vector<std::string>& paths, const std::optional<WallDemand>& demand) {
  Json json = {
      {"triangles", report.triangles},
      {"shells", report.shells},
      {"segments", report.segments},
      {"smoothing", name_of(report.smoothing)},
      {"tolerance_mm", report.tolerance_mm},
      {"chordal_error_mm", report.chordal_error_mm},
      {"volume_mm3", report.volume_mm3},
      {"counted_volume_mm3", report.counted_volume_mm3},
      {"volume_error_relative", report.volume_error_relative},
      {"min_wall_mm", report.min_wall_mm},
      {"diameter_mm", report.diameter_mm},
      {"height_mm", report.height_mm},
      {"certificate",
       {{"proved",
         "closed and embedded: the profile is strictly simple and meets the axis in segments only"},
        {"polygons", report.planar.polygons},
        {"vertices", report.planar.vertices},
        {"axis_segments", report.planar.axis_segments}}},
      {"cavities", Json::array()},
      {"files", Json::array()},
      {"left_out", Json::array()},
      {"stages", Json::array()},
  };
  for (const auto& shape : report.shapes)
    for (const auto& cavity : shape.cavities)
      json["cavities"].push_back({{"bottom_mm", cavity.bottom_mm},
                                  {"top_mm", cavity.top_mm},
                                  {"volume_mm3", cavity.volume_mm3}});
  if (report.drilled_mm3 > 0.0) json["drilled_mm3"] = report.drilled_mm3;
  if (demand)
    json["wall_demand"] = {{"min_wall_mm", demand->min_wall_mm}, {"source", demand->source}};
  auto file = report.files.begin();
  auto copy = copies.begin();
  for (const std::string& path : paths)
    json["files"].push_back(is_drawing(path)        ? Json{{"path", path}, {"format", "svg"}}
                            : pot_encoding_of(path) ? copy_json(*copy++, path)
                                                    : file_json(*file++, path));
  for (const auto& [what, why] : report.left_out)
    json["left_out"].push_back({{"what", what}, {"why", why}});
  for (const auto& [name, seconds] : report.stages)
    json["stages"].push_back({{"name", name}, {"seconds", seconds}});
  return json;
}

void tell_export(const Console& console, const ExportReport& report,
                 const std::vector<PotCopy>& copies, const std::vector<std::string>& paths) {
  if (!report.files.empty()) {
    console.say(fmt::format(
        "proved: closed and embedded, from {} profile vertices; {} triangles in {} shell(s)",
        report.planar.vertices, report.triangles, report.shells));
    console.say(fmt::format(
        "volume {:.3f} cm3, off the counted clay by {:.1e}; thinnest {:.2f} mm; chordal error "
        "{:.3g} mm",
        report.volume_mm3 / 1000.0, report.volume_error_relative, report.min_wall_mm,
        report.chordal_error_mm));
  }
  if (report.drilled_mm3 > 0.0)
    console.say(
        fmt::format("drain drilled, {:.3f} cm3 of clay taken", report.drilled_mm3 / 1000.0));
  for (const auto& shape : report.shapes)
    for (const auto& cavity : shape.cavities)
      console.warn(
          fmt::format("closed cavity from {:.1f} to {:.1f} mm ({:.1f} cm3): it needs a drain hole",
                      cavity.bottom_mm, cavity.top_mm, cavity.volume_mm3 / 1000.0));
  auto file = report.files.begin();
  auto copy = copies.begin();
  for (const std::string& path : paths) {
    if (is_drawing(path))
      console.say(path + ": section");
    else if (pot_encoding_of(path))
      console.say(copy_text(*copy++, path));
    else
      tell_file(console, *file++, path);
  }
}

bool tell_thin_wall(const Console& console, const ExportReport& report,
                    const std::optional<WallDemand>& demand) {
  if (!demand || report.files.empty()) return false;
  double thinnest = report.min_wall_mm;
  for (const FileReport& file : report.files)
    thinnest = std::min(thinnest, file.certificate.wall_lower_mm);
  if (thinnest >= demand->min_wall_mm) return false;
  console.warn(fmt::format("thin wall: {:.3f} mm, expected {:.3f} mm at least ({})", thinnest,
                           demand->min_wall_mm, demand->source));
  return true;
}

}  // namespace clay::app
