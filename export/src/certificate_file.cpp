#include "claystack/export/solid_certificate.hpp"

#include "json_fields.hpp"

namespace clay::solid {
namespace {

constexpr const char* kSchema = "claystack-certificate-1";
constexpr std::string_view kClaim =
    "closed and embedded, of the volume and no thinner than stated, as the file's bytes say";

Json profile_json(const Profile& profile) {
  Json pieces = Json::array();
  for (const Polygon& polygon : profile.pieces) {
    Json points = Json::array();
    for (const ProfilePoint& p : polygon) points.push_back({p.rho, p.y});
    pieces.push_back(std::move(points));
  }
  return pieces;
}

Profile profile_from(const Json& json) {
  Profile profile;
  for (const Json& points : field_of(json, "profile_mm")) {
    Polygon& polygon = profile.pieces.emplace_back();
    for (const Json& p : points) {
      if (!p.is_array() || p.size() != 2 || !p[0].is_number() || !p[1].is_number())
        throw BadField("profile_mm: expected points [rho, y], found " + p.dump());
      polygon.push_back({p[0].get<double>(), p[1].get<double>()});
    }
  }
  return profile;
}

Proof proof_from(const Json& json) {
  const std::string name = text_in(json, "proof");
  if (name == "margins") return Proof::margins;
  if (name == "exact_test") return Proof::exact_test;
  throw BadField("proof: expected margins or exact_test, found " + name);
}

SolidCertificate from_json(const Json& json) {
  expect_schema(json, kSchema);
  expect_only(json, {"schema", "written_by", "claim", "format", "bytes", "content_hash",
                     "profile_hash", "proof", "segments", "rounding_mm", "clearance_mm", "chord_mm",
                     "wall_lower_mm", "wall_upper_mm", "volume_mm3", "volume_bound_mm3",
                     "counted_volume_mm3", "profile_mm"});
  SolidCertificate c;
  c.format = text_in(json, "format");
  c.bytes = count_in(json, "bytes");
  c.content_hash = text_in(json, "content_hash");
  c.profile_hash = text_in(json, "profile_hash");
  c.proof = proof_from(json);
  c.segments = count_in(json, "segments");
  c.rounding_mm = number_in(json, "rounding_mm");
  c.margins = {number_in(json, "clearance_mm"), number_in(json, "chord_mm"), c.segments};
  c.wall_lower_mm = number_in(json, "wall_lower_mm");
  c.wall_upper_mm = number_in(json, "wall_upper_mm");
  c.volume_mm3 = number_in(json, "volume_mm3");
  c.volume_bound_mm3 = number_in(json, "volume_bound_mm3");
  c.counted_volume_mm3 = number_in(json, "counted_volume_mm3");
  c.profile = profile_from(json);
  return c;
}

}  // namespace

std::string write_certificate(const SolidCertificate& c) {
  const Json fields = {{"schema", kSchema},
                       {"written_by", "claystack " CLAYSTACK_VERSION},
                       {"claim", kClaim},
                       {"format", c.format},
                       {"bytes", c.bytes},
                       {"content_hash", c.content_hash},
                       {"profile_hash", c.profile_hash},
                       {"proof", c.proof == Proof::margins ? "margins" : "exact_test"},
                       {"segments", c.segments},
                       {"rounding_mm", c.rounding_mm},
                       {"clearance_mm", c.margins.clearance_mm},
                       {"chord_mm", c.margins.chord_mm},
                       {"wall_lower_mm", c.wall_lower_mm},
                       {"wall_upper_mm", c.wall_upper_mm},
                       {"volume_mm3", c.volume_mm3},
                       {"volume_bound_mm3", c.volume_bound_mm3},
                       {"counted_volume_mm3", c.counted_volume_mm3}};
  // The profile on one line, the fields that people read on lines of their own.
  std::string text = fields.dump(1, ' ', false, Json::error_handler_t::replace);
  text.resize(text.rfind('\n'));
  return text + ",\n \"profile_mm\": " + profile_json(c.profile).dump() + "\n}\n";
}

Result<SolidCertificate> parse_certificate(std::string_view bytes, std::string_view name) {
  return parsed_with(bytes, name, from_json);
}

}  // namespace clay::solid
